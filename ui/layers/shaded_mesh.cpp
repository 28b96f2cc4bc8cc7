#include "ui/layers/shaded_mesh.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "core/view/pose.hpp"

namespace nextview {
namespace {

constexpr std::size_t grain = 4096;  // elements a task

template <class Function>
void for_each(std::size_t count, const Function& function) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) function(i);
  });
}

/// A corner of a triangle is 3 * triangle + its place in it.
using Corner = std::uint32_t;

/// The corners at each vertex, in ascending order: those of vertex v from first[v] up to first[v + 1].
struct CornersOfVertices {
  std::vector<std::uint32_t> first;
  std::vector<Corner> corners;

  explicit CornersOfVertices(const TriangleMesh& mesh)
      : first(mesh.vertices.size() + 1, 0), corners(3 * mesh.triangles.size()) {
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t vertex : triangle) ++first[vertex + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) corners[next[mesh.triangles[t][c]]++] = Corner(3 * t + c);
  }
};

std::vector<Eigen::Vector3f> triangle_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> normals(mesh.triangles.size());
  for_each(normals.size(), [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vector3 at = mesh.vertices[a].cast<double>();
    const Vector3 normal = (mesh.vertices[b].cast<double>() - at).cross(mesh.vertices[c].cast<double>() - at);
    normals[t] = normal.normalized().cast<float>();
  });
  return normals;
}

/// Joins the corners around a vertex over shallow edges. Thread-local: it keeps its memory.
class Fan {
 public:
  /// Gives each of the corners the number of its group, in the order of their first corners, and returns how many
  /// groups there are.
  std::uint32_t group(const TriangleMesh& mesh, std::span<const Eigen::Vector3f> normals, float cosine,
                      std::span<const Corner> corners, std::vector<std::uint32_t>& group_of_corner) {
    parent_.resize(corners.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
    edges_.clear();
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      const auto& triangle = mesh.triangles[corners[i] / 3];
      const std::uint32_t place = corners[i] % 3;
      edges_.emplace_back(triangle[(place + 1) % 3], i);
      edges_.emplace_back(triangle[(place + 2) % 3], i);
    }
    std::sort(edges_.begin(), edges_.end());
    for (std::size_t e = 1; e < edges_.size(); ++e) {
      const auto [other, i] = edges_[e - 1];
      const auto [same, k] = edges_[e];
      if (other == same && normals[corners[i] / 3].dot(normals[corners[k] / 3]) > cosine) join(i, k);
    }
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < corners.size(); ++i)
      group_of_corner[corners[i]] = root(i) == i ? count++ : group_of_corner[corners[root(i)]];
    return count;
  }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The lower one is the root.
  void join(std::uint32_t i, std::uint32_t k) {
    const std::uint32_t a = root(i), b = root(k);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<std::uint32_t> parent_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;  ///< vertex at the other end, place in the corners
};

}  // namespace

ShadedMesh shaded(const TriangleMesh& mesh, double crease_angle) {
  const CornersOfVertices around(mesh);
  const std::vector<Eigen::Vector3f> normals = triangle_normals(mesh);
  const auto cosine = float(std::cos(crease_angle * std::numbers::pi / 180));
  const auto corners_of = [&](std::size_t vertex) {
    return std::span(around.corners).subspan(around.first[vertex], around.first[vertex + 1] - around.first[vertex]);
  };
  std::vector<std::uint32_t> group_of_corner(around.corners.size()), first_point(mesh.vertices.size() + 1, 0);
  for_each(mesh.vertices.size(), [&](std::size_t v) {
    thread_local Fan fan;
    first_point[v + 1] = fan.group(mesh, normals, cosine, corners_of(v), group_of_corner);
  });
  std::partial_sum(first_point.begin(), first_point.end(), first_point.begin());

  ShadedMesh result;
  result.vertices.resize(first_point.back());
  result.normals.assign(first_point.back(), Eigen::Vector3f::Zero());
  result.triangles.resize(mesh.triangles.size());
  for_each(mesh.vertices.size(), [&](std::size_t v) {
    for (const Corner corner : corners_of(v)) {
      const std::uint32_t point = first_point[v] + group_of_corner[corner];
      result.vertices[point] = std::uint32_t(v);
      result.normals[point] += normals[corner / 3];
      result.triangles[corner / 3][corner % 3] = point;
    }
    for (std::uint32_t point = first_point[v]; point < first_point[v + 1]; ++point) result.normals[point].normalize();
  });
  return result;
}

}  // namespace nextview
