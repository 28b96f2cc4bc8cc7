#include "core/cloud/point_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace nextview {
namespace {

constexpr std::size_t most_cells = std::size_t{1} << 22;
constexpr float margin = 0.2f;           // around most of the points, as a share of their extent
constexpr float far_off = 2.0f;          // points make everything so much larger than it is without them
constexpr std::size_t looked_at = 4096;  // points that say where most of them are

/// Where the points are, or most of them where others lie far off. Empty if there are none, or some are no points.
Eigen::AlignedBox3f box_of_most(const PointCloud& points) {
  Eigen::AlignedBox3f all;
  for (const Eigen::Vector3f& p : points) all.extend(p);
  const std::size_t stride = points.size() / looked_at + 1;
  Eigen::Vector3f lower = all.min(), upper = all.max();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> along;
    for (std::size_t i = 0; i < points.size(); i += stride) along.push_back(points[i][axis]);
    if (!std::ranges::all_of(along, [](float v) { return std::isfinite(v); })) return {};
    std::ranges::sort(along);
    const std::size_t outliers = along.size() / 100;
    lower[axis] = along[outliers], upper[axis] = along[along.size() - 1 - outliers];
  }
  const float extent = (upper - lower).maxCoeff();
  if (all.sizes().maxCoeff() <= far_off * extent) return all;
  const Eigen::Vector3f around = Eigen::Vector3f::Constant(margin * extent);
  return {lower - around, upper + around};
}

/// An edge of cells with which the `wanted` nearest ones of most points lie in the cells around it: on a surface, a
/// circle as wide as a cell and its neighbours has them.
double edge_for(const std::vector<std::uint32_t>& counts, double edge, std::size_t wanted) {
  double points = 0.0, squares = 0.0;
  for (const std::uint32_t count : counts) points += count, squares += double(count) * count;
  const double in_cell = squares / std::max(points, 1.0);  // of a point's own cell, on average
  return edge * std::sqrt(0.45 * double(wanted) / std::max(in_cell, 1e-3));
}

/// Puts the `wanted` least of `values` in front, ascending, and drops the others. Squared distances of points on a
/// surface are spread evenly: buckets that hold one or two each leave next to nothing to compare.
void keep_least(std::vector<float>& values, std::size_t wanted) {
  constexpr std::size_t buckets = 128;
  const float most = values.empty() ? 0.0f : std::ranges::max(values), scale = float(buckets - 1) / most;
  if (values.size() < 8 || !std::isnormal(scale)) {
    std::ranges::sort(values);
    values.resize(std::min(values.size(), wanted));
    return;
  }
  const auto bucket = [&](float value) { return std::size_t(value * scale); };
  std::array<std::uint32_t, buckets + 1> ends{};
  for (const float value : values) ++ends[bucket(value)];
  std::inclusive_scan(ends.begin(), ends.end(), ends.begin());
  thread_local std::vector<float> sorted;
  sorted.resize(values.size());
  std::array<std::uint32_t, buckets + 1> begins = ends;
  for (const float value : values) sorted[--begins[bucket(value)]] = value;
  for (std::size_t b = 0; b < buckets && begins[b] < wanted; ++b)
    if (ends[b] - begins[b] > 1) std::sort(sorted.begin() + begins[b], sorted.begin() + ends[b]);
  values.assign(sorted.begin(), sorted.begin() + std::ptrdiff_t(std::min(values.size(), wanted)));
}

}  // namespace

Eigen::Vector3i PointGrid::cell(const Eigen::Vector3f& point) const {
  // Cut off, not rounded down, which would be a call each: what is below 0 is in the first cell either way.
  return ((point - lower_) / edge_).array().cast<int>().min(size_.array() - 1).max(0);
}

PointGrid::PointGrid(const PointCloud& points, std::size_t wanted) {
  if (points.empty()) return;
  const Eigen::AlignedBox3f box = box_of_most(points);
  if (box.isEmpty() || !(box.sizes().maxCoeff() > 0.0f)) return;
  lower_ = box.min(), upper_ = box.max();
  rounding_ = 1e-6f * std::max(lower_.cwiseAbs().maxCoeff(), upper_.cwiseAbs().maxCoeff());
  std::vector<std::uint32_t> inside;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (box.contains(points[i])) inside.push_back(i);
  holds_all_ = inside.size() == points.size();
  const auto set_edge = [&](double edge) {  // no finer than there is room for
    const Eigen::Vector3d extent = box.sizes().cast<double>();
    const auto cells = [&](double e) { return ((extent / e).array().floor() + 1.0).prod(); };
    while (cells(edge) > double(most_cells)) edge *= 1.1;
    edge_ = float(edge);
    size_ = (extent / double(edge_)).array().floor().cast<int>() + 1;
  };
  set_edge(box.sizes().maxCoeff() / 64.0);
  std::vector<std::uint32_t> counts(std::size_t(size_.prod()));
  for (const std::uint32_t i : inside) {
    const Eigen::Vector3i c = cell(points[i]);
    ++counts[index(c.x(), c.y(), c.z())];
  }
  set_edge(edge_for(counts, edge_, wanted));
  sort_into_cells(points, inside);
}

void PointGrid::sort_into_cells(const PointCloud& points, const std::vector<std::uint32_t>& inside) {
  std::vector<std::uint32_t> cells(inside.size());
  begins_.assign(std::size_t(size_.x()) * size_.y() * size_.z() + 1, 0);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const Eigen::Vector3i c = cell(points[inside[i]]);
    cells[i] = std::uint32_t(index(c.x(), c.y(), c.z()));
    ++begins_[cells[i] + 1];
  }
  std::inclusive_scan(begins_.begin(), begins_.end(), begins_.begin());
  std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
  points_.resize(inside.size());
  numbers_.resize(inside.size());
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const std::uint32_t at = next[cells[i]]++;
    points_[at] = points[inside[i]];
    numbers_[at] = inside[i];
  }
}

/// The squared distances, under `limit`, of the points in the cells that are at most `ring` from the middle one along
/// each axis.
void PointGrid::gather_within(const Eigen::Vector3f& point, const Eigen::Vector3i& middle, int ring, float limit,
                              std::vector<float>& squared) const {
  const Eigen::Vector3i first = (middle.array() - ring).max(0), last = (middle.array() + ring).min(size_.array() - 1);
  std::size_t count = 0;
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y) {
      const std::uint32_t begin = begins_[index(first.x(), y, z)], end = begins_[index(last.x(), y, z) + 1];
      if (squared.size() < count + (end - begin)) squared.resize(2 * (count + (end - begin)));
      for (std::uint32_t k = begin; k < end; ++k) {
        const Eigen::Vector3f way = point - points_[k];
        squared[count] = way.x() * way.x() + way.y() * way.y() + way.z() * way.z();
        count += squared[count] < limit;
      }
    }
  squared.resize(count);
}

bool PointGrid::nearest(std::size_t i, std::size_t wanted, std::vector<float>& squared) const {
  const Eigen::Vector3f& point = points_[i];
  const Eigen::Vector3i middle = cell(point);
  const float safety = 1.0f - 1e-4f;  // far more than single precision rounds
  const Eigen::Vector3f in_cell = point - (lower_ + edge_ * middle.cast<float>());
  const float to_face = std::max(0.0f, std::min(in_cell.minCoeff(), edge_ - in_cell.maxCoeff()));
  const int last_ring = std::max(middle.maxCoeff(), (size_ - middle).maxCoeff());
  for (int ring = 1;; ring = std::min(2 * ring, last_ring)) {
    // Whatever is nearer than this lies in the block of cells, however coordinates round.
    float covered = std::max(0.0f, safety * (float(ring) * edge_ + to_face) - rounding_);
    if (ring >= last_ring) covered = std::numeric_limits<float>::infinity();
    gather_within(point, middle, ring, covered * covered, squared);
    if (squared.size() < wanted && ring < last_ring) continue;
    keep_least(squared, wanted);
    const float to_outside = std::min((point - lower_).minCoeff(), (upper_ - point).minCoeff());
    const float inside = std::max(0.0f, safety * to_outside - rounding_);
    return holds_all_ || (squared.size() == wanted && squared.back() < inside * inside);
  }
}

}  // namespace nextview
