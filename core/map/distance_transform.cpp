// Compiled once for each instruction set (Highway's foreach_target); the processor's best is chosen when it runs.
#include "core/map/distance_transform.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/map/distance_transform.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int width = 8;               // of a slab [voxels]: so many are worked on at once
constexpr std::int32_t far = 1 << 14;  // whose square is infinitely_far
static_assert(far * far == infinitely_far);

/// Of voxels beside each other along x.
struct alignas(width * sizeof(std::int32_t)) Lanes : std::array<std::int32_t, width> {};

/// Those of a row that lie in a slab, the lowest bit first.
std::uint8_t in_slab(std::span<const std::uint64_t> row, int slab) {
  return static_cast<std::uint8_t>(row[std::size_t(slab) * width / 64] >> (slab * width % 64));
}

/// From a place in a row to the next set flag below it, or above, itself left out [voxels]; `far` if there is none.
std::int32_t to_lower(std::span<const std::uint64_t> row, int x) {
  std::size_t w = std::size_t(x) / 64;
  std::uint64_t bits = row[w] & ((std::uint64_t{1} << (x % 64)) - 1);
  while (bits == 0 && w > 0) bits = row[--w];
  return bits == 0 ? far : x - (static_cast<int>(64 * w) + 63 - std::countl_zero(bits));
}
std::int32_t to_upper(std::span<const std::uint64_t> row, int x) {
  std::size_t w = std::size_t(x + 1) / 64;
  if (w >= row.size()) return far;
  std::uint64_t bits = row[w] & ~std::uint64_t{0} << ((x + 1) % 64);
  while (bits == 0 && ++w < row.size()) bits = row[w];
  return bits == 0 ? far : static_cast<int>(64 * w) + std::countr_zero(bits) - x;
}

/// From each of eight places to the nearest that has a flag, by the eight flags; 255 if none has.
constexpr auto within_slab = [] {
  std::array<std::array<std::uint8_t, width>, 256> nearest{};
  for (int flags = 0; flags < 256; ++flags)
    for (int x = 0; x < width; ++x) {
      std::uint8_t& distance = nearest[std::size_t(flags)][std::size_t(x)] = 255;
      for (int other = 0; other < width; ++other)
        if (flags >> other & 1) distance = std::min<std::uint8_t>(distance, other < x ? x - other : other - x);
    }
  return nearest;
}();

/// Of the wanted lanes the least of (i - k)^2 + line[k], where `line` has so many, `stride` apart: looked for on both
/// sides of i, no farther than it may still be found. Other lanes are anything.
HWY_INLINE Lanes least_along(const Lanes* line, std::size_t stride, int length, int i, std::uint8_t wanted) {
  const hn::CappedTag<std::int32_t, width> tag;
  Lanes result;
  for (std::size_t part = 0; part < width; part += hn::Lanes(tag)) {
    const auto at = [&](int k) HWY_ATTR { return hn::Load(tag, &line[std::size_t(k) * stride][part]); };
    const std::uint8_t bits[8] = {static_cast<std::uint8_t>(wanted >> part)};  // so many are read
    const auto is_wanted = hn::LoadMaskBits(tag, bits);
    auto least = at(i);
    for (int away = 1;; ++away) {
      const auto squared = hn::Set(tag, away * away);
      const bool below = i - away >= 0, above = i + away < length;
      if (!(below || above) || hn::AllFalse(tag, hn::And(is_wanted, hn::Lt(squared, least)))) break;
      if (below) least = hn::Min(least, hn::Add(at(i - away), squared));
      if (above) least = hn::Min(least, hn::Add(at(i + away), squared));
    }
    hn::Store(least, tag, &result[part]);
  }
  return result;
}

/// Distances in a part of the box, `width` voxels along x and all of it along y and z: so that they stay in the cache.
class Slab {
 public:
  explicit Slab(const Eigen::Vector3i& size)
      : size_(size),
        along_x_(std::size_t(size.y()) * size.z()),
        along_xy_(along_x_.size()),
        wanted_at_(std::size_t(size.y())) {}

  /// Those of `from` in the slab, where `distances` has them by their rank.
  void measure(const BitRows& from, const BitRows& to, int slab, const std::vector<std::uint32_t>& counts,
               std::vector<std::int32_t>& distances) {
    if (!look_for(from, slab)) return;
    for (int z = 0; z < size_.z(); ++z) {
      for (int y = 0; y < size_.y(); ++y) along_x_[place(y, z)] = square_along_row(to.row(y, z), slab);
      for (int y = 0; y < size_.y(); ++y)
        if (wanted_at_[y] != 0)
          along_xy_[place(y, z)] = least_along(&along_x_[place(0, z)], 1, size_.y(), y, wanted_at_[y]);
    }
    each([&](int y, int z) {
      const std::uint8_t here = in_slab(from.row(y, z), slab);
      if (here == 0) return;
      const Lanes squared = least_along(&along_xy_[place(y, 0)], place(0, 1), size_.z(), z, here);
      std::size_t to_be_set = from.rank({slab * width, y, z}, counts);
      for (unsigned bits = here; bits != 0; bits &= bits - 1)
        distances[to_be_set++] = squared[std::size_t(std::countr_zero(bits))];
    });
  }

 private:
  std::size_t place(int y, int z) const { return std::size_t(z) * size_.y() + y; }
  template <class Visit>
  void each(Visit visit) const {
    for (int z = 0; z < size_.z(); ++z)
      for (int y = 0; y < size_.y(); ++y) visit(y, z);
  }
  /// Whether any distance is wanted; at each y wanted_at_ says at which x.
  bool look_for(const BitRows& from, int slab) {
    std::ranges::fill(wanted_at_, std::uint8_t{0});
    std::uint8_t any = 0;
    each([&](int y, int z) { any |= wanted_at_[y] |= in_slab(from.row(y, z), slab); });
    return any != 0;
  }
  /// To the nearest flag in the same row.
  static Lanes square_along_row(std::span<const std::uint64_t> row, int slab) {
    const std::uint8_t flags = in_slab(row, slab);
    if (flags == 0xff) return {};
    const std::int32_t lower = to_lower(row, slab * width), upper = to_upper(row, slab * width + width - 1);
    Lanes squared;
    for (int x = 0; x < width; ++x) {
      const std::int32_t within = flags == 0 ? far : within_slab[flags][x];
      const std::int32_t distance = std::min({within, lower + x, upper + width - 1 - x, far});
      squared[x] = distance * distance;
    }
    return squared;
  }

  Eigen::Vector3i size_;
  std::vector<Lanes> along_x_, along_xy_;  ///< squared distances along the axes
  std::vector<std::uint8_t> wanted_at_;    ///< by y: at which x any distance is wanted
};

}  // namespace

void measure_slabs(const BitRows& from, const BitRows& to, const std::vector<std::uint32_t>& counts,
                   std::vector<std::int32_t>& distances) {
  const Eigen::Vector3i& size = from.size();
  tbb::enumerable_thread_specific<Slab> slabs([&] { return Slab(size); });
  tbb::parallel_for(0, (size.x() + width - 1) / width,
                    [&](int slab) { slabs.local().measure(from, to, slab, counts, distances); });
}

}  // namespace nextview::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nextview {

HWY_EXPORT(measure_slabs);

std::vector<std::int32_t> squared_distances(const BitRows& from, const BitRows& to) {
  if (from.size() != to.size()) throw std::invalid_argument("distance transform: boxes of different sizes");
  const std::vector<std::uint32_t> counts = from.counts_before();
  std::vector<std::int32_t> distances(counts.back());
  if (!distances.empty()) HWY_DYNAMIC_DISPATCH(measure_slabs)(from, to, counts, distances);
  return distances;
}

}  // namespace nextview
#endif
