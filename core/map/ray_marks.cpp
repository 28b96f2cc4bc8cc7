// Compiled once for each instruction set (Highway's foreach_target); the processor's best is chosen when it runs.
#include "core/map/ray_marks.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/map/ray_batch.hpp"
#include "core/progress/stopped.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/map/ray_marks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Floats = hn::Rebind<float, Doubles>;
using Integers = hn::RebindToSigned<Doubles>;
using Vector = hn::Vec<Doubles>;
using FloatVector = hn::Vec<Floats>;
using IntegerVector = hn::Vec<Integers>;
using Mask = hn::Mask<Doubles>;

constexpr Doubles doubles;
constexpr Floats floats;
constexpr Integers integers;
constexpr std::size_t most_lanes = hn::MaxLanes(doubles);
constexpr int rows =
    4;  // of lanes, walked side by side: a step takes its time, but the next row's need not wait for it

HWY_INLINE Mask none() { return hn::Lt(hn::Zero(doubles), hn::Zero(doubles)); }

/// Rays on their way, one a lane.
struct Walk {
  Vector next[3];         ///< distance at which the next face across each axis is met [m]
  Vector delta[3];        ///< from face to face
  Vector stop;            ///< a voxel that is left beyond this is not marked
  IntegerVector place;    ///< of the voxel that each ray is in
  IntegerVector end;      ///< of the voxel that it ends in, which it does not mark; -1: outside
  IntegerVector step[3];  ///< what a step along each axis adds to the place
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
HWY_INLINE Vector length_of(const FloatVector (&way)[3]) {
  const FloatVector squares =
      hn::Add(hn::Add(hn::Mul(way[0], way[0]), hn::Mul(way[1], way[1])), hn::Mul(way[2], way[2]));
  return hn::Sqrt(hn::PromoteTo(doubles, squares));
}
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

/// The rays in a row of lanes, at the grid's face or where they begin. `ends`: theirs, three floats each, for all
/// lanes; `count`: how many of them there are. Rays that rounding could lead elsewhere are walked at once, one by one.
HWY_INLINE Walk begin_walk(const RayBatch& batch, const float* ends, std::size_t count) {
  const VoxelGrid& grid = batch.grid;
  const Ends e = ends_of(batch, ends);
  const FloatVector single_length = hn::DemoteTo(floats, e.length);
  const Vector length = hn::PromoteTo(doubles, single_length), zero = hn::Zero(doubles), one = hn::Set(doubles, 1.0);
  const Vector never = hn::Set(doubles, std::numeric_limits<double>::max());
  const Eigen::Vector3i from = grid.cell_at(batch.origin.cast<double>());
  Walk walk;
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
    walk.next[axis] = hn::IfThenElse(still, never, hn::Div(to_face, direction[axis]));
    walk.delta[axis] = hn::IfThenElse(still, never, hn::Div(hn::Set(doubles, edge), hn::Abs(direction[axis])));
    const Vector to_lower = hn::Div(hn::Set(doubles, grid.lower()[axis] - origin), direction[axis]);
    const Vector to_upper = hn::Div(hn::Set(doubles, grid.upper()[axis] - origin), direction[axis]);
    if (from[axis] < 0 || from[axis] >= grid.size[axis]) beside = hn::Or(beside, still);
    enter = hn::IfThenElse(still, enter, hn::Max(enter, hn::Min(to_lower, to_upper)));
    leave = hn::IfThenElse(still, leave, hn::Min(leave, hn::Max(to_lower, to_upper)));
  }
  const Vector margin = hn::Set(doubles, 1e-3 * grid.resolution);  // far more than rounding, less than a voxel
  walk.stop = hn::Min(length, hn::Add(leave, margin));
  Vector target = hn::Sub(enter, margin);
  walk.active = hn::And(hn::Lt(target, walk.stop), e.is_finite);
  walk.active = hn::AndNot(hn::Or(same_cell, beside), hn::And(walk.active, hn::FirstN(doubles, count)));
  target = hn::IfThenElseZero(walk.active, target);

  Mask past_end = none(), end_is_near = hn::Not(none());
  Vector place = zero, end = zero;
  double stride = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    Vector steps = zero;
    step_up_to(target, walk.delta[axis], walk.next[axis], steps);
    past_end = hn::Or(past_end, hn::Gt(steps, cells[axis]));
    const Vector sign = hn::IfThenElse(hn::Gt(direction[axis], zero), one,
                                       hn::IfThenElseZero(hn::Lt(direction[axis], zero), hn::Set(doubles, -1.0)));
    const Vector cell = hn::Add(hn::Set(doubles, from[axis] + 1.0), hn::Mul(steps, sign)),
                 end_cell = hn::Add(to[axis], one);
    const double across = grid.size[axis] + 2.0;
    end_is_near = hn::And(end_is_near, hn::And(hn::Ge(end_cell, zero), hn::Lt(end_cell, hn::Set(doubles, across))));
    place = hn::Add(place, hn::Mul(cell, hn::Set(doubles, stride)));
    end = hn::Add(end, hn::Mul(end_cell, hn::Set(doubles, stride)));
    walk.step[axis] = hn::ConvertTo(integers, hn::Mul(sign, hn::Set(doubles, stride)));
    stride *= across;
  }
  past_end = hn::And(past_end, walk.active);
  if (!hn::AllFalse(doubles, past_end)) {
    HWY_ALIGN double one_by_one[most_lanes];
    hn::Store(hn::IfThenElseZero(past_end, one), doubles, one_by_one);
    for (std::size_t lane = 0; lane < count; ++lane)
      if (one_by_one[lane] != 0.0) mark_one(batch, {ends[3 * lane], ends[3 * lane + 1], ends[3 * lane + 2]});
    walk.active = hn::AndNot(past_end, walk.active);
  }
  walk.place = hn::ConvertTo(integers, hn::IfThenElseZero(walk.active, place));
  walk.end = hn::ConvertTo(integers, hn::IfThenElse(end_is_near, end, hn::Set(doubles, -1.0)));
  return walk;
}

HWY_INLINE IntegerVector pick(Mask mask, IntegerVector yes, IntegerVector no) {
  return hn::BitCast(integers, hn::IfThenElse(mask, hn::BitCast(doubles, yes), hn::BitCast(doubles, no)));
}

/// Stores where the rays of a row are, the finished ones at 0 in the margin, and takes them one voxel on, as
/// VoxelWalk::advance does. Whether any is on its way.
HWY_INLINE bool advance(Walk& w, std::int64_t* places) {
  const Vector exit = hn::Min(hn::Min(w.next[0], w.next[1]), w.next[2]);
  const Mask at_end = hn::MaskFromVec(hn::BitCast(doubles, hn::VecFromMask(integers, hn::Eq(w.place, w.end))));
  w.active = hn::AndNot(hn::Or(at_end, hn::Gt(exit, w.stop)), w.active);
  hn::Store(hn::BitCast(integers, hn::IfThenElseZero(w.active, hn::BitCast(doubles, w.place))), integers, places);
  const Mask x_before_y = hn::Lt(w.next[0], w.next[1]);
  const Mask along_x = hn::And(x_before_y, hn::Lt(w.next[0], w.next[2]));
  const Mask along_y = hn::AndNot(x_before_y, hn::Lt(w.next[1], w.next[2]));
  w.place = hn::Add(w.place, pick(along_x, w.step[0], pick(along_y, w.step[1], w.step[2])));
  w.next[0] = hn::IfThenElse(along_x, hn::Add(w.next[0], w.delta[0]), w.next[0]);
  w.next[1] = hn::IfThenElse(along_y, hn::Add(w.next[1], w.delta[1]), w.next[1]);
  w.next[2] = hn::IfThenElse(hn::Or(along_x, along_y), w.next[2], hn::Add(w.next[2], w.delta[2]));
  return !hn::AllFalse(doubles, w.active);
}

/// Leaves the marks of the batch's rays.
void mark_rays(const RayBatch& batch) {
  const std::size_t lanes = hn::Lanes(doubles), rays = batch.ends.size();
  HWY_ALIGN std::int64_t places[rows * most_lanes];
  for (std::size_t first = 0; first < rays; first += rows * lanes) {
    Walk walks[rows];
    for (int row = 0; row < rows; ++row) {
      const std::size_t begin = first + row * lanes, count = begin < rays ? std::min(lanes, rays - begin) : 0;
      std::array<float, 3 * most_lanes> some{};  // where there are fewer rays than lanes
      const float* ends = some.data();
      if (count == lanes) {
        ends = batch.ends[begin].data();
      } else {
        for (std::size_t i = 0; i < 3 * count; ++i) some[i] = batch.ends[begin + i / 3][i % 3];
      }
      walks[row] = begin_walk(batch, ends, count);
    }
    while (true) {
      bool any = false;
      for (int row = 0; row < rows; ++row) any |= advance(walks[row], places + row * lanes);
      if (!any) break;
#pragma GCC unroll 32
      for (std::size_t i = 0; i < rows * lanes; ++i) leave_mark(batch.marks[places[i]]);
    }
  }
}

}  // namespace nextview::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nextview {
namespace {

HWY_EXPORT(mark_rays);

/// Farther off than this [voxels], stepping to the grid rounds too coarsely for the lanes.
constexpr int farthest_camera = 1 << 20;

}  // namespace

RayMarks::RayMarks(const VoxelGrid& grid)
    : grid_(grid), marks_((std::size_t(grid.size.x()) + 2) * (grid.size.y() + 2) * (grid.size.z() + 2)) {}

void RayMarks::pass(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends, double max_range,
                    const std::stop_token& stop) {
  const Eigen::Vector3i from = grid_.cell_at(origin.cast<double>());
  const bool far = from.cwiseAbs().maxCoeff() > farthest_camera;
  const auto mark = HWY_DYNAMIC_DISPATCH(mark_rays);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ends.size(), 1024), [&](const auto& range) {
    if (stop.stop_requested()) return;
    const RayBatch batch{grid_, origin, ends.subspan(range.begin(), range.size()), max_range, marks_.data()};
    if (far) {
      for (const Eigen::Vector3f& end : batch.ends) mark_one(batch, end);
    } else {
      mark(batch);
    }
  });
  throw_if_stopped(stop);
  if (!grid_.contains(from)) return;
  // Any ray that goes anywhere marks the camera's own voxel, also if it ends in the next one.
  const RayBatch batch{grid_, origin, ends, max_range, marks_.data()};
  bool marked = false;
  for (std::size_t i = 0; i < ends.size() && !marked; ++i)
    walk_one(batch, ends[i], [&](std::size_t place) {
      marks_[place] = 1;
      marked = true;
      return false;
    });
}

}  // namespace nextview
#endif
