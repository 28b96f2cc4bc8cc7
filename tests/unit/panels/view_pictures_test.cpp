#include "ui/panels/view_pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/session/session_parts.hpp"

namespace nextview {
namespace {

/// The grid says where in the image a ray of the bundle goes.
TEST(RayGrid, PutsEachRayWhereTheCameraSendsIt) {
  for (const Semantics semantics : {Semantics::published, Semantics::reference})
    for (const auto& [width, height] : {std::pair{640, 480}, {320, 240}, {161, 97}}) {
      Configuration c;
      c.planner.semantics = semantics;
      const PinholeCamera camera = PinholeCamera::from_field_of_view(width, height, 1.0);
      ASSERT_FALSE(scoring_rays(c, camera).directions.empty());
      for (const RayBundle& bundle : {scoring_rays(c, camera), finer_rays(c, camera)}) {
        if (bundle.directions.empty()) continue;
        const RayGrid grid(c.planner, camera, bundle.directions.size());
        ASSERT_EQ(grid.cells(), bundle.directions.size());
        for (int row = 0; row < grid.rows; ++row)
          for (int column = 0; column < grid.columns; ++column) {
            const std::size_t ray = grid.ray(column, row);
            ASSERT_EQ(grid.column(ray), column);
            ASSERT_EQ(grid.row(ray), row);
            const auto pixel = camera.project(bundle.directions[ray]);
            if (column > 0) {
              EXPECT_GT(pixel.x(), camera.project(bundle.directions[grid.ray(column - 1, row)]).x());
            }
            if (row > 0) {
              EXPECT_GT(pixel.y(), camera.project(bundle.directions[grid.ray(column, row - 1)]).y());
            }
          }
      }
    }
}

TEST(DepthPicture, IsDarkNearPaleFarWhiteWhereThereIsNothing) {
  const std::vector<float> depth{0.5f, 1.0f, -1.0f};
  const auto [near, far] = depth_range(depth, {});
  EXPECT_EQ(near, 0.5);
  EXPECT_EQ(far, 1.0);
  const Image image = depth_picture(depth, {}, 3, 1, near, far);
  EXPECT_LT(image.rgba[0], image.rgba[4]);
  EXPECT_LT(image.rgba[4], image.rgba[8]);
  EXPECT_EQ(image.rgba[8], 255);
}

}  // namespace
}  // namespace nextview
