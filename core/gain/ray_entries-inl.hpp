// Included once for each instruction set (Highway's foreach_target), by ray_lanes.cpp.
#if defined(NEXTVIEW_RAY_ENTRIES) == defined(HWY_TARGET_TOGGLE)
#ifdef NEXTVIEW_RAY_ENTRIES
#undef NEXTVIEW_RAY_ENTRIES
#else
#define NEXTVIEW_RAY_ENTRIES
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "core/gain/ray_lanes.hpp"
#include "core/map/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE unsigned bits_of(Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(doubles, mask, bytes);
  return bytes[0];
}
HWY_INLINE Mask mask_of(IntegerVector ones) { return hn::MaskFromVec(hn::BitCast(doubles, ones)); }

/// Where rays enter the grid and how they go on, as walk_ray_segments has it; of all rays of a camera, one value each.
struct Entries {
  explicit Entries(std::size_t rays) : stride((rays + most_lanes - 1) / most_lanes * most_lanes) {
    for (auto& part : parts) part.resize(stride);
    for (auto& part : whole_parts) part.resize(stride);
  }
  enum { next, delta = 3, enter = 6 };  // three, three and one
  enum { step, place = 3 };             // three and one
  std::size_t stride;
  std::array<std::vector<double>, 7> parts;
  std::array<std::vector<std::int64_t>, 4> whole_parts;
  std::vector<std::uint32_t> entering;  ///< the rays that do
};

/// Of the lanes' rays from `first` on; `from` are their directions, three numbers each for all lanes.
HWY_INLINE void enter_grid(const RaysThroughGrid& rays, const double* from, std::size_t first, std::size_t count,
                           Entries& entries) {
  const VoxelGrid& grid = rays.grid;
  const Vector zero = hn::Zero(doubles), one = hn::Set(doubles, 1.0);
  const Vector never = hn::Set(doubles, std::numeric_limits<double>::max());
  Vector direction[3], enter = zero, leave = hn::Set(doubles, rays.max_range), entry_axis = hn::Set(doubles, -1.0);
  hn::LoadInterleaved3(doubles, from, direction[0], direction[1], direction[2]);
  Mask inside = hn::FirstN(doubles, count);
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = grid.lower()[axis], upper = grid.upper()[axis], origin = rays.origin[axis];
    const Mask still = hn::Eq(direction[axis], zero);
    if (origin < lower || origin >= upper) inside = hn::AndNot(still, inside);
    const Vector to_lower = hn::Div(hn::Set(doubles, lower - origin), direction[axis]);
    const Vector to_upper = hn::Div(hn::Set(doubles, upper - origin), direction[axis]);
    const Vector near = hn::Min(to_lower, to_upper), far = hn::Max(to_lower, to_upper);
    const Mask later = hn::AndNot(still, hn::Gt(near, enter));
    enter = hn::IfThenElse(later, near, enter);
    entry_axis = hn::IfThenElse(later, hn::Set(doubles, axis), entry_axis);
    leave = hn::IfThenElse(still, leave, hn::Min(leave, far));
  }
  inside = hn::And(inside, hn::Lt(enter, leave));
  Vector place = zero;
  double stride = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = grid.resolution, origin = rays.origin[axis], last = grid.size[axis] - 1.0;
    const Mask forward = hn::Gt(direction[axis], zero), still = hn::Eq(direction[axis], zero);
    const Vector at = hn::Add(hn::Set(doubles, origin), hn::Mul(enter, direction[axis]));
    Vector cell = hn::Sub(hn::Floor(hn::Mul(at, hn::Set(doubles, 1.0 / edge))), hn::Set(doubles, grid.first[axis]));
    cell = hn::Min(hn::Max(cell, zero), hn::Set(doubles, last));
    const Vector at_face = hn::IfThenElse(forward, zero, hn::Set(doubles, last));
    cell = hn::IfThenElse(hn::Eq(entry_axis, hn::Set(doubles, axis)), at_face, cell);
    // As set_axis.
    const Vector sign = hn::IfThenElse(still, zero, hn::IfThenElse(forward, one, hn::Set(doubles, -1.0)));
    const Vector half = hn::Set(doubles, static_cast<float>(edge * 0.5));
    const Vector middle = hn::Mul(hn::Add(hn::Add(cell, hn::Set(doubles, grid.first[axis])), hn::Set(doubles, 0.5)),
                                  hn::Set(doubles, edge));
    const Vector face = hn::Add(middle, hn::Mul(sign, half));
    const Vector next = hn::Div(hn::Sub(face, hn::Set(doubles, origin)), direction[axis]);
    const Vector delta = hn::Div(hn::Set(doubles, edge), hn::Abs(direction[axis]));
    hn::StoreU(hn::IfThenElse(still, never, next), doubles, &entries.parts[Entries::next + axis][first]);
    hn::StoreU(hn::IfThenElse(still, never, delta), doubles, &entries.parts[Entries::delta + axis][first]);
    const Vector step = hn::Mul(sign, hn::Set(doubles, stride));
    hn::StoreU(hn::ConvertTo(integers, step), integers, &entries.whole_parts[Entries::step + axis][first]);
    place = hn::Add(place, hn::Mul(hn::Add(cell, one), hn::Set(doubles, stride)));
    stride *= grid.size[axis] + 2.0;
  }
  hn::StoreU(enter, doubles, &entries.parts[Entries::enter][first]);
  hn::StoreU(hn::ConvertTo(integers, hn::IfThenElseZero(inside, place)), integers,
             &entries.whole_parts[Entries::place][first]);
  for (unsigned bits = bits_of(inside); bits != 0; bits &= bits - 1)
    entries.entering.push_back(static_cast<std::uint32_t>(first) + std::countr_zero(bits));
}

Entries entries_of(const RaysThroughGrid& rays) {
  const std::size_t lanes = hn::Lanes(doubles), count = rays.directions.size();
  Entries entries(count);
  for (std::size_t first = 0; first < count; first += lanes) {
    const std::size_t some = std::min(lanes, count - first);
    std::array<double, 3 * most_lanes> padded{};
    if (some < lanes) std::copy_n(rays.directions[first].data(), 3 * some, padded.begin());
    enter_grid(rays, some < lanes ? padded.data() : rays.directions[first].data(), first, some, entries);
  }
  return entries;
}

}  // namespace nextview::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
