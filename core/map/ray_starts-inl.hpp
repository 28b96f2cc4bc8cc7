// Included once for each instruction set (Highway's foreach_target), by ray_marks.cpp.
#if defined(NEXTVIEW_RAY_STARTS) == defined(HWY_TARGET_TOGGLE)
#ifdef NEXTVIEW_RAY_STARTS
#undef NEXTVIEW_RAY_STARTS
#else
#define NEXTVIEW_RAY_STARTS
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <limits>

#include "core/map/lanes-inl.hpp"
#include "core/map/ray_batch.hpp"

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Rays at the grid's face or where they begin, one a lane. Places are whole numbers, and all fit into 53 bits.
struct RayStarts {
  Vector next[3];   ///< distance at which the next face across each axis is met [m]
  Vector delta[3];  ///< from face to face
  Vector begin;     ///< no face is met before [m]
  Vector stop;      ///< a voxel that is left beyond this is not marked
  Vector place;     ///< of the voxel that each ray is in
  Vector end;       ///< of the voxel that it ends in, which it does not mark; -1: outside
  Vector step[3];   ///< what a step along each axis adds to the place
  Mask active;
};

/// Adds `delta` to `next` as often as it takes to get to `target`, each time rounded as if one by one; `count` is how
/// often. Between two powers of two the sums lie on one lattice: once a step has been rounded to it, all further ones
/// are the same.
HWY_INLINE void step_up_to(Vector target, Vector delta, Vector& next, Vector& count) {
  const IntegerVector exponent = hn::Set(integers, std::int64_t{0x7ff0000000000000});
  const Vector one = hn::Set(doubles, 1.0);
  while (true) {
    Mask before = hn::Lt(next, target);
    if (hn::AllFalse(doubles, before)) return;
    for (int twice = 0; twice < 2; ++twice) {
      before = hn::Lt(next, target);
      count = hn::Add(count, hn::IfThenElseZero(before, one));
      next = hn::IfThenElse(before, hn::Add(next, delta), next);
    }
    const Vector power = hn::BitCast(doubles, hn::And(hn::BitCast(integers, next), exponent));
    const Vector upper = hn::Add(power, power), last = hn::Sub(next, delta);
    const Vector settled = hn::Sub(hn::Add(next, delta), next);
    // Only where the step before this one was in the same range of two powers already.
    const Mask same_range = hn::And(hn::Lt(next, target), hn::Ge(hn::Add(last, last), upper));
    const Vector steps = hn::Floor(hn::Div(hn::Sub(hn::Min(upper, target), next), settled));
    const Vector whole = hn::IfThenElseZero(same_range, hn::Max(hn::Zero(doubles), steps));
    next = hn::IfThenElse(same_range, hn::Add(next, hn::Mul(whole, settled)), next);  // others may be infinite
    count = hn::Add(count, whole);
  }
}

/// Where rays end [m], in single precision as OctoMap has them, and how long they are.
struct Ends {
  FloatVector at[3], way[3];
  Vector length;
  Mask is_finite;  ///< what is longer than single precision can tell has no direction
};
HWY_INLINE Ends ends_of(const RayBatch& batch, const float* ends) {
  Ends e;
  hn::LoadInterleaved3(floats, ends, e.at[0], e.at[1], e.at[2]);
  for (int axis = 0; axis < 3; ++axis) e.way[axis] = hn::Sub(e.at[axis], hn::Set(floats, batch.origin[axis]));
  e.length = length_of(e.way);
  e.is_finite = hn::Le(e.length, hn::Set(doubles, std::numeric_limits<float>::max()));
  const Mask too_long = hn::Gt(e.length, hn::Set(doubles, batch.max_range));
  if (hn::AllFalse(doubles, too_long)) return e;
  const FloatVector whole = hn::DemoteTo(floats, e.length);  // as point_on_ray
  const auto cut = hn::Gt(hn::DemoteTo(floats, hn::IfThenElseZero(too_long, hn::Set(doubles, 1.0))), hn::Zero(floats));
  for (int axis = 0; axis < 3; ++axis) {
    const FloatVector origin = hn::Set(floats, batch.origin[axis]);
    const FloatVector along =
        hn::Mul(hn::Div(e.way[axis], whole), hn::Set(floats, static_cast<float>(batch.max_range)));
    e.at[axis] = hn::IfThenElse(cut, hn::Add(origin, along), e.at[axis]);
    e.way[axis] = hn::Sub(e.at[axis], origin);
  }
  e.length = length_of(e.way);
  return e;
}

/// `ends`: of the rays, three floats each, for all lanes; `count`: how many of them there are. Rays that rounding could
/// lead elsewhere are walked at once, one by one.
HWY_INLINE RayStarts start_rays(const RayBatch& batch, const float* ends, std::size_t count) {
  const VoxelGrid& grid = batch.grid;
  const Ends e = ends_of(batch, ends);
  const FloatVector single_length = hn::DemoteTo(floats, e.length);
  const Vector length = hn::PromoteTo(doubles, single_length), zero = hn::Zero(doubles), one = hn::Set(doubles, 1.0);
  const Vector never = hn::Set(doubles, std::numeric_limits<double>::max());
  const Eigen::Vector3i from = grid.cell_at(batch.origin.cast<double>());
  RayStarts start;
  Vector enter = zero, leave = never, direction[3], to[3], cells[3];
  Mask same_cell = hn::Not(none()), beside = none();
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = batch.origin[axis], edge = grid.resolution;
    direction[axis] = hn::PromoteTo(doubles, hn::Div(e.way[axis], single_length));
    const Mask forward = hn::Gt(direction[axis], zero), still = hn::Eq(direction[axis], zero);
    // The grid's cells, as cell_at has them; what is farther off than an int can tell is outside anyway.
    to[axis] = hn::Sub(hn::Floor(hn::Mul(hn::PromoteTo(doubles, e.at[axis]), hn::Set(doubles, 1.0 / edge))),
                       hn::Set(doubles, grid.first[axis]));
    cells[axis] = hn::Abs(hn::Sub(to[axis], hn::Set(doubles, from[axis])));
    same_cell = hn::And(same_cell, hn::Eq(cells[axis], zero));
    // As set_axis.
    const double middle = (from[axis] + grid.first[axis] + 0.5) * edge;
    const double face_above = middle + static_cast<float>(1 * edge * 0.5),
                 face_below = middle + static_cast<float>(-1 * edge * 0.5);
    const Vector to_face =
        hn::IfThenElse(forward, hn::Set(doubles, face_above - origin), hn::Set(doubles, face_below - origin));
    start.next[axis] = hn::IfThenElse(still, never, hn::Div(to_face, direction[axis]));
    start.delta[axis] = hn::IfThenElse(still, never, hn::Div(hn::Set(doubles, edge), hn::Abs(direction[axis])));
    const Vector to_lower = hn::Div(hn::Set(doubles, grid.lower()[axis] - origin), direction[axis]);
    const Vector to_upper = hn::Div(hn::Set(doubles, grid.upper()[axis] - origin), direction[axis]);
    if (from[axis] < 0 || from[axis] >= grid.size[axis]) beside = hn::Or(beside, still);
    enter = hn::IfThenElse(still, enter, hn::Max(enter, hn::Min(to_lower, to_upper)));
    leave = hn::IfThenElse(still, leave, hn::Min(leave, hn::Max(to_lower, to_upper)));
  }
  const Vector margin = hn::Set(doubles, 1e-3 * grid.resolution);  // far more than rounding, less than a voxel
  start.stop = hn::Min(length, hn::Add(leave, margin));
  Vector target = hn::Sub(enter, margin);
  start.active = hn::And(hn::Lt(target, start.stop), e.is_finite);
  start.active = hn::AndNot(hn::Or(same_cell, beside), hn::And(start.active, hn::FirstN(doubles, count)));
  target = hn::IfThenElseZero(start.active, target);

  Mask past_end = none(), end_is_near = hn::Not(none());
  Vector place = zero, end = zero;
  double stride = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    Vector steps = zero;
    step_up_to(target, start.delta[axis], start.next[axis], steps);
    past_end = hn::Or(past_end, hn::Gt(steps, cells[axis]));
    const Vector sign = hn::IfThenElse(hn::Gt(direction[axis], zero), one,
                                       hn::IfThenElseZero(hn::Lt(direction[axis], zero), hn::Set(doubles, -1.0)));
    const Vector cell = hn::Add(hn::Set(doubles, from[axis] + 1.0), hn::Mul(steps, sign)),
                 end_cell = hn::Add(to[axis], one);
    const double across = grid.size[axis] + 2.0;
    end_is_near = hn::And(end_is_near, hn::And(hn::Ge(end_cell, zero), hn::Lt(end_cell, hn::Set(doubles, across))));
    place = hn::Add(place, hn::Mul(cell, hn::Set(doubles, stride)));
    end = hn::Add(end, hn::Mul(end_cell, hn::Set(doubles, stride)));
    start.step[axis] = hn::Mul(sign, hn::Set(doubles, stride));
    stride *= across;
  }
  past_end = hn::And(past_end, start.active);
  if (!hn::AllFalse(doubles, past_end)) {
    HWY_ALIGN double one_by_one[most_lanes];
    hn::Store(hn::IfThenElseZero(past_end, one), doubles, one_by_one);
    for (std::size_t lane = 0; lane < count; ++lane)
      if (one_by_one[lane] != 0.0) mark_one(batch, {ends[3 * lane], ends[3 * lane + 1], ends[3 * lane + 2]});
    start.active = hn::AndNot(past_end, start.active);
  }
  start.begin = target;
  start.place = hn::IfThenElseZero(start.active, place);
  start.end = hn::IfThenElse(end_is_near, end, hn::Set(doubles, -1.0));
  return start;
}

}  // namespace nextview::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
