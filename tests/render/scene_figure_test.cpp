// The scene of a scan as a picture of its own, from one side and from all around.
#include "ui/figures/scene_figure.hpp"

#include <gtest/gtest.h>

#include "tests/render/picture_comparison.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

constexpr int picture_edge = 200;  // [px]

TriangleMesh box(const Vector3& centre, const Vector3& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vector3 sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    mesh.vertices.push_back((centre + half.cwiseProduct(sign)).cast<float>());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The object alone, in a region around the origin.
struct Turntable {
  explicit Turntable(TriangleMesh object) : mesh(std::move(object)) {
    picture.object = &mesh;
    picture.object_style = MeshStyle::solid;
    picture.grid = {0.1, {-5, -5, -5}, {10, 10, 10}};
    picture.voxels.resize(picture.grid.voxel_count());
    picture.camera = PinholeCamera::from_field_of_view(64, 48, 1.0);
    SceneLayers layers;
    layers.cloud = layers.map = layers.views = layers.rays = layers.region = layers.annotated = false;
    figure = std::make_unique<SceneFigure>(target, picture, layers, PictureSize{picture_edge, picture_edge}, 1.0);
  }
  Image turned(const ViewDirection& start, int frame, int count) {
    return figure->draw_turned(start, frame, count, true);
  }

  TriangleMesh mesh;
  StepPicture picture;
  OffscreenTarget target{64, 48};
  std::unique_ptr<SceneFigure> figure;
};

/// What encloses the pixels that are not clear [px, from the upper left].
Eigen::AlignedBox2i seen(const Image& image) {
  Eigen::AlignedBox2i box;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.rgba[(std::size_t(y) * image.width + x) * 4 + 3] > 0) box.extend(Eigen::Vector2i(x, y));
  return box;
}

TEST(SceneFigure, NothingIsCutOffAsItTurns) {
  // High and thin, low and wide, and beside the axis that it turns around.
  const std::vector<TriangleMesh> objects = {box({0, 0, 0}, {0.03, 0.03, 0.4}), box({0, 0, -0.3}, {0.45, 0.2, 0.02}),
                                             box({0.3, 0.1, 0.2}, {0.05, 0.1, 0.2})};
  for (const TriangleMesh& object : objects) {
    Turntable table(object);
    for (const double elevation : {0.0, 24.0, -40.0}) {
      int largest = 0;
      for (int frame = 0; frame < 8; ++frame) {
        const auto box = seen(table.turned({-50, elevation}, frame, 8));
        ASSERT_FALSE(box.isEmpty());
        EXPECT_GT(box.min().minCoeff(), 3) << "frame " << frame << " from " << elevation;
        EXPECT_LT(box.max().maxCoeff(), picture_edge - 4) << "frame " << frame << " from " << elevation;
        largest = std::max(largest, box.sizes().maxCoeff());
      }
      EXPECT_GT(largest, 0.4 * picture_edge) << "it could be larger";
    }
  }
}

TEST(SceneFigure, KeepsClearOfTheLegendsThatItHasAndOfNoOthers) {
  StepPicture picture;
  picture.grid = {0.1, {-5, -5, -5}, {10, 10, 10}};
  picture.voxels.assign(picture.grid.voxel_count(), {0.97f, 0.1f, VoxelClass::occupied, true});
  picture.camera = PinholeCamera::from_field_of_view(64, 48, 1.0);
  SceneLayers layers;
  layers.cloud = layers.views = layers.rays = layers.region = layers.object = false;
  OffscreenTarget target(64, 48);
  const Image image = SceneFigure(target, picture, layers, {440, 360}, 1.0).draw({}, false);
  Eigen::AlignedBox2i blue;
  for (int y = 90; y < image.height; ++y)  // below the legend, whose swatch is blue, too
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* pixel = &image.rgba[(std::size_t(y) * image.width + x) * 4];
      if (pixel[2] > pixel[0] + 40) blue.extend(Eigen::Vector2i(x, y));
    }
  ASSERT_FALSE(blue.isEmpty());
  EXPECT_NEAR(blue.center().x(), image.width / 2, 20);
  EXPECT_GT(blue.sizes().maxCoeff(), image.height / 2);
}

TEST(SceneFigure, ATurnGoesAroundTheRegionsMiddleCounterClockwise) {
  Turntable table(box({0.3, 0, 0}, {0.05, 0.05, 0.05}));
  std::vector<Eigen::AlignedBox2i> at;  // x points right at first
  for (int frame = 0; frame < 4; ++frame) at.push_back(seen(table.turned({-90, 0}, frame, 4)));
  const auto middle = [&](int frame) {
    return (at[std::size_t(frame)].min().x() + at[std::size_t(frame)].max().x()) / 2;
  };
  EXPECT_GT(middle(0), picture_edge / 2 + 30);
  EXPECT_NEAR(middle(1), picture_edge / 2, 3);
  EXPECT_LT(middle(2), picture_edge / 2 - 30);
  EXPECT_NEAR(middle(3), picture_edge / 2, 3);
  EXPECT_NEAR(middle(0) - picture_edge / 2, picture_edge / 2 - middle(2), 3) << "as far on either side";
  EXPECT_GT(at[1].sizes().y(), at[3].sizes().y()) << "the camera comes to where the object is, which is nearer then";
  const PictureDifference round = compare(table.turned({-90, 0}, 0, 4), table.turned({-90, 0}, 4, 4));
  EXPECT_TRUE(round.within({})) << round.summary();
}

TEST(SceneFigure, WhatIsNotTransparentHasAGround) {
  Turntable table(box({0, 0, 0}, {0.2, 0.2, 0.2}));
  const Image clear = table.figure->draw({}, true), solid = table.figure->draw({}, false);
  EXPECT_EQ(clear.rgba[3], 0);
  for (std::size_t i = 3; i < solid.rgba.size(); i += 4) ASSERT_EQ(solid.rgba[i], 255);
  EXPECT_EQ(clear.rgba[(picture_edge / 2 * picture_edge + picture_edge / 2) * 4 + 3], 255) << "the object";
}

TEST(SceneFigure, PointsThatAreAskedForFillIt) {
  Turntable table(box({0, 0, 0}, {0.2, 0.2, 0.2}));
  const auto dark = [](const Image& image) {
    int count = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) count += image.rgba[i] < 225;  // the ground is paler
    return count;
  };
  const std::vector<Vector3> corner = {{0.2, -0.2, 0.2}, {0.15, -0.2, 0.15}};
  EXPECT_GT(dark(table.figure->draw({}, corner)), 1.2 * dark(table.figure->draw({}, false)));
}

}  // namespace
}  // namespace nextview
