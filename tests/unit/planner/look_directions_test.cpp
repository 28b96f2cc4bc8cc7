#include "core/planner/look_directions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/unit/planner/drilled_block.hpp"

namespace nextview {
namespace {

using drilled_block::Bore;
using Eigen::Vector3i;

double degrees_between(const Vector3& a, const Vector3& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

NewSurfaceField field(const SurfaceEvidence& evidence) { return {evidence, NewSurfaceModel::fitted()}; }

TEST(LookDirections, OfABoresBottomGoAlongItsAxis) {
  for (const Vector3& axis : {Vector3(0, 0, 1), Vector3(0.3, -0.2, 1), Vector3(1, 0.4, 0.3), Vector3(0, -1, 0.5)}) {
    const Bore bore{axis.normalized(), 0.025, 0.12};
    const auto evidence = drilled_block::block({bore}).evidence();
    const auto field_of = field(evidence);
    const auto axes = LookDirections(field_of).from(bore.bottom()).axes;
    ASSERT_EQ(axes.size(), 1u);
    EXPECT_LT(degrees_between(axes[0], bore.axis), 5.0) << bore.axis.transpose();
    EXPECT_NEAR(axes[0].norm(), 1.0, 1e-9);
  }
}

TEST(LookDirections, OfAThroughBoreGoBothWays) {
  const Vector3 axis = Vector3(0.2, 0.1, 1).normalized();
  const auto evidence = drilled_block::block({{axis, 0.03, 0.5}, {-axis, 0.03, 0.5}}).evidence();
  const auto field_of = field(evidence);
  const auto axes = LookDirections(field_of).from(Vector3(0.004, 0.004, 0.004)).axes;
  ASSERT_EQ(axes.size(), 2u);
  for (const Vector3& a : axes) EXPECT_LT(std::min(degrees_between(a, axis), degrees_between(a, -axis)), 6.0);
  EXPECT_GT(degrees_between(axes[0], axes[1]), 160.0);
}

TEST(LookDirections, OfAnOpenFaceGoAlongItsNormal) {
  const auto evidence = drilled_block::block({}).evidence();
  const auto field_of = field(evidence);
  const LookDirections look(field_of);
  const double above = drilled_block::half + 0.005;
  for (const Vector3& normal : {Vector3(1, 0, 0), Vector3(0, -1, 0), Vector3(0, 0, 1)}) {
    const auto axes = look.from(above * normal).axes;
    ASSERT_FALSE(axes.empty());
    EXPECT_LT(degrees_between(axes[0], normal), 20.0);
  }
}

TEST(LookDirections, ThereAreNoneOutOfASolid) {
  const auto evidence = drilled_block::block({}).evidence();
  const auto field_of = field(evidence);
  const auto open = LookDirections(field_of).from(Vector3::Zero());
  EXPECT_TRUE(open.axes.empty());
  EXPECT_TRUE(open.directions.empty());
}

TEST(LookDirections, AllOfThemLeaveTheBoreByItsMouth) {
  const Bore bore{Vector3(0.1, 0.3, 1).normalized(), 0.03, 0.1};
  const auto evidence = drilled_block::block({bore}).evidence();
  const auto field_of = field(evidence);
  const double steepest = std::atan2(2 * (bore.radius + 0.01), bore.depth - 0.01) * 180.0 / std::numbers::pi;
  const auto open = LookDirections(field_of).from(bore.bottom());
  EXPECT_GT(open.directions.size(), 3u);
  for (const Vector3& direction : open.directions) EXPECT_LT(degrees_between(direction, bore.axis), steepest);
}

TEST(FrontierPlaces, AreBesideFreeVoxelsAndAsManyAsAskedFor) {
  const Bore bore{Vector3::UnitZ(), 0.03, 0.1};
  const auto evidence = drilled_block::block({bore}).evidence();
  const auto field_of = field(evidence);
  const VoxelGrid& grid = evidence.grid();
  for (const std::size_t count : {0u, 1u, 40u}) {
    const auto places = frontier_places(field_of, evidence, count, 0.5);
    ASSERT_EQ(places.size(), count);
    for (const Vector3& place : places) {
      const Vector3i cell = grid.cell_at(place);
      EXPECT_NE(evidence.kind(cell), SurfaceEvidence::Kind::free);
      EXPECT_GT(std::abs(field_of.at(grid.index(cell))), 0.0f);
      int free_around = 0;
      for (const Vector3i& step : {Vector3i(1, 0, 0), Vector3i(0, 1, 0), Vector3i(0, 0, 1)})
        for (const int sign : {-1, 1}) free_around += evidence.kind(cell + sign * step) == SurfaceEvidence::Kind::free;
      EXPECT_GT(free_around, 0);
    }
  }
  EXPECT_NE(frontier_places(field_of, evidence, 10, 0.1), frontier_places(field_of, evidence, 10, 0.9));
}

}  // namespace
}  // namespace nextview
