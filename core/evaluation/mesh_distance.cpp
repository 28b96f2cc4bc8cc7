#include "core/evaluation/mesh_distance.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace nextview {
namespace {

constexpr std::size_t leaf_size = 4;

double squared_distance_to_segment(const Vector3& from_start, const Vector3& along) {
  const double length = along.squaredNorm();
  const double t = length > 0.0 ? std::clamp(along.dot(from_start) / length, 0.0, 1.0) : 0.0;
  return (from_start - t * along).squaredNorm();
}

/// A lower bound of it: a little less, for the rounding.
float squared_distance_to_box(const Eigen::Array4f& p, const Eigen::Array4f& lower, const Eigen::Array4f& upper) {
  return 0.99999f * (lower - p).max(p - upper).max(0.0f).matrix().squaredNorm();
}

Eigen::Array4f padded(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z(), 0.0f}; }

}  // namespace

MeshDistance::MeshDistance(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("distance to a mesh: the mesh has no triangles");
  order_.resize(mesh.triangles.size());
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(order_.size());
  build(mesh, 0, order_.size());
  triangles_.reserve(order_.size());
  for (const std::uint32_t t : order_) {
    const auto& [a, b, c] = mesh.triangles[t];
    triangles_.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  }
}

/// Splits at the median of the centroids along their longest side, so the tree's depth is the logarithm of its size.
void MeshDistance::build(const TriangleMesh& mesh, std::size_t begin, std::size_t end) {
  const auto thrice_centroid = [&](std::uint32_t t) -> Eigen::Vector3f {
    const auto& [a, b, c] = mesh.triangles[t];
    return mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c];
  };
  Eigen::AlignedBox3f box, centroids;
  for (std::size_t i = begin; i < end; ++i) {
    for (const std::uint32_t vertex : mesh.triangles[order_[i]]) box.extend(mesh.vertices[vertex]);
    centroids.extend(thrice_centroid(order_[i]));
  }
  const std::size_t node = nodes_.size();
  nodes_.push_back({padded(box.min()), padded(box.max()), static_cast<std::uint32_t>(begin)});
  if (end - begin <= leaf_size) {
    nodes_[node].count = static_cast<std::uint32_t>(end - begin);
    return;
  }
  int axis = 0;
  centroids.sizes().maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
    return thrice_centroid(a)[axis] < thrice_centroid(b)[axis];
  });
  build(mesh, begin, middle);
  nodes_[node].second = static_cast<std::uint32_t>(nodes_.size());
  build(mesh, middle, end);
}

/// Infinity if it is over `limit` at first sight. Where the point is not above the inside of the triangle, the nearest
/// point lies on an edge whose outer side faces the point. Holds for degenerate triangles too.
double MeshDistance::squared_distance(const Triangle& t, const Vector3& point, double limit) {
  double nearest = std::numeric_limits<double>::infinity();
  const Vector3 corner = t[0].cast<double>(), ab = t[1].cast<double>() - corner, ac = t[2].cast<double>() - corner;
  const Vector3 p = point - corner, normal = ab.cross(ac);
  const double height = normal.dot(p), whole = normal.squaredNorm();  // both times the parallelogram's area
  if (height * height > limit * whole) return nearest;
  // Barycentric coordinates of the foot of the point, times `whole`.
  const double b = normal.dot(p.cross(ac)), c = normal.dot(ab.cross(p)), a = whole - b - c;
  if (a > 0.0 && b > 0.0 && c > 0.0) return height * height / whole;
  if (a <= 0.0) nearest = std::min(nearest, squared_distance_to_segment(p - ab, ac - ab));
  if (b <= 0.0) nearest = std::min(nearest, squared_distance_to_segment(p, ac));
  if (c <= 0.0) nearest = std::min(nearest, squared_distance_to_segment(p, ab));
  return nearest;
}

double MeshDistance::operator()(const Eigen::Vector3f& point) const {
  struct Entry {
    std::uint32_t node;
    float squared_distance;
  };
  std::array<Entry, 64> stack;  // the tree is less deep than 32
  std::size_t entries = 0;
  double nearest = std::numeric_limits<double>::infinity();
  const Vector3 p = point.cast<double>();
  const Eigen::Array4f p4 = padded(point);
  stack[entries++] = {0, 0.0f};
  while (entries > 0) {
    const Entry entry = stack[--entries];
    if (entry.squared_distance >= nearest) continue;
    const Node& node = nodes_[entry.node];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      nearest = std::min(nearest, squared_distance(triangles_[i], p, nearest));
    if (node.count > 0) continue;
    const Node &first = nodes_[entry.node + 1], &second = nodes_[node.second];
    Entry near{entry.node + 1, squared_distance_to_box(p4, first.lower, first.upper)};
    Entry far{node.second, squared_distance_to_box(p4, second.lower, second.upper)};
    if (far.squared_distance < near.squared_distance) std::swap(near, far);
    if (far.squared_distance < nearest) stack[entries++] = far;
    if (near.squared_distance < nearest) stack[entries++] = near;
  }
  return std::sqrt(nearest);
}

}  // namespace nextview
