#include "core/evaluation/any_pose.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/mesh/parts.hpp"
#include "core/mesh/surface_samples.hpp"

namespace nextview {
namespace {

using Eigen::Vector3f;

/// A box from `low` to `high`, but for the faces left out (0 … 5: low x, high x, low y, …).
void add_box(TriangleMesh& mesh, const Vector3f& low, const Vector3f& high, int without = -1) {
  for (int face = 0; face < 6; ++face) {
    if (face == without) continue;
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& [a, b] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      Vector3f corner;
      corner[axis] = face % 2 ? high[axis] : low[axis];
      corner[u] = a ? high[u] : low[u];
      corner[v] = b ? high[v] : low[v];
      mesh.vertices.push_back(corner);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
}

/// A block of 20 cm with a well in its top, `width` [m] wide and 10 cm deep.
TriangleMesh block_with_well(float width) {
  TriangleMesh mesh;
  const float edge = 0.1f, w = 0.5f * width;
  add_box(mesh, Vector3f::Constant(-edge), Vector3f::Constant(edge), 5);
  add_box(mesh, {-w, -w, 0.0f}, {w, w, edge}, 5);
  for (const auto& [low, high] : {std::pair(Vector3f(-edge, -edge, edge), Vector3f(edge, -w, edge)),
                                  {Vector3f(-edge, w, edge), Vector3f(edge, edge, edge)},
                                  {Vector3f(-edge, -w, edge), Vector3f(-w, w, edge)},
                                  {Vector3f(w, -w, edge), Vector3f(edge, w, edge)}}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(),
                         {low, Vector3f(high.x(), low.y(), edge), high, Vector3f(low.x(), high.y(), edge)});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

struct Seen {
  explicit Seen(const TriangleMesh& mesh, const DepthCameraConfig& config = {}, double d_reg = 0.005)
      : samples(sample_surface(mesh, 4000, 3)), scene(mesh), camera(config) {
    for (const std::uint32_t t : samples.triangles) {
      const auto& [a, b, c] = mesh.triangles[t];
      normals.push_back((mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).normalized());
    }
    seen = seen_from_any_pose(surface(), scene, camera, d_reg);
  }
  SampledSurface surface() const { return {samples.points, normals}; }
  /// The share that is seen of the samples of which `is` is true.
  template <class Is>
  double share(Is is) const {
    int all = 0, of_them = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!is(samples.points[i])) continue;
      ++all;
      of_them += seen[i];
    }
    EXPECT_GT(all, 0);
    return double(of_them) / all;
  }

  SurfaceSamples samples;
  std::vector<Vector3f> normals;
  MeshRayCaster scene;
  DepthCamera camera;
  std::vector<std::uint8_t> seen;
};

const auto everywhere = [](const Vector3f&) { return true; };
const auto at_bottom = [](const Vector3f& p) { return std::abs(p.z()) < 1e-6f && p.head<2>().norm() < 0.09f; };

TEST(AnyPose, SeesAllOfASphereAndOfABox) {
  EXPECT_EQ(Seen(sphere_part().mesh).share(everywhere), 1.0);
  EXPECT_EQ(Seen(box_part().mesh).share(everywhere), 1.0);
}

TEST(AnyPose, ABottomCountsWhereAPoseSeesIt) {
  EXPECT_EQ(Seen(block_with_well(0.06f)).share(at_bottom), 1.0);
  EXPECT_GT(Seen(block_with_well(0.02f)).share(at_bottom), 0.95) << "the cone of directions is 11 degrees wide";
  TriangleMesh covered = block_with_well(0.06f);
  add_box(covered, {-0.3f, -0.3f, 0.105f}, {0.3f, 0.3f, 0.11f});
  const Seen under_lid(covered);
  EXPECT_EQ(under_lid.share(at_bottom), 0.0);
  EXPECT_EQ(under_lid.share([](const Vector3f& p) { return p.z() > 0.109f; }), 1.0) << "the lid itself";
}

TEST(AnyPose, NoPoseIsInside) {
  TriangleMesh hollow;
  add_box(hollow, Vector3f::Constant(-1.0f), Vector3f::Constant(1.0f));
  add_box(hollow, Vector3f::Constant(-0.9f), Vector3f::Constant(0.9f));  // room enough for a camera
  const Seen seen(hollow);
  EXPECT_EQ(seen.share([](const Vector3f& p) { return p.cwiseAbs().maxCoeff() < 0.95f; }), 0.0);
  EXPECT_GT(seen.share([](const Vector3f& p) { return p.cwiseAbs().maxCoeff() > 0.95f; }), 0.99);
}

// Two plates with a gap: poses all over the place, each looked from directly.
TEST(AnyPose, AgreesWithPosesAllOver) {
  TriangleMesh mesh;
  add_box(mesh, {-0.15f, -0.15f, -0.02f}, {0.15f, 0.15f, 0.0f});
  add_box(mesh, {-0.15f, -0.05f, 0.01f}, {0.15f, 0.15f, 0.03f});
  const Seen any(mesh);
  std::vector<std::uint32_t> all(any.seen.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<std::uint8_t> brute(all.size());
  constexpr int count = 800;
  for (int i = 0; i < count; ++i) {  // a spiral over a sphere
    const double z = 1.0 - (2.0 * i + 1.0) / count, turn = 2.399963 * i, across = std::sqrt(1.0 - z * z);
    const Vector3 direction(across * std::cos(turn), across * std::sin(turn), z);
    for (const double distance : {0.45, 0.8}) {
      const Pose pose = look_at(distance * direction, Vector3(0, 0, 0.005));
      for (const std::uint32_t s : visible_samples(any.surface(), any.scene, any.camera, pose, all, 0.005))
        brute[s] = 1;
    }
  }
  const auto differ = std::ranges::count_if(all, [&](std::uint32_t s) { return brute[s] != any.seen[s]; });
  EXPECT_LT(double(differ) / double(all.size()), 0.02);
  const auto count_of = [](const std::vector<std::uint8_t>& seen) { return std::ranges::count(seen, 1); };
  EXPECT_LT(count_of(any.seen), std::ptrdiff_t(all.size())) << "deep in the gap nothing is seen";
  EXPECT_GT(count_of(any.seen), std::ptrdiff_t(all.size() / 2));
}

TEST(AnyPose, WhatPixelsAreTooCoarseForDoesNotCount) {
  DepthCameraConfig coarse;
  coarse.width = 12;
  coarse.height = 9;
  EXPECT_EQ(Seen(box_part().mesh, coarse).share(everywhere), 0.0);
  EXPECT_EQ(Seen(box_part().mesh, coarse, 0.1).share(everywhere), 1.0);
}

TEST(AnyPose, TheSameOnOneThreadAndTwo) {
  const auto run = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return Seen(block_with_well(0.02f)).seen;
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(ResolvedRange, HasPointsOfASlantedSurfaceADistanceAway) {
  const PinholeCamera camera = PinholeCamera::from_field_of_view(320, 240, 1.0);
  for (const double cosine : {1.0, 0.5, 0.1}) {
    const double range = resolved_range(camera, cosine, 0.004);
    const double pixel = range / camera.fx;
    EXPECT_NEAR(0.5 * std::hypot(pixel, pixel / cosine), 0.004, 1e-12);
  }
  EXPECT_EQ(resolved_range(camera, 0.5, any_slant), any_slant);
}

}  // namespace
}  // namespace nextview
