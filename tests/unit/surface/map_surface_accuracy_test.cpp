// Where the surface of a map runs: maps of known solids.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "core/mesh/parts.hpp"
#include "core/mesh/surface_samples.hpp"
#include "core/surface/map_surface.hpp"
#include "tests/unit/evaluation/distance_oracle.hpp"
#include "tests/unit/map/closed_meshes.hpp"
#include "tests/unit/surface/made_maps.hpp"
#include "tests/unit/surface/surface_checks.hpp"

namespace nextview {
namespace {

using made_maps::edge;
using surface_checks::closed;
using surface_checks::complete;
using surface_checks::crossings;
using surface_checks::signed_volume;

VoxelGrid grid_around(const TriangleMesh& mesh) {
  const Eigen::AlignedBox3d box = mesh.bounding_box();
  VoxelGrid grid;
  grid.first = (box.min() / edge).array().floor().matrix().cast<int>() - Eigen::Vector3i::Constant(3);
  grid.size = (box.max() / edge).array().ceil().matrix().cast<int>() + Eigen::Vector3i::Constant(3) - grid.first;
  return grid;
}

struct Distances {
  double worst = 0.0, of_95_percent = 0.0, mean = 0.0;  // [voxel edges]; the mean is signed, positive outside
};

using Distance = std::function<double(const Vector3&)>;  // [m], positive outside

/// Of the vertices, at most some thousands of them.
Distances distances(const TriangleMesh& mesh, const Distance& distance) {
  std::vector<double> all;
  double sum = 0.0;
  for (std::size_t v = 0; v < mesh.vertices.size(); v += mesh.vertices.size() / 4000 + 1) {
    const double d = distance(mesh.vertices[v].cast<double>()) / edge;
    sum += d;
    all.push_back(std::abs(d));
  }
  std::sort(all.begin(), all.end());
  return {all.back(), all[all.size() * 95 / 100], sum / double(all.size())};
}

/// To a box around the origin.
Distance to_box(const Vector3& lower, const Vector3& upper) {
  return [=](const Vector3& p) {
    const Vector3 q = (lower - p).cwiseMax(p - upper);
    return q.cwiseMax(0.0).norm() + std::min(0.0, q.maxCoeff());
  };
}

Surface surface_of(const TriangleMesh& solid) {
  const VoxelGrid grid = grid_around(solid);
  Surface surface = map_surface(grid, made_maps::scanned(solid, grid));
  EXPECT_TRUE(closed(surface.mesh));
  EXPECT_TRUE(complete(surface, edge));
  return surface;
}

constexpr double off_level = 0.006;  // values just beside the level are moved off it [voxel edges]

TEST(MapSurfaceAccuracy, SpheresAreNotLargerOrSmallerThanTheyAre) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  for (const double radius : {0.04, 0.09}) {
    double mean = 0.0, volume = 0.0;
    constexpr int spheres = 12;
    for (int n = 0; n < spheres; ++n) {
      const Vector3 centre = edge * Vector3(uniform(random), uniform(random), uniform(random));
      const Surface surface = surface_of(closed_meshes::sphere(centre, radius, 5));
      const Distances d = distances(surface.mesh, [&](const Vector3& p) { return (p - centre).norm() - radius; });
      EXPECT_LT(d.worst, 0.52) << centre.transpose();
      EXPECT_LT(d.of_95_percent, 0.4) << centre.transpose();
      EXPECT_EQ(surface_checks::euler_characteristic(surface.mesh), 2);
      EXPECT_EQ(std::count(surface.seen.begin(), surface.seen.end(), 0), 0) << "everything was seen";
      mean += d.mean / spheres;
      volume += signed_volume(surface.mesh) / (4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3)) / spheres;
    }
    // A corner of voxels is inside if and only if the sphere reaches it, so on average the surface runs where the
    // sphere does, but for steps of the lattice around its curvature, of edge / radius / 8.
    EXPECT_NEAR(mean, 0.0, 0.05) << radius;
    EXPECT_NEAR(volume, 1.0, 3.0 * 0.05 * edge / radius) << radius;
  }
}

TEST(MapSurfaceAccuracy, FacesOfABoxLieWithinHalfAVoxel) {
  for (const double off : {0.0, 0.0013, 0.0049, 0.0071}) {
    const Vector3 lower(-0.06 + off, -0.05 + off, -0.07 + off), upper(0.05 - off, 0.06 + off, 0.04 + 0.5 * off);
    const Surface surface = surface_of(closed_meshes::box(lower, upper));
    EXPECT_LT(distances(surface.mesh, to_box(lower, upper)).worst, 0.5 + off_level) << off;
  }
}

// Along its edges and at its corners a box is cut: there it is off by up to half a voxel's diagonal.
TEST(MapSurfaceAccuracy, TiltedBoxesLieWithinHalfAVoxelButForTheirEdges) {
  for (int n = 0; n < 20; ++n) {
    const double angle = 0.11 + 0.15 * n;
    const Vector3 lower(-0.0613, -0.0427, -0.0771), upper(0.0537, 0.0671, 0.0433);
    TriangleMesh box = closed_meshes::box(lower, upper);
    closed_meshes::turn(box, angle);
    const Surface surface = surface_of(box);
    const Eigen::AngleAxisd back(-angle, Vector3(0.4, -0.3, 0.8).normalized());
    const Distance distance = to_box(lower, upper);
    const Distances d = distances(surface.mesh, [&](const Vector3& p) { return distance(back * p); });
    EXPECT_LT(d.of_95_percent, 0.5) << angle;
    EXPECT_LT(d.worst, 0.5 * std::sqrt(3.0) + 0.03) << angle;
    EXPECT_LT(std::abs(d.mean), 0.06) << angle;
    for (const auto& v : surface.mesh.vertices) {
      const Vector3 p = back * v.cast<double>();
      const bool in_a_face = ((p - lower).cwiseMin(upper - p).array() > 1.5 * edge).count() == 2;
      if (in_a_face) {
        ASSERT_LT(std::abs(distance(p)), (0.5 + off_level) * edge) << angle;
      }
    }
  }
}

double distance_to(const TriangleMesh& mesh, const Vector3& point) {
  double nearest = INFINITY;
  for (const auto& t : mesh.triangles) {
    Eigen::AlignedBox3d box;
    for (const auto v : t) box.extend(mesh.vertices[v].cast<double>());
    if (box.exteriorDistance(point) >= nearest) continue;
    nearest = std::min(
        nearest, distance_oracle::to_triangle(point, mesh.vertices[t[0]].cast<double>(),
                                              mesh.vertices[t[1]].cast<double>(), mesh.vertices[t[2]].cast<double>()));
  }
  return nearest;
}

TEST(MapSurfaceAccuracy, SlottedPlate) {
  const Part plate = slotted_plate();
  const Surface surface = surface_of(plate.mesh);
  std::vector<double> all;
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); v += 23)
    all.push_back(distance_to(plate.mesh, surface.mesh.vertices[v].cast<double>()) / edge);
  std::sort(all.begin(), all.end());
  EXPECT_LT(all[all.size() * 95 / 100], 0.5 + off_level);
  EXPECT_LT(all.back(), 0.75);
  for (const Opening& opening : plate.openings) {
    const Vector3 from = opening.centre - 0.1 * opening.axis;
    const bool open = crossings(surface.mesh, from, opening.axis).in.empty();
    if (opening.kind == Opening::Kind::slot) {
      EXPECT_EQ(open, opening.width > 0.015) << opening.width;
    }
    if (opening.width >= 0.03) {
      EXPECT_TRUE(open) << opening.width;
    }  // a bore of 28.3 mm holds a voxel wherever it lies
  }
}

}  // namespace
}  // namespace nextview
