#include "core/mesh/surface_samples.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/mesh/triangle_mesh.hpp"
#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

/// The area up to and including each triangle [m^2].
std::vector<double> cumulated_area(const TriangleMesh& mesh) {
  std::vector<double> cumulated;
  cumulated.reserve(mesh.triangles.size());
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d origin = mesh.vertices[a].cast<double>();
    area += 0.5 * (mesh.vertices[b].cast<double>() - origin).cross(mesh.vertices[c].cast<double>() - origin).norm();
    cumulated.push_back(area);
  }
  return cumulated;
}

/// Uniform over the triangle for u, v uniform in (0, 1): the root makes up for the triangle narrowing towards its
/// corner.
Eigen::Vector3f point_in(const TriangleMesh& mesh, std::uint32_t triangle, double u, double v) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const double root = std::sqrt(u);
  const Eigen::Vector3d point = (1.0 - root) * mesh.vertices[a].cast<double>() +
                                root * (1.0 - v) * mesh.vertices[b].cast<double>() +
                                root * v * mesh.vertices[c].cast<double>();
  return point.cast<float>();
}

}  // namespace

SurfaceSamples vertex_samples(const TriangleMesh& mesh) {
  SurfaceSamples samples;
  std::vector<std::uint8_t> taken(mesh.vertices.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t vertex : mesh.triangles[t]) {
      if (std::exchange(taken[vertex], 1)) continue;
      samples.points.push_back(mesh.vertices[vertex]);
      samples.triangles.push_back(t);
    }
  return samples;
}

SurfaceSamples sample_surface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  const std::vector<double> cumulated = cumulated_area(mesh);
  if (cumulated.empty() || !(cumulated.back() > 0.0))
    throw std::invalid_argument("surface samples: the mesh has no area to sample; load one with faces");
  const CounterRandom random(seed, random_stream::surface_samples);
  SurfaceSamples samples;
  samples.points.reserve(count);
  samples.triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = random.uniform(i);
    const double area = cumulated.back() * (i + u[0]) / count;
    const auto found = std::upper_bound(cumulated.begin(), cumulated.end() - 1, area);
    const auto triangle = static_cast<std::uint32_t>(found - cumulated.begin());
    samples.triangles.push_back(triangle);
    samples.points.push_back(point_in(mesh, triangle, u[1], u[2]));
  }
  return samples;
}

}  // namespace nextview
