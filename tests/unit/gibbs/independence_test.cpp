#include "core/gibbs/independence.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

const VoxelGrid grid{0.1, {-10, -10, -10}, {20, 20, 20}};

/// A camera 2 m above a wall through the grid's centre; `per_edge` rays a voxel edge, each way.
RangeMeasurements wall(int per_edge, int images = 1) {
  RangeMeasurements measurements;
  measurements.max_range = 5.0;
  const int rays = 8 * per_edge;
  for (int image = 0; image < images; ++image) {
    measurements.origins.push_back({0.0, 0.001 * image, 2.0});
    for (int x = 0; x < rays; ++x)
      for (int y = 0; y < rays; ++y) {
        const auto at = [&](int i) { return static_cast<float>((i + 0.5) / per_edge * 0.1 - 0.4); };
        measurements.rays.push_back({{at(x), at(y), 0.0f}, static_cast<std::uint32_t>(image)});
      }
  }
  return measurements;
}

TEST(Independence, DensityIsRaysPerVoxelEdgeSquared) {
  for (const int per_edge : {2, 3, 5})
    EXPECT_NEAR(hit_cells(wall(per_edge), grid).rays_per_cell(), per_edge * per_edge, 0.25 * per_edge * per_edge)
        << per_edge;
}

TEST(Independence, DensityIsOfOneImage) {
  EXPECT_NEAR(hit_cells(wall(3, 4), grid).rays_per_cell(), hit_cells(wall(3), grid).rays_per_cell(), 0.1);
}

TEST(Independence, ImagesAddUp) {
  const RangeMeasurements all = wall(3, 4);
  HitCells added;
  for (std::uint32_t image = 0; image < 4; ++image) {
    RangeMeasurements one{all.max_range, {all.origins[image]}, {}};
    for (RangeMeasurement ray : all.rays)
      if (ray.origin == image) ray.origin = 0, one.rays.push_back(ray);
    added.add(hit_cells(one, grid));
  }
  EXPECT_EQ(added.rays, hit_cells(all, grid).rays);
  EXPECT_EQ(added.cells, hit_cells(all, grid).cells);
}

TEST(Independence, MergedRaysAreAsDense) {
  const RangeMeasurements measurements = wall(6);
  const RangeMeasurements merged = merge_rays(measurements, grid, 0.6);
  ASSERT_LT(2 * merged.rays.size(), measurements.rays.size());
  const double density = hit_cells(measurements, grid).rays_per_cell();
  EXPECT_NEAR(hit_cells(merged, grid).rays_per_cell(), density, 0.15 * density);
}

TEST(Independence, NoiseMakesRaysNoLessDense) {
  RangeMeasurements noisy = wall(4);
  const Eigen::Vector3f camera = noisy.origins[0].cast<float>();
  for (std::size_t k = 0; k < noisy.rays.size(); ++k)  // a voxel edge to either side, along the ray
    noisy.rays[k].end = camera + (noisy.rays[k].end - camera) * (1.0f + 0.01f * (float(k % 11) - 5.0f));
  const double density = hit_cells(wall(4), grid).rays_per_cell();
  EXPECT_NEAR(hit_cells(noisy, grid).rays_per_cell(), density, 0.05 * density);
}

TEST(Independence, RaysThatEndOutsideOfTheGridDoNotCount) {
  RangeMeasurements measurements = wall(2);
  const double density = hit_cells(measurements, grid).rays_per_cell();
  for (int k = 0; k < 500; ++k) measurements.rays.push_back({{3.0f, 0.0f, 0.001f * float(k)}});
  for (int k = 0; k < 500; ++k) measurements.rays.push_back({{0.0f, 0.0f, 0.0f}, 0, 1, true});
  EXPECT_EQ(hit_cells(measurements, grid).rays_per_cell(), density);
  EXPECT_EQ(hit_cells({}, grid).rays_per_cell(), 1.0);
}

TEST(Independence, DenserRaysCountLess) {
  EXPECT_EQ(independence_at(1.0), 1.0);
  EXPECT_EQ(independence_at(2.0), 1.0);
  EXPECT_DOUBLE_EQ(independence_at(40.0), 0.05);
}

TEST(Independence, IsOfTheDensityOnlyWhereNothingElseIsSaid) {
  const RangeMeasurements measurements = wall(5);
  ForwardSensorModel model;
  model.independence = 0.7;
  EXPECT_EQ(with_independence(model, measurements, grid).independence, 0.7);
  model.independence = 0.0;
  EXPECT_DOUBLE_EQ(with_independence(model, measurements, grid).independence,
                   independence_at(hit_cells(measurements, grid).rays_per_cell()));
  for (const ForwardModel kind : {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam}) {
    model.kind = kind;
    EXPECT_EQ(with_independence(model, measurements, grid).independence, 1.0) << name(kind);
  }
}

}  // namespace
}  // namespace nextview
