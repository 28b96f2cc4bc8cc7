#include "core/map/ground_truth.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>

#include "tests/unit/map/closed_meshes.hpp"

namespace nextview {
namespace {

using namespace closed_meshes;

/// Cuts the triangle with the six planes of the box, one after the other (Sutherland and Hodgman); true if something is
/// left.
bool clips(std::vector<Vector3> polygon, const Vector3& lower, const Vector3& upper) {
  for (int plane = 0; plane < 6 && !polygon.empty(); ++plane) {
    const int k = plane / 2;
    const auto depth = [&](const Vector3& p) { return plane % 2 ? upper[k] - p[k] : p[k] - lower[k]; };
    std::vector<Vector3> cut;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double da = depth(a), db = depth(b);
      if (da >= 0) cut.push_back(a);
      if ((da > 0 && db < 0) || (da < 0 && db > 0)) cut.push_back(a + da / (da - db) * (b - a));
    }
    polygon = cut;
  }
  return !polygon.empty();
}

/// With the box around it.
struct BoxedTriangle {
  std::vector<Vector3> corners;
  Eigen::AlignedBox3d bounds;
};

std::vector<BoxedTriangle> boxed_triangles(const TriangleMesh& mesh) {
  std::vector<BoxedTriangle> triangles;
  for (const auto& t : mesh.triangles) {
    BoxedTriangle& triangle = triangles.emplace_back();
    for (const auto vertex : t)
      triangle.bounds.extend(triangle.corners.emplace_back(mesh.vertices[vertex].cast<double>()));
  }
  return triangles;
}

bool surface_meets_box(const std::vector<BoxedTriangle>& surface, const Vector3& centre, double half_edge) {
  const Vector3 lower = centre - Vector3::Constant(half_edge), upper = centre + Vector3::Constant(half_edge);
  const Eigen::AlignedBox3d voxel(lower, upper);
  return std::any_of(surface.begin(), surface.end(), [&](const BoxedTriangle& triangle) {
    return voxel.intersects(triangle.bounds) && clips(triangle.corners, lower, upper);
  });
}

TEST(GroundTruthTouch, AgreesWithClippingEveryTriangleAtEveryVoxel) {
  for (const auto& [object, mesh] : objects()) {
    const GroundTruth truth = ground_truth(mesh, grid_around_origin());
    const std::vector<BoxedTriangle> surface = boxed_triangles(mesh);
    std::size_t touched = 0, undecided = 0;
    for (std::uint32_t i = 0; i < truth.grid.voxel_count(); ++i) {
      // The convention gives a voxel 1e-5 of its edge more on all sides; within that the twin does not decide.
      const double half = 0.5 * truth.grid.resolution, slack = 2e-5 * truth.grid.resolution;
      const bool at_least = surface_meets_box(surface, truth.grid.centre(i), half - slack);
      const bool at_most = surface_meets_box(surface, truth.grid.centre(i), half + slack);
      ASSERT_LE(int(at_least), int(truth.touch[i])) << object << " voxel " << i;
      ASSERT_GE(int(at_most), int(truth.touch[i])) << object << " voxel " << i;
      touched += truth.touch[i];
      undecided += at_least != at_most;
    }
    EXPECT_GT(touched, 100u) << object;
    EXPECT_LE(undecided, 3u) << object;
  }
}

TEST(GroundTruthTouch, HoldsEveryPointOfADenselySampledSurface) {
  for (const auto& [object, mesh] : objects()) {
    const GroundTruth truth = ground_truth(mesh, grid_around_origin());
    std::vector<std::uint8_t> sampled(truth.grid.voxel_count(), 0);
    for (const auto& t : mesh.triangles) {
      const Vector3 a = mesh.vertices[t[0]].cast<double>();
      const Vector3 ab = mesh.vertices[t[1]].cast<double>() - a, ac = mesh.vertices[t[2]].cast<double>() - a;
      const int steps = 2 + int(std::max(ab.norm(), ac.norm()) / 0.0005);
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
          const Eigen::Vector3i cell = truth.grid.cell_at(a + double(i) / steps * ab + double(j) / steps * ac);
          if (truth.grid.contains(cell)) sampled[truth.grid.index(cell)] = 1;
        }
    }
    std::size_t touched = 0, met = 0;
    for (std::size_t i = 0; i < sampled.size(); ++i) {
      ASSERT_LE(int(sampled[i]), int(truth.touch[i])) << object << " voxel " << i;
      touched += truth.touch[i];
      met += sampled[i];
    }
    EXPECT_GT(double(met), 0.97 * double(touched)) << object;  // samples miss the corners that the surface just grazes
  }
}

TEST(GroundTruthTouch, ASurfaceOnAFaceTouchesBothVoxels) {
  for (const double resolution : {0.125, 0.01}) {  // 0.01: the vertices, being floats, lie beside the faces
    VoxelGrid grid;
    grid.resolution = resolution;
    grid.size = {9, 9, 9};
    const GroundTruth truth =
        ground_truth(box(Vector3::Constant(2 * resolution), Vector3::Constant(6 * resolution)), grid);
    for (std::uint32_t i = 0; i < grid.voxel_count(); ++i) {
      const Eigen::Array3i cell = grid.cell(i);
      const bool reached = (cell >= 1).all() && (cell <= 6).all(), within = (cell >= 3).all() && (cell <= 4).all();
      ASSERT_EQ(truth.touch[i], reached && !within) << resolution << " voxel " << cell.transpose();
      ASSERT_EQ(truth.centre[i], (cell >= 2).all() && (cell <= 5).all()) << resolution << " voxel " << cell.transpose();
      ASSERT_EQ(truth.hidden(i), within);
    }
  }
}

TEST(GroundTruth, AnObjectAroundTheGridHidesAllOfIt) {
  const GroundTruth truth = ground_truth(box(Vector3::Constant(-0.5), Vector3::Constant(0.6)), grid_around_origin());
  for (std::size_t i = 0; i < truth.grid.voxel_count(); ++i) {
    ASSERT_TRUE(truth.hidden(i));
    ASSERT_EQ(truth.surface_distance(i), 255);
  }
}

TEST(GroundTruth, NoTrianglesAndTrianglesFarAwayTouchNothing) {
  TriangleMesh far;
  far.vertices = {{1e30f, 0, 0}, {1e30f, 1e30f, 0}, {1e30f, 0, -1e30f}};
  far.triangles = {{0, 1, 2}};
  for (const TriangleMesh& mesh : {TriangleMesh{}, far}) {
    const GroundTruth truth = ground_truth(mesh, grid_around_origin());
    EXPECT_EQ(truth.touch, BitMask(truth.grid.voxel_count()));
    EXPECT_EQ(truth.centre, BitMask(truth.grid.voxel_count()));
    EXPECT_EQ(truth.surface_distance(100), 255);
  }
}

TEST(GroundTruthDistance, AgreesWithAllPairsOfVoxels) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<float> side(-0.13f, 0.13f), small(-0.006f, 0.006f);
  for (const int triangles : {1, 4, 30}) {
    TriangleMesh mesh;
    for (int t = 0; t < triangles; ++t) {
      const Eigen::Vector3f at(0.8f * side(generator), 0.8f * side(generator), 0.8f * side(generator));
      for (int k = 0; k < 3; ++k)
        mesh.vertices.push_back(at + Eigen::Vector3f(small(generator), small(generator), small(generator)));
      const auto first = std::uint32_t(3 * t);
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const GroundTruth truth = ground_truth(mesh, grid_around_origin());
    std::vector<Eigen::Vector3i> touched;
    for (std::uint32_t i = 0; i < truth.grid.voxel_count(); ++i)
      if (truth.touch[i]) touched.push_back(truth.grid.cell(i));
    ASSERT_FALSE(touched.empty());
    for (std::uint32_t i = 0; i < truth.grid.voxel_count(); ++i) {
      int nearest = 255;
      for (const auto& cell : touched) nearest = std::min(nearest, (cell - truth.grid.cell(i)).cwiseAbs().maxCoeff());
      ASSERT_EQ(truth.surface_distance(i), nearest) << triangles << " triangles, voxel " << i;
      ASSERT_EQ(truth.near_surface[i], nearest <= band_width) << triangles << " triangles, voxel " << i;
    }
  }
}

TEST(GroundTruthDistance, StopsAt255) {
  VoxelGrid grid;
  grid.size = {600, 2, 3};
  TriangleMesh mesh;
  mesh.vertices = {{3.005f, 0.005f, 0.005f}, {3.006f, 0.005f, 0.005f}, {3.005f, 0.006f, 0.005f}};
  mesh.triangles = {{0, 1, 2}};
  const GroundTruth truth = ground_truth(mesh, grid);
  for (std::uint32_t i = 0; i < grid.voxel_count(); ++i)
    ASSERT_EQ(truth.surface_distance(i),
              std::min(255, (grid.cell(i) - Eigen::Vector3i(300, 0, 0)).cwiseAbs().maxCoeff()));
}

TEST(GroundTruth, DoesNotDependOnTheNumberOfThreads) {
  TriangleMesh mesh = torus({0.0041, 0.0029, -0.0017}, 0.0633, 0.0287, 96, 48);
  turn(mesh, 0.4);
  const GroundTruth many = ground_truth(mesh, grid_around_origin());
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const GroundTruth one = ground_truth(mesh, grid_around_origin());
  EXPECT_EQ(one.touch, many.touch);
  EXPECT_EQ(one.centre, many.centre);
  EXPECT_EQ(one.near_surface, many.near_surface);
}

}  // namespace
}  // namespace nextview
