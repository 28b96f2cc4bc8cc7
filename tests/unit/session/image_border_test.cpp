// Views that look past the object: what lies on the border of the image is not in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/session/setup_warnings.hpp"

namespace nextview {
namespace {

/// A camera whose outermost pixels end exactly where x or y is as large as z.
Configuration square_pyramid() {
  Configuration c;
  c.sensor.width = 64, c.sensor.height = 48;
  c.sensor.intrinsics = "32 24 31.5 23.5";
  return c;
}

/// A patch in the plane where one coordinate is `slope` times z, seen edge-on from the origin.
TriangleMesh edge_on(int axis, float slope) {
  TriangleMesh mesh;
  for (const auto& [along, z] : {std::pair(-0.125f, 0.5f), {0.125f, 0.5f}, {0.125f, 0.75f}, {-0.125f, 0.75f}}) {
    Eigen::Vector3f corner(along, along, z);
    corner[axis] = slope * z;
    mesh.vertices.push_back(corner);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// How many of three views have nothing of it in their images: one from the origin, one that has all of it, and the
/// start view.
int looking_past(const TriangleMesh& mesh) {
  const Vector3 middle = mesh.bounding_box().center();
  const std::vector<Pose> views = {Pose::Identity(), look_at(middle - Vector3(0.3, 0.4, 0.8), middle)};
  for (const std::string& warning : setup_warnings(square_pyramid(), mesh, views))
    if (warning.find("looks past it") != std::string::npos) return std::atoi(warning.c_str());
  return 0;
}

TEST(ImageBorder, IsInNoImage) {
  for (const int axis : {0, 1})
    for (const float side : {-1.0f, 1.0f}) {
      const int inside = looking_past(edge_on(axis, 0.99f * side));
      EXPECT_EQ(looking_past(edge_on(axis, side)), inside + 1) << axis << " " << side;
      EXPECT_EQ(looking_past(edge_on(axis, 1.01f * side)), inside + 1) << axis << " " << side;
    }
}

TEST(ImageBorder, WhatLiesBehindTheCameraIsInNoImage) {
  TriangleMesh ahead = edge_on(1, 0.5f), behind = ahead;
  for (Eigen::Vector3f& v : behind.vertices) v = -v;
  EXPECT_EQ(looking_past(behind), looking_past(ahead) + 1);
}

}  // namespace
}  // namespace nextview
