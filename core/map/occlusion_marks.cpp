// Compiled once for each instruction set (Highway's foreach_target); the processor's best is chosen when it runs.
#include "core/map/occlusion_marks.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/map/ray_tiles.hpp"
#include "core/map/return_batch.hpp"
#include "core/map/voxel_bricks.hpp"
#include "core/progress/stopped.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/map/occlusion_marks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/map/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The ways on from returns, as walk_segment goes from each to its end, one a lane.
class WalkBehind {
 public:
  HWY_INLINE WalkBehind(const ReturnBatch& batch, const float* returns, std::size_t count) {
    FloatVector at[3], way[3];
    hn::LoadInterleaved3(floats, returns, at[0], at[1], at[2]);
    for (int axis = 0; axis < 3; ++axis) way[axis] = hn::Sub(at[axis], hn::Set(floats, batch.origin[axis]));
    const Vector range = length_of(way), zero = hn::Zero(doubles);
    active_ = hn::And(hn::Gt(range, zero), hn::Le(range, hn::Set(doubles, batch.max_range)));
    active_ = hn::And(active_, hn::FirstN(doubles, count));
    const FloatVector from_camera = hn::DemoteTo(floats, range);
    const FloatVector to_end = hn::DemoteTo(floats, hn::Add(range, hn::Set(doubles, batch.distance)));
    FloatVector end[3], on[3];
    for (int axis = 0; axis < 3; ++axis) {  // as point_on_ray
      const FloatVector origin = hn::Set(floats, batch.origin[axis]);
      end[axis] = hn::Add(origin, hn::Mul(hn::Div(way[axis], from_camera), to_end));
      on[axis] = hn::Sub(end[axis], at[axis]);
    }
    const Vector length = length_of(on);
    active_ = hn::And(active_, hn::Le(length, hn::Set(doubles, std::numeric_limits<float>::max())));
    begin(batch.grid, at, end, on, hn::DemoteTo(floats, length));
  }

  /// Stores where the rays get to with a step, as VoxelWalk::advance takes it, the finished ones at 0 in the margin.
  /// Whether any is on its way.
  HWY_INLINE bool advance(std::int64_t* places) {
    place_ = hn::Add(place_, step_on(next_, delta_, step_));
    const Vector exit = hn::Min(hn::Min(next_[0], next_[1]), next_[2]);
    const Mask at_end = hn::MaskFromVec(hn::BitCast(doubles, hn::VecFromMask(integers, hn::Eq(place_, end_))));
    active_ = hn::AndNot(hn::Or(at_end, hn::Gt(exit, stop_)), active_);
    hn::Store(hn::BitCast(integers, hn::IfThenElseZero(active_, hn::BitCast(doubles, place_))), integers, places);
    return !hn::AllFalse(doubles, active_);
  }

 private:
  HWY_INLINE void begin(const VoxelGrid& grid, const FloatVector (&at)[3], const FloatVector (&end)[3],
                        const FloatVector (&on)[3], FloatVector length) {
    const Vector zero = hn::Zero(doubles), one = hn::Set(doubles, 1.0);
    const Vector never = hn::Set(doubles, std::numeric_limits<double>::max());
    const double edge = grid.resolution;
    const Vector half = hn::Set(doubles, static_cast<float>(edge * 0.5));
    Vector leave = never, place = zero, end_place = zero;
    Mask same_cell = hn::Not(none()), end_is_near = same_cell;
    double stride = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector position = hn::PromoteTo(doubles, at[axis]);
      const Vector direction = hn::PromoteTo(doubles, hn::Div(on[axis], length));
      const Mask forward = hn::Gt(direction, zero), still = hn::Eq(direction, zero);
      // The grid's cells, as cell_at has them; what is farther off than an int can tell is outside anyway.
      const Vector per_metre = hn::Set(doubles, 1.0 / edge), first = hn::Set(doubles, grid.first[axis]);
      const Vector lattice = hn::Floor(hn::Mul(position, per_metre)), cell = hn::Sub(lattice, first);
      const Vector last = hn::Sub(hn::Floor(hn::Mul(hn::PromoteTo(doubles, end[axis]), per_metre)), first);
      const Vector size = hn::Set(doubles, grid.size[axis]);
      active_ = hn::And(active_, hn::And(hn::Ge(cell, zero), hn::Lt(cell, size)));
      same_cell = hn::And(same_cell, hn::Eq(cell, last));
      end_is_near = hn::And(end_is_near, hn::And(hn::Ge(last, hn::Neg(one)), hn::Le(last, size)));
      // As set_axis.
      const Vector sign = hn::IfThenElse(still, zero, hn::IfThenElse(forward, one, hn::Neg(one)));
      const Vector middle = hn::Mul(hn::Add(lattice, hn::Set(doubles, 0.5)), hn::Set(doubles, edge));
      const Vector face = hn::Add(middle, hn::Mul(sign, half));
      next_[axis] = hn::IfThenElse(still, never, hn::Div(hn::Sub(face, position), direction));
      delta_[axis] = hn::IfThenElse(still, never, hn::Div(hn::Set(doubles, edge), hn::Abs(direction)));
      const Vector faces = hn::IfThenElse(forward, hn::Sub(hn::Sub(size, one), cell), cell);  // up to the grid's
      leave = hn::Min(leave, hn::Add(next_[axis], hn::Mul(faces, delta_[axis])));
      step_[axis] = hn::ConvertTo(integers, hn::Mul(sign, hn::Set(doubles, stride)));
      place = hn::Add(place, hn::Mul(hn::Add(cell, one), hn::Set(doubles, stride)));
      end_place = hn::Add(end_place, hn::Mul(hn::Add(last, one), hn::Set(doubles, stride)));
      stride *= grid.size[axis] + 2.0;
    }
    // Once it has left the grid a way does not come back; what it numbers in the margin nobody asks for. The part of a
    // voxel that it may go on is far more than rounding, and too little to get out of the margin.
    const Vector beyond = hn::Add(leave, hn::Set(doubles, 1e-3 * edge));
    stop_ = hn::Min(hn::PromoteTo(doubles, length), beyond);
    active_ = hn::AndNot(same_cell, active_);
    place_ = hn::ConvertTo(integers, hn::IfThenElseZero(active_, place));
    end_ = hn::ConvertTo(integers, hn::IfThenElse(end_is_near, end_place, hn::Neg(one)));
  }

  Vector next_[3];                       ///< distance at which the next face across each axis is met [m]
  Vector delta_[3];                      ///< from face to face
  Vector stop_;                          ///< a voxel that is left beyond this is not numbered
  IntegerVector place_, end_, step_[3];  ///< of the voxels that the ways are in and end in, which are not numbered
  Mask active_;
};

void mark_behind(const ReturnBatch& batch) {
  constexpr std::uint32_t farthest = std::numeric_limits<std::uint16_t>::max();  // [voxels]
  const std::size_t lanes = hn::Lanes(doubles);
  HWY_ALIGN std::int64_t places[most_lanes] = {};
  std::array<float, 3 * most_lanes> some{};  // where there are fewer returns than lanes
  for (std::size_t first = 0; first < batch.returns.size(); first += lanes) {
    const std::size_t count = std::min(lanes, batch.returns.size() - first);
    const float* returns = batch.returns[first].data();
    if (count < lanes) returns = (std::copy_n(returns, 3 * count, some.data()), some.data());
    WalkBehind walk(batch, returns, count);
    for (std::uint32_t number = 1; number <= farthest && walk.advance(places); ++number)
#pragma GCC unroll 8
      for (std::size_t i = 0; i < most_lanes; ++i)
        leave_number(batch.numbers[places[i]], static_cast<std::uint16_t>(number));
  }
}

}  // namespace nextview::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nextview {
namespace {

HWY_EXPORT(mark_behind);

}  // namespace

VoxelGrid region_behind(const VoxelGrid& grid, const Scan& scan, double distance) {
  const auto ways = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, scan.hits.size(), 4096), Eigen::AlignedBox3i(),
      [&](const auto& range, Eigen::AlignedBox3i cells) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          const Vector3 at = scan.hits[i].cast<double>();
          const Eigen::Vector3i cell = grid.cell_at(at);
          if (!grid.contains(cell)) continue;
          cells.extend(cell).extend(grid.cell_at(at + distance * (at - scan.origin).stableNormalized()));
        }
        return cells;
      },
      [](const Eigen::AlignedBox3i& a, const Eigen::AlignedBox3i& b) { return a.merged(b); });
  if (ways.isEmpty()) return {grid.resolution, grid.first, Eigen::Vector3i::Zero()};
  constexpr int edge = VoxelBricks::edge;
  // A voxel more, for rounding.
  const Eigen::Vector3i first = (ways.min().array() - 1).max(0) / edge * edge;
  const Eigen::Vector3i beyond = ((ways.max().array() + 1 + edge) / edge * edge).min(grid.size.array());
  return {grid.resolution, grid.first + first, beyond - first};
}

OcclusionMarks::OcclusionMarks(const VoxelGrid& grid) : grid_(grid), numbers_(places_with_margin(grid)) {}

void OcclusionMarks::mark(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> returns, double max_range,
                          double distance, const std::stop_token& stop) {
  const auto mark = HWY_DYNAMIC_DISPATCH(mark_behind);
  const OrderedEnds ordered(origin, returns, grid_.voxel_count() * sizeof(std::uint16_t));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ordered.size(), 1024), [&](const auto& range) {
    if (stop.stop_requested()) return;
    mark({grid_, origin, ordered.part(range.begin(), range.size()), max_range, distance, numbers_.data()});
  });
  throw_if_stopped(stop);
}

}  // namespace nextview
#endif
