// The sign of a distance to a surface with holes: inside is where at least four of the six half-lines along the axes
// cross it an odd number of times. Counted here by hand.
#include <gtest/gtest.h>

#include "core/evaluation/signed_distance.hpp"

namespace nextview {
namespace {

/// Some of the six sides of the cube from -1 to 1: axis and side of each.
TriangleMesh sides(const std::vector<std::pair<int, float>>& which) {
  TriangleMesh mesh;
  for (const auto& [axis, at] : which) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& [a, b] : {std::pair(-1.0f, -1.0f), {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
      Eigen::Vector3f corner;
      corner[axis] = at, corner[(axis + 1) % 3] = a, corner[(axis + 2) % 3] = b;
      mesh.vertices.push_back(corner);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

constexpr std::pair<int, float> left{0, -1.0f}, right{0, 1.0f}, front{1, -1.0f}, back{1, 1.0f}, floor_{2, -1.0f},
    lid{2, 1.0f};
const Eigen::Vector3f middle(0.1f, 0.2f, 0.3f);

TEST(SignedDistanceOpen, APlateHasNoInside) {
  const SignedDistance distance(sides({floor_}));
  EXPECT_NEAR(distance(middle), 1.3, 1e-6);
  EXPECT_NEAR(distance({0.1f, 0.2f, -1.25f}), 0.25, 1e-6);
}

TEST(SignedDistanceOpen, TwoWallsAndAFloorHaveNoInside) {  // three of six
  const SignedDistance distance(sides({left, right, floor_}));
  EXPECT_NEAR(distance(middle), 0.9, 1e-6);
  EXPECT_NEAR(distance({0.0f, 0.0f, -0.9f}), 0.1, 1e-6);
}

TEST(SignedDistanceOpen, ATubeHasAnInside) {  // four of six, whichever axis it is open along
  const SignedDistance distance(sides({left, right, front, back}));
  EXPECT_NEAR(distance(middle), -0.8, 1e-6);
  EXPECT_NEAR(SignedDistance(sides({front, back, floor_, lid}))(middle), -0.7, 1e-6);
  EXPECT_NEAR(SignedDistance(sides({left, right, floor_, lid}))(middle), -0.7, 1e-6);
  EXPECT_GT(distance({0.0f, 0.0f, 1.5f}), 0.0) << "past its end";
  EXPECT_GT(distance({1.5f, 0.0f, 0.0f}), 0.0) << "beside it";
}

TEST(SignedDistanceOpen, ACubeWithoutALidHasAnInside) {  // five of six
  const SignedDistance distance(sides({left, right, front, back, floor_}));
  EXPECT_NEAR(distance(middle), -0.8, 1e-6);
  EXPECT_GT(distance({0.0f, 0.0f, 1.5f}), 0.0);
}

TEST(SignedDistanceOpen, TurnedSidesChangeNothing) {
  TriangleMesh tube = sides({left, right, front, back});
  for (std::size_t t = 0; t < tube.triangles.size(); t += 2) std::swap(tube.triangles[t][0], tube.triangles[t][1]);
  EXPECT_NEAR(SignedDistance(tube)(middle), -0.8, 1e-6);
}

}  // namespace
}  // namespace nextview
