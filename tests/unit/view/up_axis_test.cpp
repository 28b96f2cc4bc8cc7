#include "core/view/up_axis.hpp"

#include <gtest/gtest.h>

#include "core/view/length_unit.hpp"

namespace nextview {
namespace {

/// A rotation, so that nothing is mirrored, which takes the axis to z.
TEST(UpAxis, TheAxisComesUpAndNothingIsMirrored) {
  const std::pair<UpAxis, Vector3> axes[] = {
      {UpAxis::x, Vector3::UnitX()},         {UpAxis::y, Vector3::UnitY()},        {UpAxis::z, Vector3::UnitZ()},
      {UpAxis::automatic, Vector3::UnitZ()}, {UpAxis::minus_x, -Vector3::UnitX()}, {UpAxis::minus_y, -Vector3::UnitY()},
      {UpAxis::minus_z, -Vector3::UnitZ()}};
  for (const auto& [up, axis] : axes) {
    EXPECT_EQ(with_z_up(up, axis), Vector3::UnitZ());
    Eigen::Matrix3d turn;
    for (int k = 0; k < 3; ++k) turn.col(k) = with_z_up(up, Vector3::Unit(k));
    EXPECT_EQ(turn.determinant(), 1.0) << axis.transpose();
    EXPECT_EQ(turn * turn.transpose(), Eigen::Matrix3d::Identity());
    const Vector3 point(0.1, -0.2, 0.3);
    EXPECT_EQ(with_z_up(up, point), turn * point) << "to the digit";
  }
}

TEST(UpAxis, WhatLiesAlongASecondAxisStaysWhereItIsKnownFrom) {
  EXPECT_EQ(with_z_up(UpAxis::y, Vector3::UnitX()), Vector3::UnitX());
  EXPECT_EQ(with_z_up(UpAxis::minus_y, Vector3::UnitX()), Vector3::UnitX());
  EXPECT_EQ(with_z_up(UpAxis::minus_z, Vector3::UnitX()), Vector3::UnitX());
  EXPECT_EQ(with_z_up(UpAxis::x, Vector3::UnitY()), Vector3::UnitY());
  EXPECT_EQ(with_z_up(UpAxis::minus_x, Vector3::UnitY()), Vector3::UnitY());
}

TEST(LengthUnit, IsInMetres) {
  EXPECT_EQ(metres_per(LengthUnit::metres), 1.0);
  EXPECT_EQ(metres_per(LengthUnit::centimetres), 0.01);
  EXPECT_EQ(metres_per(LengthUnit::millimetres), 0.001);
  EXPECT_EQ(metres_per(LengthUnit::inches), 0.0254) << "by definition";
  EXPECT_EQ(metres_per(LengthUnit::automatic), 1.0);
  EXPECT_EQ(name(LengthUnit::metres), "m");
  EXPECT_EQ(name(LengthUnit::inches), "inch");
  EXPECT_EQ(name(LengthUnit::automatic), "auto");
}

}  // namespace
}  // namespace nextview
