// Included once for each instruction set (Highway's foreach_target), by those that follow rays in lanes.
#if defined(NEXTVIEW_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef NEXTVIEW_LANES
#undef NEXTVIEW_LANES
#else
#define NEXTVIEW_LANES
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Integers = hn::RebindToSigned<Doubles>;
using Vector = hn::Vec<Doubles>;
using IntegerVector = hn::Vec<Integers>;
using Mask = hn::Mask<Doubles>;
using Floats = hn::Rebind<float, Doubles>;
using FloatVector = hn::Vec<Floats>;

constexpr Doubles doubles;
constexpr Integers integers;
constexpr Floats floats;
constexpr std::size_t most_lanes = hn::MaxLanes(doubles);

HWY_INLINE IntegerVector pick(Mask mask, IntegerVector yes, IntegerVector no) {
  return hn::BitCast(integers, hn::IfThenElse(mask, hn::BitCast(doubles, yes), hn::BitCast(doubles, no)));
}

/// Takes each ray to its next face, as VoxelWalk::advance does: what its place grows by.
HWY_INLINE IntegerVector step_on(Vector (&next)[3], const Vector (&delta)[3], const IntegerVector (&step)[3]) {
  const Mask x_before_y = hn::Lt(next[0], next[1]);
  const Mask along_x = hn::And(x_before_y, hn::Lt(next[0], next[2]));
  const Mask along_y = hn::AndNot(x_before_y, hn::Lt(next[1], next[2]));
  next[0] = hn::IfThenElse(along_x, hn::Add(next[0], delta[0]), next[0]);
  next[1] = hn::IfThenElse(along_y, hn::Add(next[1], delta[1]), next[1]);
  next[2] = hn::IfThenElse(hn::Or(along_x, along_y), next[2], hn::Add(next[2], delta[2]));
  return pick(along_x, step[0], pick(along_y, step[1], step[2]));
}

HWY_INLINE Mask none() { return hn::Lt(hn::Zero(doubles), hn::Zero(doubles)); }

/// As ray_length has it.
HWY_INLINE Vector length_of(const FloatVector (&way)[3]) {
  const FloatVector squares =
      hn::Add(hn::Add(hn::Mul(way[0], way[0]), hn::Mul(way[1], way[1])), hn::Mul(way[2], way[2]));
  return hn::Sqrt(hn::PromoteTo(doubles, squares));
}

}  // namespace nextview::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
