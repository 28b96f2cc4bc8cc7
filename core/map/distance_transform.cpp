#include "core/map/distance_transform.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace nextview {
namespace {

void require_as_many(std::size_t values, const Eigen::Vector3i& size) {
  if ((size.array() < 0).any() || values != std::size_t(size.x()) * size.y() * size.z())
    throw std::invalid_argument("distance transform: the values are not as many as the voxels");
}

/// Calls `visit(first, scratch)` for the first voxel of each line along an axis, several at once.
template <class Scratch, class Visit>
void for_each_line(const Eigen::Vector3i& size, int axis, Visit visit) {
  const Eigen::Vector3<std::size_t> stride(1, size.x(), std::size_t(size.x()) * size.y());
  // Lines after one another lie side by side: what one brings into the cache the next ones find there.
  const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  const std::size_t lines = std::size_t(size[u]) * size[v];
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lines, 64), [&](const auto& range) {
    Scratch scratch(size[axis]);
    for (std::size_t line = range.begin(); line != range.end(); ++line)
      visit(line % size[u] * stride[u] + line / size[u] * stride[v], stride[axis], scratch);
  });
}

/// The lower envelope of the parabolas (x - i)^2 + height[i], in place.
struct Envelope {
  explicit Envelope(int length) : heights(length), sites(length), starts(length) {}

  void lower(std::int32_t* values, std::size_t stride) {
    const int length = static_cast<int>(heights.size());
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
      values[x * stride] = static_cast<std::int32_t>(at(sites[last], x));
      if (x == starts[last]) --last;
    }
  }

 private:
  std::int64_t at(int site, int x) const { return std::int64_t(x - site) * (x - site) + heights[site]; }
  /// The last place where `left` is not above `right`.
  int overtakes(int left, int right) const {
    const std::int64_t above = std::int64_t(right) * right - std::int64_t(left) * left + heights[right] - heights[left];
    if (right - left == 1) return static_cast<int>(above >> 1);  // most often, and without a division
    const std::int64_t twice = 2 * (right - left);
    return static_cast<int>(above >= 0 ? above / twice : -((-above + twice - 1) / twice));
  }

  std::vector<std::int32_t> heights;
  std::vector<int> sites, starts;
};

/// The squared distance to the nearest feature in the same row: going up to the one before, coming back to the one
/// after.
void square_along_row(std::span<const std::uint8_t> is_feature, std::int32_t* squared) {
  constexpr std::int32_t far = 1 << 14;  // whose square is infinitely_far
  static_assert(far * far == infinitely_far);
  std::int32_t distance = far;
  for (std::size_t x = 0; x < is_feature.size(); ++x)
    squared[x] = distance = is_feature[x] ? 0 : std::min(distance + 1, far);
  distance = far;
  for (std::size_t x = is_feature.size(); x-- > 0;) {
    distance = std::min(squared[x], std::min(distance + 1, far));
    squared[x] = distance * distance;
  }
}

}  // namespace

std::vector<std::int32_t> squared_distances(std::span<const std::uint8_t> is_feature, const Eigen::Vector3i& size) {
  require_as_many(is_feature.size(), size);
  std::vector<std::int32_t> squared(is_feature.size());
  if (squared.empty()) return squared;
  const auto length = std::size_t(size.x());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, squared.size() / length, 64), [&](const auto& rows) {
    for (std::size_t row = rows.begin(); row != rows.end(); ++row)
      square_along_row(is_feature.subspan(row * length, length), &squared[row * length]);
  });
  for (const int axis : {1, 2})
    for_each_line<Envelope>(size, axis, [&](std::size_t first, std::size_t stride, Envelope& envelope) {
      envelope.lower(&squared[first], stride);
    });
  return squared;
}

std::vector<std::uint8_t> neighbour_counts(std::span<const std::uint8_t> is_feature, const Eigen::Vector3i& size) {
  require_as_many(is_feature.size(), size);
  std::vector<std::uint8_t> counts(is_feature.size());
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = is_feature[i] != 0;
  if (counts.empty()) return counts;
  for (int axis = 0; axis < 3; ++axis)  // a box's sum is three sums along lines
    for_each_line<std::vector<std::uint8_t>>(
        size, axis, [&](std::size_t first, std::size_t stride, std::vector<std::uint8_t>& line) {
          for (std::size_t i = 0; i < line.size(); ++i) line[i] = counts[first + i * stride];
          for (std::size_t i = 0; i < line.size(); ++i)
            counts[first + i * stride] = static_cast<std::uint8_t>(line[i] + (i > 0 ? line[i - 1] : 0) +
                                                                   (i + 1 < line.size() ? line[i + 1] : 0));
        });
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] -= is_feature[i] != 0;
  return counts;
}

}  // namespace nextview
