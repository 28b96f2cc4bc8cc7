// Compiled once for each instruction set (Highway's foreach_target); the processor's best is chosen when it runs.
#include "core/map/ray_marks.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "core/map/ray_batch.hpp"
#include "core/map/ray_tiles.hpp"
#include "core/progress/stopped.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/map/ray_marks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/map/ray_starts-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Rays on their way, one a lane, to the last rounding.
class ExactWalk {
 public:
  using Place = std::int64_t;
  static constexpr std::size_t most_lanes = hn::MaxLanes(doubles);
  HWY_INLINE static std::size_t lanes() { return hn::Lanes(doubles); }

  HWY_INLINE void begin(const RayBatch& batch, const float* ends, std::size_t count) {
    const RayStarts start = start_rays(batch, ends, count);
    for (int axis = 0; axis < 3; ++axis) {
      next_[axis] = start.next[axis];
      delta_[axis] = start.delta[axis];
      step_[axis] = hn::ConvertTo(integers, start.step[axis]);
    }
    stop_ = start.stop;
    place_ = hn::ConvertTo(integers, start.place);
    end_ = hn::ConvertTo(integers, start.end);
    active_ = start.active;
  }

  /// Stores where the rays are, the finished ones at 0 in the margin, and takes them one voxel on, as
  /// VoxelWalk::advance does. Whether any is on its way.
  HWY_INLINE bool advance(Place* places) {
    const Vector exit = hn::Min(hn::Min(next_[0], next_[1]), next_[2]);
    const Mask at_end = hn::MaskFromVec(hn::BitCast(doubles, hn::VecFromMask(integers, hn::Eq(place_, end_))));
    active_ = hn::AndNot(hn::Or(at_end, hn::Gt(exit, stop_)), active_);
    hn::Store(hn::BitCast(integers, hn::IfThenElseZero(active_, hn::BitCast(doubles, place_))), integers, places);
    place_ = hn::Add(place_, step_on(next_, delta_, step_));
    return !hn::AllFalse(doubles, active_);
  }

  void keep_undecided(const float*, std::vector<Eigen::Vector3f>&) const {}  ///< all are decided

 private:
  Vector next_[3], delta_[3], stop_;  ///< as RayStarts has them, also the others
  IntegerVector place_, end_, step_[3];
  Mask active_;
};

#if HWY_TARGET != HWY_SCALAR
/// The same in fixed point, with twice as many lanes. Where two faces, or a face and the end of the way, are met within
/// what rounding can amount to, a ray is left where it is, undecided.
class FixedWalk {
  using UnitTag = hn::ScalableTag<std::int32_t>;
  using Units = hn::Vec<UnitTag>;
  static constexpr UnitTag units{};
  static constexpr hn::Rebind<std::int32_t, Doubles> half_units{};

 public:
  using Place = std::int32_t;
  static constexpr std::size_t most_lanes = hn::MaxLanes(units);
  HWY_INLINE static std::size_t lanes() { return hn::Lanes(units); }

  /// In larger grids too many rays are undecided, and from farther off doubles are hardly better than the units.
  static bool fits(const RayBatch& batch) {
    constexpr int largest_grid = 256, farthest_camera = 1 << 13;  // [voxels]
    return batch.grid.size.maxCoeff() <= largest_grid &&
           batch.grid.cell_at(batch.origin.cast<double>()).cwiseAbs().maxCoeff() <= farthest_camera;
  }

  HWY_INLINE void begin(const RayBatch& batch, const float* ends, std::size_t count) {
    const std::size_t half = hn::Lanes(doubles);
    const RayStarts lower = start_rays(batch, ends, std::min(count, half));
    const RayStarts upper = start_rays(batch, ends + 3 * half, count - std::min(count, half));
    const Vector shortest = hn::Set(doubles, batch.grid.resolution), whole = hn::Set(doubles, double(whole_way));
    const Vector lower_scale = hn::Div(whole, hn::Sub(lower.stop, lower.begin));
    const Vector upper_scale = hn::Div(whole, hn::Sub(upper.stop, upper.begin));
    for (int axis = 0; axis < 3; ++axis) {
      next_[axis] = both(in_units(hn::Sub(lower.next[axis], lower.begin), lower_scale),
                         in_units(hn::Sub(upper.next[axis], upper.begin), upper_scale));
      delta_[axis] = both(in_units(lower.delta[axis], lower_scale), in_units(upper.delta[axis], upper_scale));
      step_[axis] = both(lower.step[axis], upper.step[axis]);
    }
    place_ = both(lower.place, upper.place);
    end_ = both(lower.end, upper.end);
    const Units state = both(state_of(lower, shortest), state_of(upper, shortest));
    active_ = hn::Gt(state, hn::Set(units, 1));
    last_ = hn::IfThenElse(hn::Eq(state, hn::Zero(units)), hn::Set(units, decided), hn::Zero(units));
    // A step is off by half a unit at most, and so are the first face and the end.
    doubt_ = batch.grid.size.maxCoeff() + 8;
  }

  HWY_INLINE bool advance(Place* places) {
    const Units lower = hn::Min(next_[0], next_[1]), upper = hn::Max(next_[0], next_[1]);
    const Units exit = hn::Min(lower, next_[2]), second = hn::Max(lower, hn::Min(upper, next_[2]));
    const Units met = hn::IfThenElse(hn::Eq(place_, end_), hn::Set(units, decided), exit);
    last_ = hn::IfThenElse(active_, met, last_);
    active_ = hn::And(active_, hn::Lt(met, hn::Set(units, whole_way - doubt_)));
    active_ = hn::And(active_, hn::Gt(hn::Sub(second, exit), hn::Set(units, doubt_)));
    hn::Store(hn::IfThenElseZero(active_, place_), units, places);
    for (int axis = 0; axis < 3; ++axis) {
      const auto here = hn::Eq(next_[axis], exit);
      place_ = hn::IfThenElse(here, hn::Add(place_, step_[axis]), place_);
      next_[axis] = hn::IfThenElse(here, hn::Add(next_[axis], delta_[axis]), next_[axis]);
    }
    return !hn::AllFalse(units, active_);
  }

  /// Of the rays to these ends, once all have come as far as they do.
  void keep_undecided(const float* ends, std::vector<Eigen::Vector3f>& undecided) const {
    if (hn::AllFalse(units, hn::Lt(last_, hn::Set(units, whole_way + doubt_ + 1)))) return;
    HWY_ALIGN Place last[most_lanes];
    hn::Store(last_, units, last);
    for (std::size_t i = 0; i < lanes(); ++i)
      if (last[i] <= whole_way + doubt_) undecided.emplace_back(ends[3 * i], ends[3 * i + 1], ends[3 * i + 2]);
  }

 private:
  /// Of a ray through the grid [units]. What comes later is cut off so that a face's distance and one step more have
  /// room in 32 bits, and are still beyond.
  static constexpr Place whole_way = (1 << 30) - 1024, beyond = (1 << 30) + 512;
  static constexpr Place decided = std::numeric_limits<Place>::max();

  HWY_INLINE static Units both(Vector lower, Vector upper) {
    return hn::Combine(units, hn::DemoteTo(half_units, upper), hn::DemoteTo(half_units, lower));
  }
  HWY_INLINE static Vector in_units(Vector distance, Vector scale) {
    const Vector rounded = hn::MulAdd(distance, scale, hn::Set(doubles, 0.5));
    return hn::Min(rounded, hn::Set(doubles, double(beyond)));
  }
  /// 0: the ray goes nowhere, 1: not even as far as a voxel is wide, where units are finer than doubles.
  HWY_INLINE static Vector state_of(const RayStarts& start, Vector shortest) {
    const Vector one = hn::Set(doubles, 1.0);
    const Mask is_long = hn::Ge(hn::Sub(start.stop, start.begin), shortest);
    return hn::IfThenElseZero(start.active, hn::Add(one, hn::IfThenElseZero(is_long, one)));
  }

  Units next_[3], delta_[3], step_[3], place_, end_;
  Units last_;  ///< what each ray met last; decided: its end, or it went nowhere
  hn::Mask<UnitTag> active_;
  Place doubt_ = 0;
};
#endif

/// A mark at each place. All places are read before the first mark is left, two at a time, so that they have room in
/// the registers.
template <class Place, std::size_t count, std::size_t... word>
HWY_INLINE void leave_marks(std::uint8_t* marks, const Place (&places)[count], std::index_sequence<word...>) {
  std::uint64_t words[sizeof...(word)];
  ((std::memcpy(&words[word], reinterpret_cast<const char*>(places) + 8 * word, 8)), ...);
  if constexpr (sizeof(Place) == 8) {
    (leave_mark(marks[words[word]]), ...);
  } else {
    ((leave_mark(marks[static_cast<std::uint32_t>(words[word])]), leave_mark(marks[words[word] >> 32])), ...);
  }
}

/// Leaves the marks of rays; returns the ends of those that are undecided. One walk at a time stays in the registers,
/// and while its marks are left its next step is made.
template <class Walk>
std::vector<Eigen::Vector3f> walk_rays(const RayBatch& batch) {
  const std::size_t lanes = Walk::lanes(), rays = batch.ends.size();
  std::uint8_t* const marks = batch.marks;  // which a mark might change, for all that the compiler knows
  std::vector<Eigen::Vector3f> undecided;
  HWY_ALIGN typename Walk::Place places[Walk::most_lanes] = {};
  std::array<float, 3 * Walk::most_lanes> some{};  // where there are fewer rays than lanes
  for (std::size_t first = 0; first < rays; first += lanes) {
    const std::size_t count = std::min(lanes, rays - first);
    const float* ends = batch.ends[first].data();
    if (count < lanes) ends = (std::copy_n(ends, 3 * count, some.data()), some.data());
    Walk walk;
    walk.begin(batch, ends, count);
    while (walk.advance(places)) leave_marks(marks, places, std::make_index_sequence<sizeof(places) / 8>());
    walk.keep_undecided(ends, undecided);
  }
  return undecided;
}

/// Leaves the marks of the batch's rays.
void mark_rays(const RayBatch& batch) {
#if HWY_TARGET != HWY_SCALAR
  if (FixedWalk::fits(batch)) {
    const std::vector<Eigen::Vector3f> undecided = walk_rays<FixedWalk>(batch);
    walk_rays<ExactWalk>({batch.grid, batch.origin, undecided, batch.max_range, batch.marks});
    return;
  }
#endif
  walk_rays<ExactWalk>(batch);
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

RayMarks::RayMarks(const VoxelGrid& grid) : grid_(grid), marks_(places_with_margin(grid)) {}

void RayMarks::pass(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends, double max_range,
                    const std::stop_token& stop) {
  const Eigen::Vector3i from = grid_.cell_at(origin.cast<double>());
  const bool far = from.cwiseAbs().maxCoeff() > farthest_camera;
  const auto mark = HWY_DYNAMIC_DISPATCH(mark_rays);
  const OrderedEnds ordered(origin, ends, grid_.voxel_count());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ordered.size(), 1024), [&](const auto& range) {
    if (stop.stop_requested()) return;
    const RayBatch batch{grid_, origin, ordered.part(range.begin(), range.size()), max_range, marks_.data()};
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

void RayMarks::mark_ends(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> ends, double max_range,
                         std::uint8_t mark) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ends.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Eigen::Vector3i cell = grid_.cell_at(ends[i].cast<double>());
      if (grid_.contains(cell) && ray_length(origin, ends[i]) <= max_range)
        std::atomic_ref(marks_[place(cell)]).store(mark, std::memory_order_relaxed);
    }
  });
}

}  // namespace nextview
#endif
