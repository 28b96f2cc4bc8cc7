#include "core/cloud/neighbour_distances.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <nanoflann.hpp>
#include <span>

#include "core/cloud/point_grid.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

/// The points as nanoflann asks for them. Building the tree is one call that asks all the time, so that is where a stop
/// gets through; searching asks from many threads, and has its own.
class TreePoints {
 public:
  TreePoints(const PointCloud& points, const std::stop_token& stop) : points_(points), stop_(stop) {}

  std::size_t kdtree_get_point_count() const { return points_.size(); }
  float kdtree_get_pt(std::size_t point, std::size_t axis) const {
    if (building_ && ++asked_ % (1 << 16) == 0) throw_if_stopped(stop_);
    return points_[point][Eigen::Index(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
  void built() { building_ = false; }

 private:
  const PointCloud& points_;
  const std::stop_token& stop_;
  bool building_ = true;
  mutable std::size_t asked_ = 0;
};

/// Of the nearest ones' squared distances, ascending, the point's own first.
float mean_distance(std::span<const float> squared, int neighbours) {
  double sum = 0.0;
  for (std::size_t k = 1; k < squared.size(); ++k) sum += std::sqrt(static_cast<double>(squared[k]));
  return static_cast<float>(sum / neighbours);
}

/// Those of `asked`, by a tree over all points.
void search_tree(const PointCloud& points, std::span<const std::uint32_t> asked, int neighbours,
                 std::vector<float>& distances, const std::stop_token& stop) {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, TreePoints>, TreePoints, 3,
                                                   std::uint32_t>;
  constexpr std::size_t largest_leaf = 15;  // PCL's
  TreePoints tree_points(points, stop);
  const Tree tree(3, tree_points, {largest_leaf});
  tree_points.built();
  const auto wanted = static_cast<std::size_t>(neighbours) + 1;  // one more: the point finds itself first
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, asked.size(), 1024), [&](const auto& range) {
    if (stop.stop_requested()) return;
    std::vector<std::uint32_t> indices(wanted);
    std::vector<float> squared(wanted);
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const std::size_t found = tree.knnSearch(points[asked[i]].data(), wanted, indices.data(), squared.data());
      distances[asked[i]] = mean_distance({squared.data(), found}, neighbours);
    }
  });
}

/// Those of all points for which a grid is enough; returns the others.
std::vector<std::uint32_t> search_grid(const PointGrid& grid, int neighbours, std::vector<float>& distances,
                                       const std::stop_token& stop) {
  const auto wanted = static_cast<std::size_t>(neighbours) + 1;
  std::vector<std::uint8_t> is_left(distances.size(), 1);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grid.size(), 512), [&](const auto& range) {
    if (stop.stop_requested()) return;
    std::vector<float> squared;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      if (!grid.nearest(i, wanted, squared)) continue;
      const std::uint32_t point = grid.number(i);
      distances[point] = mean_distance(squared, neighbours);
      is_left[point] = 0;
    }
  });
  std::vector<std::uint32_t> left;
  for (std::uint32_t i = 0; i < is_left.size(); ++i)
    if (is_left[i]) left.push_back(i);
  return left;
}

}  // namespace

std::vector<float> neighbour_distances(const PointCloud& points, int neighbours, const std::stop_token& stop) {
  std::vector<float> distances(points.size());
  const PointGrid grid(points, static_cast<std::size_t>(neighbours) + 1);
  throw_if_stopped(stop);
  const std::vector<std::uint32_t> left = search_grid(grid, neighbours, distances, stop);
  throw_if_stopped(stop);
  if (!left.empty()) search_tree(points, left, neighbours, distances, stop);
  throw_if_stopped(stop);
  return distances;
}

}  // namespace nextview
