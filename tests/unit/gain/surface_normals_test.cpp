#include <gtest/gtest.h>

#include "tests/unit/gain/surface_evidence_twin.hpp"

namespace nextview {
namespace {

using Eigen::Vector3i;
using evidence_maps::in_evidence;
using evidence_maps::MadeMap;
using Kind = SurfaceEvidence::Kind;
using Twin = evidence_maps::EvidenceTwin;

/// Towards the free voxels beside a voxel, or across the nearest side of the box; as the comment has it.
Vector3 normal_by_comparing(const Twin& twin, const Vector3i& cell, const Vector3i& low, const Vector3i& high) {
  Vector3i ways = Vector3i::Zero();
  MadeMap::for_each(cell - Vector3i::Ones(), cell + Vector3i::Ones(), [&](const Vector3i& other) {
    if (other != cell && twin.grid.contains(other) && twin.kind(other) == Kind::free) ways += other - cell;
  });
  if (ways.isZero()) {
    int axis = 0;
    (cell - high).cwiseMax(low - cell).maxCoeff(&axis);
    ways = Vector3i::Unit(axis);
  }
  return CoarseNormal::along(ways).direction();
}

TEST(SurfaceEvidence, NormalsAreWhatComparingAllVoxelsFinds) {
  std::mt19937 random(4);
  const MadeMap made = evidence_maps::random_map(random, {13, 17, 15}, 0.1, 0.8);
  const Twin twin(made);
  const SurfaceEvidence evidence = made.evidence();
  ASSERT_EQ(evidence.grid().size, made.map.grid().size) << "all of it is looked at";
  Vector3i low = twin.grid.size, high = -Vector3i::Ones();
  for (const Vector3i& cell : twin.of_kind[std::size_t(Kind::occupied)])
    low = low.cwiseMin(cell), high = high.cwiseMax(cell);
  for (const Vector3i& cell : evidence_maps::cells(evidence))
    ASSERT_EQ(evidence.normal(cell).direction(), normal_by_comparing(twin, cell, low, high)) << cell.transpose();
}

// Blocks of 4 x 4 x 4: those in front of a plate are free, x = 8 .. 11; beside it one holds free voxels and others.
TEST(SurfaceEvidence, NormalsOfBlocksAreTowardsFreeBlocks) {
  MadeMap made({32, 32, 32});
  made.set_box({0, 0, 0}, {11, 31, 31}, -1.5);
  made.set_box({12, 24, 0}, {13, 31, 31}, -1.5);
  made.set_box({12, 8, 9}, {12, 23, 24}, 1.25);
  const SurfaceEvidence evidence = made.evidence(0.5, 0.2);
  ASSERT_EQ(evidence.block_edge(), 4);
  ASSERT_EQ(evidence.grid().first - made.map.grid().first, Vector3i(8, 4, 5)) << "where blocks begin";
  const auto normal = [&](const Vector3i& cell) {
    return evidence.normal(evidence.block_of(in_evidence(evidence, made.map.grid(), cell))).direction();
  };
  // Six free blocks in front, three of them at lower y: the region ends here. The box's nearest side is across y.
  EXPECT_LT((normal({13, 26, 16}) - Vector3(2, 1, 0).normalized()).norm(), 1e-12);
  EXPECT_EQ(normal({13, 22, 16}), Vector3(1, 0, 0)) << "a block that is free in part is not free";
  EXPECT_EQ(normal({16, 16, 16}), Vector3(1, 0, 0)) << "nothing free beside it: the box";
}

}  // namespace
}  // namespace nextview
