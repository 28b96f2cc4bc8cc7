// Included once for each instruction set (Highway's foreach_target), by ray_lanes.cpp.
#if defined(NEXTVIEW_RAY_FOLLOWER) == defined(HWY_TARGET_TOGGLE)
#ifdef NEXTVIEW_RAY_FOLLOWER
#undef NEXTVIEW_RAY_FOLLOWER
#else
#define NEXTVIEW_RAY_FOLLOWER
#endif

#include "core/gain/ray_entries-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {

constexpr std::size_t rows = 4;  // of lanes, walked side by side: a step waits for the one before it

/// Rays on their way, one a lane.
struct Walk {
  Vector next[3];         ///< distance at which the next face across each axis is met [m]
  Vector delta[3];        ///< from face to face
  IntegerVector place;    ///< of the voxel that each ray is in
  IntegerVector step[3];  ///< what a step along each axis adds to the place
  Vector enter;           ///< where it was entered [m]
  Vector left;            ///< how likely the ray gets there; 0 of rays that have ended
  Vector sum;
  Mask live;
  std::array<std::int64_t, most_lanes> ray;  ///< -1: none
};

/// Takes each ray one voxel on, as VoxelWalk::advance does; those that have ended stay where they are.
HWY_INLINE void advance(Walk& w) {
  const IntegerVector step = step_on(w.next, w.delta, w.step);
  w.place = hn::Add(w.place, hn::BitCast(integers, hn::IfThenElseZero(w.live, hn::BitCast(doubles, step))));
}

/// Rays on their way through a field: `Field::visit(walk, row, exit)` adds what they find in the voxels that they are
/// in, and says which go no farther; `Field::ended(lane, ray, sum)` hears of each ray at its end.
template <class Field>
class Follower {
 public:
  Follower(const RaysThroughGrid& rays, Field& field)
      : field_(field), entries_(entries_of(rays)), max_range_(hn::Set(doubles, rays.max_range)) {
    for (Walk& w : walks_) {
      for (int axis = 0; axis < 3; ++axis)
        w.next[axis] = w.delta[axis] = hn::Zero(doubles), w.step[axis] = hn::Zero(integers);
      w.enter = w.left = w.sum = hn::Zero(doubles);
      w.place = hn::Zero(integers);
      w.live = hn::Lt(hn::Zero(doubles), hn::Zero(doubles));
      w.ray.fill(-1);
    }
  }

  void run() {
    for (Walk& w : walks_) refill(w);
    for (bool any = !entries_.entering.empty(); any;) {
      any = false;
      for (Walk& w : walks_) {
        if (live_count(w) <= few() && !refill(w)) continue;
        any = true;
        const Vector exit = hn::Min(hn::Min(w.next[0], w.next[1]), w.next[2]);
        const Mask ends = hn::Or(field_.visit(w, &w - walks_, exit), hn::Ge(exit, max_range_));
        w.live = hn::AndNot(ends, w.live);
        w.left = hn::IfThenElseZero(w.live, w.left);
        advance(w);
      }
    }
  }

 private:
  std::size_t live_count(const Walk& w) const { return hn::CountTrue(doubles, w.live); }
  /// So few lanes at work are worth the trouble of giving the others new rays.
  std::size_t few() const { return taken_ < entries_.entering.size() ? hn::Lanes(doubles) / 2 : 0; }

  /// Writes down what rays have found that have ended, and puts others in their lanes. Whether any is on its way.
  bool refill(Walk& w) {
    HWY_ALIGN std::int64_t fresh[most_lanes], which[most_lanes];
    HWY_ALIGN double found[most_lanes];
    hn::Store(w.sum, doubles, found);
    const unsigned live = bits_of(w.live);
    for (std::size_t lane = 0; lane < hn::Lanes(doubles); ++lane) {
      fresh[lane] = which[lane] = 0;
      if (live >> lane & 1) continue;
      if (w.ray[lane] >= 0) field_.ended((&w - walks_) * most_lanes + lane, std::size_t(w.ray[lane]), found[lane]);
      w.ray[lane] = -1;
      if (taken_ == entries_.entering.size()) continue;
      which[lane] = w.ray[lane] = entries_.entering[taken_++];
      fresh[lane] = -1;
    }
    const Mask is_fresh = mask_of(hn::Load(integers, fresh));
    begin(w, is_fresh, hn::Load(integers, which));
    return !hn::AllFalse(doubles, w.live);
  }

  void begin(Walk& w, Mask fresh, IntegerVector which) {
    const auto take = [&](const std::vector<double>& part, Vector& into) {
      into = hn::IfThenElse(fresh, hn::GatherIndex(doubles, part.data(), which), into);
    };
    const auto take_whole = [&](const std::vector<std::int64_t>& part, IntegerVector& into) {
      into = pick(fresh, hn::GatherIndex(integers, part.data(), which), into);
    };
    for (int axis = 0; axis < 3; ++axis) {
      take(entries_.parts[Entries::next + axis], w.next[axis]);
      take(entries_.parts[Entries::delta + axis], w.delta[axis]);
      take_whole(entries_.whole_parts[Entries::step + axis], w.step[axis]);
    }
    take(entries_.parts[Entries::enter], w.enter);
    take_whole(entries_.whole_parts[Entries::place], w.place);
    w.left = hn::IfThenElse(fresh, hn::Set(doubles, 1.0), w.left);
    w.sum = hn::IfThenElse(fresh, hn::Zero(doubles), w.sum);
    w.live = hn::Or(fresh, w.live);
  }

  Field& field_;
  Entries entries_;
  Vector max_range_;
  std::size_t taken_ = 0;  ///< of those that enter
  Walk walks_[rows];
};

}  // namespace nextview::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
