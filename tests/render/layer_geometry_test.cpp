#include <gtest/gtest.h>

#include <set>

#include "core/random/counter_random.hpp"
#include "ui/appearance/colour_map.hpp"
#include "ui/charts/chart.hpp"
#include "ui/figures/step_figure.hpp"
#include "ui/layers/voxel_faces.hpp"
#include "ui/scene/camera_framing.hpp"

namespace nextview {
namespace {

struct RandomClasses {
  VoxelGrid grid{0.1, {-3, 2, 5}, {6, 5, 4}};
  std::vector<Voxel> voxels{grid.voxel_count()};

  explicit RandomClasses(std::uint64_t seed) {
    for (std::uint32_t i = 0; i < voxels.size(); ++i) {
      const auto draw = CounterRandom(seed, 901).uniform(i);
      voxels[i].measured = draw[0] < 0.8;
      voxels[i].voxel_class = static_cast<VoxelClass>(int(draw[1] * 3));
    }
  }
};

TEST(VoxelFaces, AreTheBoundaryOfTheShownVoxels) {
  const RandomClasses map(3);
  VoxelFilter cut{true, true, true}, cut_slice{true, true, true};
  cut.section = Section{0, map.grid.lower().x() + 0.3, true};
  cut_slice.section = Section{1, map.grid.lower().y() + 0.3, false};
  cut_slice.slice = Slice{2, map.grid.lower().z(), map.grid.lower().z() + 0.2};
  for (const VoxelFilter& filter :
       {VoxelFilter{}, VoxelFilter{true, true, true}, VoxelFilter{false, false, true}, cut, cut_slice}) {
    // A face between two shown voxels is met twice, from either side; the boundary is what is met once.
    std::multiset<std::array<long, 3>> centres;
    std::set<std::array<long, 3>> expected, actual;
    const auto centre_of = [&](std::uint32_t voxel, int axis, int sign) {
      const Vector3 c = map.grid.centre(voxel) + sign * 0.5 * map.grid.resolution * Vector3::Unit(axis);
      return std::array{std::lround(c.x() * 1e4), std::lround(c.y() * 1e4), std::lround(c.z() * 1e4)};
    };
    for (std::uint32_t voxel = 0; voxel < map.voxels.size(); ++voxel) {
      if (!filter.shows(map.grid, voxel, map.voxels[voxel])) continue;
      for (int axis = 0; axis < 3; ++axis) {
        for (const int sign : {-1, 1}) centres.insert(centre_of(voxel, axis, sign));
      }
    }
    for (const auto& centre : centres) {
      if (centres.count(centre) == 1) expected.insert(centre);
    }
    const auto faces = exposed_faces(map.grid, map.voxels, filter);
    for (const VoxelFace& face : faces) {
      const auto corners = face_corners(map.grid, face);
      const Vector3 c = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
      actual.insert({std::lround(c.x() * 1e4), std::lround(c.y() * 1e4), std::lround(c.z() * 1e4)});
    }
    EXPECT_EQ(actual.size(), faces.size()) << "a face is there twice";
    EXPECT_EQ(actual, expected);
  }
}

TEST(VoxelFaces, CornersRunCounterClockwiseSeenFromOutside) {
  const VoxelGrid grid{0.5, {0, 0, 0}, {2, 2, 2}};
  for (std::uint8_t side = 0; side < 6; ++side) {
    const VoxelFace face{7, side};
    const auto c = face_corners(grid, face);
    EXPECT_TRUE((c[1] - c[0]).cross(c[2] - c[1]).normalized().isApprox(face_normal(face)));
    EXPECT_GT(face_normal(face).dot(c[0] - grid.centre(7)), 0.0);
    EXPECT_NEAR((c[2] - c[0]).norm(), 0.5 * std::sqrt(2.0), 1e-12);
  }
}

TEST(VoxelFaces, AnotherNumberOfVoxelsIsRefused) {
  EXPECT_THROW(exposed_faces({0.1, {0, 0, 0}, {2, 2, 2}}, std::vector<Voxel>(7), {}), std::invalid_argument);
}

TEST(CameraFraming, AllPointsAreWithinTheMarginsAndTouchTwoOfThem) {
  const Eigen::Matrix3d R = look_at({0.7, -1.0, 0.5}, Vector3::Zero()).linear();
  const FrameMargins margins{0.05, 0.25, 0.1, 0.02};
  const double angle = 0.5, aspect = 1.6;
  std::vector<Vector3> points;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto draw = CounterRandom(5, 902).uniform(i);
    points.emplace_back(draw[0] - 0.5, 2 * draw[1], 0.3 * draw[2]);
  }
  const Vector3 camera = frame_points(R, angle, aspect, margins, points);
  Eigen::AlignedBox2d image;  // shares of the viewport, from the lower left
  for (const Vector3& point : points) {
    const Vector3 p = R.transpose() * (point - camera);
    ASSERT_GT(p.z(), 0.0);
    const Eigen::Vector2d tangent(p.x() / p.z(), -p.y() / p.z());
    image.extend(Eigen::Vector2d(0.5 + 0.5 * tangent.x() / (std::tan(angle / 2) * aspect),
                                 0.5 + 0.5 * tangent.y() / std::tan(angle / 2)));
  }
  const double left = image.min().x() - margins.left, right = 1 - margins.right - image.max().x();
  const double bottom = image.min().y() - margins.bottom, top = 1 - margins.top - image.max().y();
  EXPECT_GT(std::min({left, right, bottom, top}), -1e-9);
  EXPECT_TRUE((left < 1e-9 && right < 1e-9) || (bottom < 1e-9 && top < 1e-9)) << "the camera could be nearer";
}

TEST(CameraFraming, MarginsThatLeaveNoRoomAreRefused) {
  const Eigen::Matrix3d R = look_at({0, -1, 0}, Vector3::Zero()).linear();
  const std::vector<Vector3> points{{0, 0, 0}, {0.1, 0, 0.1}};
  const auto framed = [&](const FrameMargins& margins) { return frame_points(R, 0.5, 1.5, margins, points); };
  for (const double margin : {0.5, 0.75}) {  // of either side: nothing is left, and less than nothing
    EXPECT_THROW(framed({margin, margin, 0.1, 0.1}), std::invalid_argument) << margin;
    EXPECT_THROW(framed({0.1, 0.1, margin, margin}), std::invalid_argument) << margin;
  }
  EXPECT_TRUE(framed({0.49, 0.49, 0.1, 0.1}).allFinite());
  EXPECT_TRUE(framed({0.1, 0.1, 0.49, 0.49}).allFinite());
  EXPECT_THROW(frame_points(R, 0.5, 1.5, {}, {}), std::invalid_argument) << "there is nothing to look at";
}

TEST(CameraFraming, ExtremePointsReachAsFarAsAllInEveryDirection) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const auto draw = CounterRandom(5, 907).uniform(i);
    const Vector3 on_ball = Vector3(draw[0] - 0.5, draw[1] - 0.5, draw[2] - 0.5).normalized();
    points.push_back(on_ball.cwiseProduct(Vector3(1.0, 0.6, 0.1)).cast<float>());
  }
  const std::vector<Vector3> extreme = extreme_points(points);
  EXPECT_LT(extreme.size(), 300u);
  const auto reach = [](const auto& all, const Vector3& outward) {
    double farthest = -1e9;
    for (const auto& point : all) farthest = std::max(farthest, outward.dot(point.template cast<double>()));
    return farthest;
  };
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto draw = CounterRandom(5, 908).uniform(i);
    const Vector3 outward = Vector3(draw[0] - 0.5, draw[1] - 0.5, draw[2] - 0.5).normalized();
    EXPECT_LT(reach(points, outward) - reach(extreme, outward), 0.01 * 2.0) << "of the longest axis";
  }
  EXPECT_TRUE(extreme_points({}).empty());
}

TEST(CameraFraming, PointsInTheUpperRightAreSeen) {
  const Eigen::Matrix3d R = look_at({0, -1, 0}, Vector3::Zero()).linear();  // x right, z up in the picture
  const auto clear = [&](const Vector3& a, const Vector3& b) {
    const double angle = 2 * std::atan(0.5);  // the picture is 1 m high where the points are
    return clears_corner(R, {0, -1, 0}, angle, 1.0, {0.7, 0.7}, std::vector{a, b});
  };
  EXPECT_TRUE(clear({0.15, 0, 0.4}, {-0.4, 0, -0.4})) << "left of it";
  EXPECT_TRUE(clear({0.4, 0, 0.15}, {-0.4, 0, -0.4})) << "beneath it";
  EXPECT_TRUE(clear({0.15, 0, 0.22}, {0.22, 0, 0.15})) << "around its corner";
  EXPECT_FALSE(clear({0.3, 0, 0.3}, {-0.4, 0, -0.4})) << "in it";
  EXPECT_FALSE(clear({0.1, 0, 0.45}, {0.45, 0, 0.1})) << "the way between the points crosses it";
}

TEST(CameraFraming, PointsInTheLowerLeftAreSeen) {
  const Eigen::Matrix3d R = look_at({0, -1, 0}, Vector3::Zero()).linear();
  const auto clear = [&](const Vector3& a, const Vector3& b) {
    return clears_corner(R, {0, -1, 0}, 2 * std::atan(0.5), 1.0, {0.3, 0.3}, std::vector{a, b}, true);
  };
  EXPECT_TRUE(clear({-0.15, 0, -0.4}, {0.4, 0, 0.4})) << "right of it";
  EXPECT_TRUE(clear({-0.4, 0, -0.15}, {0.4, 0, 0.4})) << "above it";
  EXPECT_FALSE(clear({-0.3, 0, -0.3}, {0.4, 0, 0.4})) << "in it";
}

TEST(ColourMaps, LightnessChangesEvenly) {
  for (const ColourMap& map : {ColourMap::score(), ColourMap::contribution()}) {
    const double first = lightness(map.at(0)), last = lightness(map.at(1));
    EXPECT_GT(first - last, 0.4);
    for (int i = 0; i <= 20; ++i)
      EXPECT_NEAR(lightness(map.at(i / 20.0)), first + i / 20.0 * (last - first), 0.02) << i;
  }
}

TEST(ColourMaps, ProbabilityIsPalestWhereItIsUndecided) {
  const ColourMap map = ColourMap::probability();
  for (int i = 0; i < 10; ++i) {
    const double t = i / 20.0;
    EXPECT_LT(lightness(map.at(t)), lightness(map.at(t + 0.05)));
    EXPECT_LT(lightness(map.at(1 - t)), lightness(map.at(0.95 - t)));
  }
}

TEST(ColourMaps, LightnessOfKnownColours) {
  EXPECT_NEAR(lightness({0, 0, 0}), 0.0, 1e-6);
  EXPECT_NEAR(lightness({1, 1, 1}), 1.0, 1e-6);
}

TEST(ColourMaps, ValuesBeyondTheRangeAreClamped) {
  const ColourMap map = ColourMap::score();
  EXPECT_EQ(map.at(-1), map.at(0));
  EXPECT_EQ(map.at(2), map.at(1));
  EXPECT_EQ(map.at(std::nan("")), map.at(0));
  EXPECT_EQ(map.at(5, 3, 3), map.at(1));
}

TEST(Chart, TicksAreRoundAndCoverTheData) {
  EXPECT_EQ(round_ticks(0, 20, 8, true), (std::vector<double>{0, 5, 10, 15, 20}));
  EXPECT_EQ(round_ticks(0, 3, 8, true), (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(round_ticks(0, 97, 5, false).back(), 100);
  EXPECT_EQ(round_ticks(0, 0, 5, false).front(), 0);
}

TEST(StepFigure, TitleSaysWhatWasChosenAndWhy) {
  StepPicture picture;
  picture.step = 3;
  picture.step_count = 20;
  picture.gain_name = "occlusion aware";
  picture.gain_unit = "nats";
  picture.scores = {1, 1234.5};
  EXPECT_EQ(step_title(picture), "Step 3 of 20");
  picture.chosen = 1;
  EXPECT_EQ(step_title(picture), "Step 3 of 20 · next best view 1 · occlusion aware 1234 nats");
}

}  // namespace
}  // namespace nextview
