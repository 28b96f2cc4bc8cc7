#include "core/map/distance_transform.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

namespace nextview {
namespace {

/// The lower envelope of the parabolas (x - i)^2 + height[i], in place.
class Envelope {
 public:
  explicit Envelope(int longest) : heights(longest), sites(longest), starts(longest) {}

  void lower(std::int32_t* values, std::size_t stride, int length) {
    // What lies beyond a zero changes nothing on this side of it.
    for (int first = 0, last = 1; last < length; first = last++) {
      while (last + 1 < length && values[last * stride] != 0) ++last;
      if (last > first + 1 || values[first * stride] != 0 || values[last * stride] != 0)
        lower_between(values + first * stride, stride, last - first + 1);
    }
  }

 private:
  void lower_between(std::int32_t* values, std::size_t stride, int length) {
    for (int i = 0; i < length; ++i) heights[i] = values[i * stride];
    int last = -1;
    for (int i = 0; i < length; ++i) {
      if (heights[i] >= infinitely_far) continue;
      while (last >= 0 && at(sites[last], starts[last]) > at(i, starts[last])) --last;
      if (last < 0) {
        last = 0, sites[0] = i, starts[0] = 0;
        continue;
      }
      const int start = 1 + overtakes(sites[last], i);
      if (start < length) ++last, sites[last] = i, starts[last] = start;
    }
    if (last < 0) return;  // nothing is near this line
    for (int x = length - 1; x >= 0; --x) {
      values[x * stride] = at(sites[last], x);
      if (x == starts[last]) --last;
    }
  }
  std::int32_t at(int site, int x) const { return (x - site) * (x - site) + heights[site]; }
  /// The last place where `left` is not above `right`.
  int overtakes(int left, int right) const {
    const std::int32_t above = right * right - left * left + heights[right] - heights[left];
    if (right - left == 1) return above >> 1;  // most often, and without a division
    const std::int32_t twice = 2 * (right - left);
    return above >= 0 ? above / twice : -((-above + twice - 1) / twice);
  }

  std::vector<std::int32_t> heights;
  std::vector<int> sites, starts;
};

constexpr int width = 8;               // of a slab [voxels]
constexpr std::int32_t far = 1 << 14;  // whose square is infinitely_far
static_assert(far * far == infinitely_far);

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

/// Distances in a part of the box, `width` voxels along x and all of it along y and z: so that they stay in the cache.
class Slab {
 public:
  explicit Slab(const Eigen::Vector3i& size)
      : size_(size),
        squared_(std::size_t(width) * size.y() * size.z()),
        of_row_(std::size_t(size.y())),
        envelope_(std::max(size.y(), size.z())) {}

  /// Those of `from` in the slab, where `distances` has them by their rank.
  void measure(const BitRows& from, const BitRows& to, int slab, const std::vector<std::uint32_t>& counts,
               std::vector<std::int32_t>& distances) {
    const std::uint8_t wanted = look_for(from, slab);
    if (wanted == 0) return;
    each([&](int y, int z) { square_along_row(to.row(y, z), slab, &squared_[place(y, z)]); });
    for (int x = 0; x < width; ++x) {
      if (!(wanted >> x & 1)) continue;
      for (int z = 0; z < size_.z(); ++z) envelope_.lower(&squared_[place(0, z) + x], width, size_.y());
      for (int y = 0; y < size_.y(); ++y)
        if (of_row_[y] >> x & 1) envelope_.lower(&squared_[place(y, 0) + x], place(0, 1), size_.z());
    }
    each([&](int y, int z) {
      const std::uint8_t here = in_slab(from.row(y, z), slab);
      if (here == 0) return;
      std::size_t to_be_set = from.rank({slab * width, y, z}, counts);
      for (unsigned bits = here; bits != 0; bits &= bits - 1)
        distances[to_be_set++] = squared_[place(y, z) + std::size_t(std::countr_zero(bits))];
    });
  }

 private:
  std::size_t place(int y, int z) const { return (std::size_t(z) * size_.y() + y) * width; }
  template <class Visit>
  void each(Visit visit) const {
    for (int z = 0; z < size_.z(); ++z)
      for (int y = 0; y < size_.y(); ++y) visit(y, z);
  }
  /// At which x any distance is wanted; at each y it stands in of_row_.
  std::uint8_t look_for(const BitRows& from, int slab) {
    std::ranges::fill(of_row_, std::uint8_t{0});
    std::uint8_t any = 0;
    each([&](int y, int z) { any |= of_row_[y] |= in_slab(from.row(y, z), slab); });
    return any;
  }
  /// The squared distance to the nearest flag in the same row: going up to the one before, coming back to the one
  /// after.
  static void square_along_row(std::span<const std::uint64_t> row, int slab, std::int32_t* squared) {
    const unsigned flags = in_slab(row, slab);
    if (flags == 0xff) {
      std::fill_n(squared, width, 0);
      return;
    }
    std::int32_t distance = to_lower(row, slab * width) - 1;
    for (int x = 0; x < width; ++x) squared[x] = distance = flags >> x & 1 ? 0 : std::min(distance + 1, far);
    distance = to_upper(row, slab * width + width - 1) - 1;
    for (int x = width; x-- > 0;) {
      distance = std::min(squared[x], std::min(distance + 1, far));
      squared[x] = distance * distance;
    }
  }

  Eigen::Vector3i size_;
  std::vector<std::int32_t> squared_;
  std::vector<std::uint8_t> of_row_;  ///< by y: at which x any distance is wanted
  Envelope envelope_;
};

}  // namespace

std::vector<std::int32_t> squared_distances(const BitRows& from, const BitRows& to) {
  const Eigen::Vector3i& size = from.size();
  if (size != to.size()) throw std::invalid_argument("distance transform: boxes of different sizes");
  const std::vector<std::uint32_t> counts = from.counts_before();
  std::vector<std::int32_t> distances(counts.back());
  if (distances.empty()) return distances;
  tbb::enumerable_thread_specific<Slab> slabs([&] { return Slab(size); });
  tbb::parallel_for(0, (size.x() + width - 1) / width,
                    [&](int slab) { slabs.local().measure(from, to, slab, counts, distances); });
  return distances;
}

}  // namespace nextview
