#include "core/registration/alignment.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "core/mesh/surface_samples.hpp"

namespace nextview {
namespace {

/// An L of two boxes, without a symmetry.
TriangleMesh angle_bracket() {
  TriangleMesh mesh;
  const auto add_box = [&](const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
    const auto first = std::uint32_t(mesh.vertices.size());
    for (int corner = 0; corner < 8; ++corner)
      mesh.vertices.emplace_back(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                                 corner & 4 ? high.z() : low.z());
    constexpr std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
      mesh.triangles.push_back({first + f[0], first + f[1], first + f[2]});
      mesh.triangles.push_back({first + f[0], first + f[2], first + f[3]});
    }
  };
  add_box({0.0f, 0.0f, 0.0f}, {0.30f, 0.10f, 0.05f});
  add_box({0.0f, 0.0f, 0.05f}, {0.04f, 0.10f, 0.20f});
  return mesh;
}

/// Noisy points of one end of it, and of its other sides, as scans have them.
PointCloud scanned(const TriangleMesh& mesh, const Pose& T_world_mesh, double noise) {
  std::mt19937 random(5);
  std::normal_distribution<float> error(0.0f, float(noise));
  PointCloud cloud;
  for (const Eigen::Vector3f& p : sample_surface(mesh, 4000, 9).points) {
    if (p.x() > 0.25f) continue;
    cloud.push_back((T_world_mesh * p.cast<double>()).cast<float>() +
                    Eigen::Vector3f(error(random), error(random), error(random)));
  }
  return cloud;
}

/// The farthest that a corner of the mesh is from where it belongs [m].
double misplaced(const TriangleMesh& mesh, const Pose& T_world_mesh, const Alignment& alignment) {
  double farthest = 0.0;
  for (const Eigen::Vector3f& v : mesh.vertices)
    farthest =
        std::max(farthest, (alignment.T_surface_cloud * (T_world_mesh * v.cast<double>()) - v.cast<double>()).norm());
  return farthest;
}

Pose turned(double degrees, const Vector3& axis, const Vector3& shift) {
  return make_pose(shift, Eigen::Quaterniond(Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.normalized())));
}

TEST(Align, FindsWhereTheScansLie) {
  const TriangleMesh mesh = angle_bracket();
  for (const Pose& T_world_mesh : {turned(0, {0, 0, 1}, {0, 0, 0}), turned(5, {1, 2, 3}, {0.01, 0.0, -0.02}),
                                   turned(95, {0, 0, 1}, {0.5, -2.0, 1.0}), turned(180, {1, 0.1, 0}, {0, 3, 0})}) {
    const Alignment found = align(scanned(mesh, T_world_mesh, 0.0005), mesh);
    EXPECT_LT(misplaced(mesh, T_world_mesh, found), 0.0005);
    EXPECT_GT(found.overlap, 0.99);
    EXPECT_NEAR(found.residual, 0.0005, 0.0001) << "what the noise leaves, along the normal";
  }
}

TEST(Align, SaysWhenItIsAnotherThing) {
  const TriangleMesh mesh = angle_bracket();
  PointCloud larger = scanned(mesh, Pose::Identity(), 0.0);
  for (Eigen::Vector3f& p : larger) p *= 3.0f;
  EXPECT_LT(align(larger, mesh).overlap, 0.6);
}

TEST(Align, NeedsPoints) {
  EXPECT_THROW(align(PointCloud(99, Eigen::Vector3f::Zero()), angle_bracket()), std::invalid_argument);
}

}  // namespace
}  // namespace nextview
