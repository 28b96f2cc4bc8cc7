// Clouds of known surfaces: where the surface runs, where it is open.
#include "core/surface/cloud_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/surface/made_scans.hpp"
#include "tests/unit/surface/surface_checks.hpp"

namespace nextview {
namespace {

using made_scans::views_of_sphere;
using surface_checks::complete;
using surface_checks::with_threads;

constexpr double sphere_radius = 0.1;  // of the spheres [m]

std::vector<double> distances_to_sphere(const TriangleMesh& mesh) {
  std::vector<double> result;
  for (const auto& v : mesh.vertices) result.push_back(std::abs(v.cast<double>().norm() - sphere_radius));
  std::sort(result.begin(), result.end());
  return result;
}

double percentile(const std::vector<double>& sorted, double share) {
  return sorted[std::size_t(share * double(sorted.size() - 1))];
}

std::vector<std::uint32_t> boundary_vertices(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  std::vector<std::uint32_t> result;
  for (const auto& [edge, count] : uses)
    if (count == 1) result.insert(result.end(), {edge.first, edge.second});
  return result;
}

/// Share of triangles whose normal points away from the origin.
double outward_share(const TriangleMesh& mesh) {
  double out = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    out += (b - a).cross(c - a).dot(a + b + c) > 0.0f;
  }
  return out / double(mesh.triangles.size());
}

TEST(CloudSurface, ANoisySphereIsFarBetterThanItsPointsAndClosed) {
  const Surface surface = cloud_surface(views_of_sphere(sphere_radius, {.noise = 0.001}, true, 1), 0.003);
  ASSERT_FALSE(surface.empty()) << surface.why_empty;
  ASSERT_TRUE(complete(surface, 0.005));
  ASSERT_TRUE(surface_checks::indices_valid(surface.mesh));
  EXPECT_TRUE(surface_checks::closed(surface.mesh));
  EXPECT_EQ(surface_checks::euler_characteristic(surface.mesh), 2);
  EXPECT_GT(outward_share(surface.mesh), 0.999);
  EXPECT_EQ(std::count(surface.seen.begin(), surface.seen.end(), 0), 0);
  const auto distances = distances_to_sphere(surface.mesh);
  EXPECT_LT(percentile(distances, 0.95), 0.0005);
  EXPECT_LT(distances.back(), 0.002);
  double mean = 0.0;
  for (const auto& v : surface.mesh.vertices)
    mean += (v.cast<double>().norm() - sphere_radius) / double(distances.size());
  EXPECT_LT(std::abs(mean), 0.0002);
}

TEST(CloudSurface, UncertaintyGrowsWithTheNoise) {
  double last = 0.0;
  for (const double noise : {0.0, 0.001, 0.003}) {
    const Surface surface = cloud_surface(views_of_sphere(sphere_radius, {.noise = noise}, true, 2), 0.003);
    ASSERT_FALSE(surface.empty());
    std::vector<double> u(surface.uncertainty.begin(), surface.uncertainty.end());
    std::sort(u.begin(), u.end());
    EXPECT_GT(percentile(u, 0.5), last);
    EXPECT_LT(percentile(u, 0.5), std::max(noise, 0.0007)) << "points are averaged";
    last = percentile(u, 0.5);
  }
}

TEST(CloudSurface, IsOpenWhereNoViewHasLookedAndNowhereElse) {
  const Surface surface = cloud_surface(views_of_sphere(sphere_radius, {.noise = 0.0005}, false, 3), 0.003);
  ASSERT_FALSE(surface.empty()) << surface.why_empty;
  ASSERT_TRUE(complete(surface, 0.005));
  const MeshTopology t = topology(surface.mesh);
  EXPECT_GT(t.boundary_edges, 20u);
  EXPECT_EQ(t.non_manifold_edges + t.misoriented_edges, 0u) << t.summary();
  for (const auto v : boundary_vertices(surface.mesh))
    EXPECT_LT(surface.mesh.vertices[v].z(), -0.8 * sphere_radius) << surface.mesh.vertices[v].transpose();
  EXPECT_EQ(surface_checks::piece_count(surface.mesh), 1u);
  EXPECT_GT(outward_share(surface.mesh), 0.99);
}

TEST(CloudSurface, IsOpenWhereACapIsMissingAndNowhereElse) {
  auto scans = views_of_sphere(sphere_radius, {}, true, 4);
  const Vector3 axis = Vector3(0.3, -0.5, 0.7).normalized();
  for (Scan& scan : scans)
    std::erase_if(scan.hits, [&](const Eigen::Vector3f& p) { return p.cast<double>().dot(axis) > 0.085; });
  const Surface surface = cloud_surface(scans, 0.003);
  ASSERT_FALSE(surface.empty()) << surface.why_empty;
  EXPECT_EQ(surface_checks::piece_count(surface.mesh), 1u);
  const auto boundary = boundary_vertices(surface.mesh);
  EXPECT_FALSE(boundary.empty());
  for (const auto v : boundary) EXPECT_NEAR(surface.mesh.vertices[v].cast<double>().dot(axis), 0.085, 0.006);
}

TEST(CloudSurface, TwoWallsTenMillimetresApartStayTwo) {
  std::mt19937 random(5);
  std::vector<Scan> scans;
  for (const double z : {-0.5, 0.5})
    for (const double x : {-0.2, 0.2})
      scans.push_back(made_scans::scan({x, 0.1, z}, {0, 0, 0.005}, {.pitch = 0.0015, .half_width = 50, .noise = 0.0005},
                                       made_scans::plate(0.01), random));
  const Surface surface = cloud_surface(scans, 0.002);
  ASSERT_FALSE(surface.empty()) << surface.why_empty;
  EXPECT_EQ(surface_checks::piece_count(surface.mesh), 2u);
  double worst = 0.0, area = 0.0;
  for (const auto& t : surface.mesh.triangles) {
    const Eigen::Vector3f a = surface.mesh.vertices[t[0]], b = surface.mesh.vertices[t[1]],
                          c = surface.mesh.vertices[t[2]];
    const float middle = (a.z() + b.z() + c.z()) / 3.0f;
    const Eigen::Vector3f across = (b - a).cross(c - a);
    worst = std::max<double>(worst, std::min(std::abs(middle), std::abs(middle - 0.01f)));
    EXPECT_GT((middle > 0.005f ? 1.0f : -1.0f) * across.z(), -1e-9f) << "normals point out";
    area += 0.5 * across.norm();
  }
  EXPECT_LT(worst, 0.0015);
  EXPECT_NEAR(area, 0.02, 0.0025);
}

TEST(CloudSurface, SparsePointsStillCloseTheSurface) {
  // Pixels 8 mm apart in one view: neighbouring ones must fall into neighbouring cells, whatever the finest is.
  std::mt19937 random(6);
  const std::vector<Scan> one = {made_scans::scan({0, 0, 0.5}, {0, 0, 0.005}, {.pitch = 0.008, .half_width = 20},
                                                  made_scans::plate(0.005), random)};
  const Surface flat = cloud_surface(one, 0.002);
  ASSERT_FALSE(flat.empty()) << flat.why_empty;
  EXPECT_EQ(surface_checks::euler_characteristic(flat.mesh), 1) << "a disc without holes";
  EXPECT_NEAR(flat.mesh.surface_area(), 0.0096 * 1.2, 0.0035);
  const Surface sphere =
      cloud_surface(views_of_sphere(sphere_radius, {.pitch = 0.008, .half_width = 14}, true, 6), 0.002);
  ASSERT_FALSE(sphere.empty()) << sphere.why_empty;
  EXPECT_TRUE(surface_checks::closed(sphere.mesh));
  EXPECT_EQ(surface_checks::euler_characteristic(sphere.mesh), 2);
}

TEST(CloudSurface, SparsePointsCloseTheSurfaceWhicheverOfTheViewsTheyCameFrom) {
  std::mt19937 random(7);
  const Scan view = made_scans::scan({0, 0, 0.5}, {0, 0, 0.005}, {.pitch = 0.008, .half_width = 20},
                                     made_scans::plate(0.005), random);
  for (std::size_t at = 0; at < 6; ++at) {
    std::vector<Scan> scans(6);  // the others look past the object
    scans[at] = view;
    const Surface surface = cloud_surface(scans, 0.002);
    ASSERT_FALSE(surface.empty()) << "view " << at << ": " << surface.why_empty;
    EXPECT_EQ(surface_checks::euler_characteristic(surface.mesh), 1) << "view " << at;
  }
}

TEST(CloudSurface, SameBytesOnOneAndTwoThreads) {
  const auto scans = views_of_sphere(sphere_radius, {.noise = 0.001}, false, 8);
  const auto make = [&] { return cloud_surface(scans, 0.003); };
  const Surface one = with_threads(1, make), two = with_threads(2, make);
  ASSERT_FALSE(one.empty());
  EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.uncertainty, two.uncertainty);
}

TEST(CloudSurface, TheOrderOfScansChangesLittle) {
  auto scans = views_of_sphere(sphere_radius, {.noise = 0.001}, true, 9);
  const Surface one = cloud_surface(scans, 0.003);
  std::reverse(scans.begin(), scans.end());
  const Surface other = cloud_surface(scans, 0.003);
  ASSERT_FALSE(one.empty() || other.empty());
  EXPECT_NEAR(one.mesh.surface_area() / other.mesh.surface_area(), 1.0, 1e-3);
  EXPECT_NEAR(surface_checks::signed_volume(one.mesh) / surface_checks::signed_volume(other.mesh), 1.0, 1e-4);
  EXPECT_NEAR(double(one.mesh.vertices.size()) / double(other.mesh.vertices.size()), 1.0, 0.01);
}

}  // namespace
}  // namespace nextview
