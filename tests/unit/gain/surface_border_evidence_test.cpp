#include <gtest/gtest.h>

#include <cmath>

#include "core/gain/new_surface_model.hpp"
#include "tests/unit/gain/evidence_maps.hpp"

namespace nextview {
namespace {

using Eigen::Vector3i;

/// Points of a border anywhere in a map, some of them beyond it.
OpenBorder random_border(std::mt19937& random, const VoxelGrid& grid) {
  const double reach = 0.6 * grid.resolution * grid.size.maxCoeff();
  std::uniform_real_distribution<float> at(float(-reach), float(reach));
  OpenBorder border{{}, 0.25 * grid.resolution};
  for (int i = 0; i < 300; ++i) border.beyond.emplace_back(at(random), at(random), at(random));
  return border;
}

void expect_lengths(const SurfaceEvidence& evidence, const OpenBorder& border) {
  const int edge = evidence.block_edge();
  int with_border = 0;
  for (const Vector3i& cell : evidence_maps::cells(evidence)) {
    if (evidence.kind(cell) == SurfaceEvidence::Kind::unmeasured) continue;
    double length = 0.0;  // [blocks]
    for (const Eigen::Vector3f& point : border.beyond) {
      const Vector3i at = evidence.grid().cell_at(point.cast<double>());
      if (!evidence.grid().contains(at)) continue;
      const Vector3i way = at / edge - cell / edge;
      if (way.cwiseAbs().maxCoeff() <= 1) length += border.spacing / (edge * evidence.grid().resolution);
    }
    with_border += length > 0.0;
    ASSERT_NEAR(evidence.measured(cell).back(), std::log(1.0 + 4.0 * length), 1e-5) << cell.transpose();
  }
  EXPECT_GT(with_border, 100);
}

TEST(SurfaceBorderEvidence, IsTheLengthOfTheBorderBesideAVoxel) {
  std::mt19937 random(6);
  const auto made = evidence_maps::random_map(random, {24, 22, 26}, 0.1, 0.4);
  const OpenBorder border = random_border(random, made.map.grid());
  const SurfaceEvidence evidence = made.evidence(0.5, SurfaceEvidence::finest_share, border);
  ASSERT_EQ(evidence.block_edge(), 1);
  expect_lengths(evidence, border);
}

TEST(SurfaceBorderEvidence, OrBesideItsBlock) {
  std::mt19937 random(7);
  const auto made = evidence_maps::random_map(random, {24, 22, 26}, 0.1, 0.4);
  const OpenBorder border = random_border(random, made.map.grid());
  const SurfaceEvidence evidence = made.evidence(0.5, 0.06, border);
  ASSERT_EQ(evidence.block_edge(), 2);
  expect_lengths(evidence, border);
}

TEST(SurfaceBorderEvidence, NoneIsNone) {
  std::mt19937 random(8);
  const SurfaceEvidence evidence = evidence_maps::random_map(random, {12, 12, 12}, 0.1, 0.4).evidence();
  for (const Vector3i& cell : evidence_maps::cells(evidence)) {
    if (evidence.kind(cell) == SurfaceEvidence::Kind::unmeasured) continue;
    EXPECT_EQ(evidence.measured(cell).back(), 0.0f);
  }
}

TEST(SurfaceBorderEvidence, WhereTheSurfaceGoesOnMoreIsExpected) {
  evidence_maps::MadeMap made({20, 20, 20});
  made.set_box({0, 0, 11}, {19, 19, 19}, -1.5);
  made.set_box({4, 4, 10}, {15, 15, 10}, 1.25);
  const VoxelGrid& grid = made.map.grid();
  OpenBorder border{{}, grid.resolution};
  border.beyond.push_back(grid.centre(grid.index({15, 9, 10})).cast<float>());
  const SurfaceEvidence evidence = made.evidence(0.5, SurfaceEvidence::finest_share, border);
  const auto chance = [&](const Vector3i& cell) {
    return std::abs(
        NewSurfaceModel::fitted().chance(evidence, evidence_maps::in_evidence(evidence, made.map.grid(), cell)));
  };
  EXPECT_GT(chance({15, 9, 10}), 3.0f * chance({4, 9, 10}));
  EXPECT_EQ(chance({9, 15, 10}), chance({9, 4, 10}));
}

}  // namespace
}  // namespace nextview
