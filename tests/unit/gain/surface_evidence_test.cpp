#include "core/gain/surface_evidence.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "tests/unit/gain/surface_evidence_twin.hpp"

namespace nextview {
namespace {

using Eigen::Vector3i;
using evidence_maps::in_evidence;
using evidence_maps::MadeMap;
using Kind = SurfaceEvidence::Kind;
using Twin = evidence_maps::EvidenceTwin;

template <std::size_t n>
void expect_near(const std::array<float, n>& found, const std::array<double, n>& expected) {
  for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(found[k], expected[k], 1e-5) << "feature " << k;
}

/// A plate at x = 10, seen from x < 10: 1 x 10 x 8 voxels, free ones in front of it.
MadeMap plate(double resolution = 0.02) {
  MadeMap made({30, 28, 26}, resolution);
  made.set_box({0, 6, 7}, {9, 19, 18}, -1.5);
  made.set_box({10, 8, 9}, {10, 17, 16}, 1.25);
  return made;
}
const double plate_size = std::sqrt(1.0 + 100.0 + 64.0);

TEST(SurfaceEvidence, KnowsTheBoxOfTheObject) {
  const MadeMap made = plate();
  const SurfaceEvidence evidence = made.evidence();
  EXPECT_NEAR(evidence.size(), plate_size, 1e-12);
  const VoxelGrid& whole = made.map.grid();
  const Vector3 lower = (whole.first + Vector3i(10, 8, 9)).cast<double>() * 0.02;
  EXPECT_LT((evidence.object().min() - lower).norm(), 1e-12);
  EXPECT_LT((evidence.object().sizes() - 0.02 * Vector3(1, 10, 8)).norm(), 1e-12);
  EXPECT_EQ(evidence.grid().resolution, 0.02);
  const Vector3i first = evidence.grid().first - whole.first, beyond = first + evidence.grid().size;
  EXPECT_TRUE((first.array() >= 0).all() && (beyond.array() <= whole.size.array()).all());
  EXPECT_TRUE((first.array() < Eigen::Array3i(10, 8, 9)).all()) << "some of what is around it is looked at";
  EXPECT_TRUE((beyond.array() > Eigen::Array3i(11, 18, 17)).all());
}

TEST(SurfaceEvidence, KindsAreThoseOfTheMap) {
  MadeMap made = plate();
  made.set({10, 12, 12}, 0.7);  // p = 0.67
  const VoxelGrid& whole = made.map.grid();
  for (const double threshold : {0.5, 0.7}) {
    const SurfaceEvidence evidence = made.evidence(threshold);
    for (const Vector3i& looked_at : evidence_maps::cells(evidence)) {
      const Vector3i cell = looked_at + evidence.grid().first - whole.first;
      const Voxel& voxel = made.map.voxels().at(cell.x(), cell.y(), cell.z());
      ASSERT_EQ(evidence.kind(looked_at), !voxel.measured                  ? Kind::unmeasured
                                          : voxel.probability >= threshold ? Kind::occupied
                                                                           : Kind::free);
    }
    EXPECT_EQ(evidence.kind(in_evidence(evidence, whole, {10, 12, 12})), threshold < 0.6 ? Kind::occupied : Kind::free);
  }
}

TEST(SurfaceEvidence, AVoxelThatHoldsScannedSurfaceIsOccupied) {
  MadeMap made = plate();
  const VoxelGrid& whole = made.map.grid();
  const Vector3i grazed(10, 12, 12), unmeasured(12, 12, 12), far_off(29, 0, 0);
  made.set(grazed, -0.4);
  OpenBorder border;
  for (const Vector3i& cell : {grazed, unmeasured, far_off})
    border.within.push_back(((whole.first + cell).cast<double>() * 0.02 + Vector3(0.001, 0.019, 0.01)).cast<float>());
  const SurfaceEvidence without = made.evidence();
  const SurfaceEvidence evidence = made.evidence(0.5, SurfaceEvidence::finest_share, border);
  const auto kind = [&](const SurfaceEvidence& of, const Vector3i& cell) {
    return of.kind(in_evidence(of, whole, cell));
  };
  EXPECT_EQ(kind(without, grazed), Kind::free);
  EXPECT_EQ(kind(evidence, grazed), Kind::occupied);
  EXPECT_EQ(kind(evidence, unmeasured), Kind::unmeasured) << "nothing was measured there: it is asked for";
}

TEST(SurfaceEvidence, UnmeasuredVoxelsByHand) {
  const MadeMap made = plate();
  VoxelBricks occlusions = made.map.voxels();
  const std::size_t place = occlusions.place(12, 12, 12);
  occlusions.change_brick_of(place).set_occlusion_distance(place % VoxelBricks::brick_voxels, 3);
  const VoxelGrid& whole = made.map.grid();
  const SurfaceEvidence evidence(whole, made.map.voxels(), occlusions, 0.5);
  const double s = plate_size;
  const auto features = [&](const Vector3i& cell) { return evidence.unmeasured(in_evidence(evidence, whole, cell)); };
  const auto ln = [&](double voxels) { return std::log(voxels / s); };
  // Behind the middle of the plate: 2 outside of it along x, 3 from what is free.
  expect_near(features({12, 12, 12}), {1, ln(2), ln(3), ln(3) * ln(3), 0, ln(3), std::sqrt(2 / s), 2 / s, 0});
  expect_near(features({11, 13, 12}), {1, ln(1), ln(2), ln(2) * ln(2), 1, 0, std::sqrt(1 / s), 1 / s, 0});
  // Past the edge y = 17 by 1 and behind it by 1: the diagonal x + y says root 2 (18 .. 27 is inside, 29 is not).
  expect_near(features({11, 18, 12}),
              {1, ln(std::sqrt(2)), ln(2), ln(2) * ln(2), 1, 0, std::sqrt(std::sqrt(2) / s), std::sqrt(2) / s, 0});
}

// A hollow box: its inside is not known, and lies inside its hull.
TEST(SurfaceEvidence, InsideTheHullIsNegative) {
  MadeMap made({20, 20, 20});
  made.set_box({5, 5, 5}, {14, 13, 12}, 1.0);
  const MadeMap solid = made;
  MadeMap hollow({20, 20, 20});
  MadeMap::for_each({5, 5, 5}, {14, 13, 12}, [&](const Vector3i& cell) {
    if ((cell.array() == 5).any() || cell.x() == 14 || cell.y() == 13 || cell.z() == 12) hollow.set(cell, 1.0);
  });
  const SurfaceEvidence evidence = hollow.evidence();
  const double s = std::sqrt(100.0 + 81.0 + 64.0);
  EXPECT_NEAR(evidence.size(), s, 1e-12);
  const auto deep = evidence.unmeasured(in_evidence(evidence, hollow.map.grid(), {9, 9, 8}));
  EXPECT_NEAR(deep[1], std::log(3.0 / s), 1e-5);
  EXPECT_EQ(deep[6], 0.0f);
  EXPECT_EQ(deep[7], 0.0f);
  EXPECT_NEAR(deep[8], -3.0 / s, 1e-5) << "the nearest side is z = 5";
  const auto beside = evidence.unmeasured(in_evidence(evidence, hollow.map.grid(), {6, 9, 8}));
  EXPECT_NEAR(beside[8], -1.0 / s, 1e-5);
  EXPECT_EQ(solid.evidence().size(), evidence.size()) << "the box is that of what is occupied";
}

TEST(SurfaceEvidence, MeasuredVoxelsByHand) {
  const MadeMap made = plate();
  const SurfaceEvidence evidence = made.evidence();
  const auto inside = [&](const Vector3i& cell) { return in_evidence(evidence, made.map.grid(), cell); };
  // In the plate: 8 beside it, 9 free in front, 9 unmeasured behind.
  expect_near(evidence.measured(inside({10, 12, 12})), {1, 1.25, std::log(10.0), 1, 8});
  // Its edge y = 17: 5 beside it, 9 free, the rest unmeasured.
  expect_near(evidence.measured(inside({10, 17, 12})), {1, 1.25, std::log(13.0), 1, 5});
  expect_near(evidence.measured(inside({9, 12, 12})), {1, -1.5, 0, 1, 9});
  expect_near(evidence.measured(inside({9, 18, 12})), {1, -1.5, std::log(7.0), 1, 3});
  expect_near(evidence.measured(inside({8, 12, 12})), {1, -1.5, 0, 0, 0});
  EXPECT_FALSE(evidence.may_hold_surface(inside({8, 12, 12})));
  for (const Vector3i& cell : {Vector3i(9, 12, 12), Vector3i(10, 12, 12), Vector3i(11, 12, 12), Vector3i(9, 19, 12)})
    EXPECT_TRUE(evidence.may_hold_surface(inside(cell))) << cell.transpose();
}

TEST(SurfaceEvidence, AgreesWithComparingAllVoxels) {
  std::mt19937 random(1);
  for (const double unmeasured : {0.3, 0.9}) {
    const MadeMap made = evidence_maps::random_map(random, {13, 9, 11}, 0.3, unmeasured);
    const Twin twin(made);
    const SurfaceEvidence evidence = made.evidence();
    ASSERT_EQ(evidence.grid().first, twin.grid.first) << "nothing of so full a map is left out";
    ASSERT_EQ(evidence.grid().size, twin.grid.size);
    ASSERT_NEAR(evidence.size(), twin.size, 1e-12);
    for (std::uint32_t v = 0; v < twin.grid.voxel_count(); ++v) {
      const Vector3i cell = twin.grid.cell(v);
      ASSERT_EQ(evidence.kind(cell), twin.kind(cell));
      const int unknown = twin.around(cell, Kind::unmeasured), occupied = twin.around(cell, Kind::occupied);
      EXPECT_EQ(evidence.may_hold_surface(cell), twin.kind(cell) != Kind::free || unknown + occupied > 0);
      if (twin.kind(cell) == Kind::unmeasured) {
        const double free = twin.ln_distance(cell, Kind::free), outside = twin.outside(cell) / twin.size;
        expect_near(evidence.unmeasured(cell),
                    {1, twin.ln_distance(cell, Kind::occupied), free, free * free, 1, 0,
                     std::sqrt(std::max(outside, 0.0)), std::max(outside, 0.0), std::min(outside, 0.0)});
      } else {
        expect_near(evidence.measured(cell),
                    {1, made.map.log_odds(v), std::log(1.0 + unknown), occupied > 0 ? 1.0 : 0.0, double(occupied)});
      }
    }
  }
}

TEST(SurfaceEvidence, ALargeObjectIsUnmeasuredInBlocks) {
  std::mt19937 random(5);
  for (const int edge : {2, 4}) {
    const MadeMap made = evidence_maps::random_map(random, {17, 14, 11}, 0.2, 0.97);
    const Twin twin(made);
    const SurfaceEvidence evidence = made.evidence(0.5, 1.01 * edge / twin.size);
    ASSERT_EQ(evidence.block_edge(), edge);
    ASSERT_EQ(evidence.grid().size, twin.grid.size);
    std::array<std::vector<Vector3i>, 3> blocks;  // that hold a voxel of each kind
    for (const Vector3i& cell : evidence_maps::cells(evidence))
      blocks[std::size_t(twin.kind(cell))].push_back(evidence.block_of(cell));
    std::vector<Vector3i> seen;
    for (const Vector3i& cell : evidence_maps::cells(evidence)) {  // of a block the first comes first
      const Vector3i block = evidence.block_of(cell);
      if (twin.kind(cell) != Kind::unmeasured || std::ranges::find(seen, block) != seen.end()) continue;
      seen.push_back(block);
      ASSERT_TRUE(evidence.unmeasured_blocks().at(block));
      const auto ln_distance = [&](Kind to) {
        double nearest = 1e9;
        for (const Vector3i& other : blocks[std::size_t(to)])
          nearest = std::min(nearest, (other - block).cast<double>().norm());
        return std::log(std::max(edge * nearest, edge / 2.0) / twin.size);
      };
      const double free = ln_distance(Kind::free), outside = twin.outside(cell) / twin.size;
      expect_near(evidence.unmeasured(block),
                  {1, ln_distance(Kind::occupied), free, free * free, 1, 0, std::sqrt(std::max(outside, 0.0)),
                   std::max(outside, 0.0), std::min(outside, 0.0)});
    }
    EXPECT_GT(seen.size(), 20u);
  }
}

TEST(SurfaceEvidence, OfTheUsualSizeVoxelsAreLookedAtOneByOne) {
  EXPECT_EQ(plate().evidence().block_edge(), 1);
  EXPECT_EQ(plate().evidence(0.5, 1.9 / plate_size).block_edge(), 1);
  EXPECT_EQ(plate().evidence(0.5, 2.1 / plate_size).block_edge(), 2);
}

/// The same features in the voxels that `image` takes the first map's to.
void expect_alike(const SurfaceEvidence& a, const VoxelGrid& whole_a, const SurfaceEvidence& b,
                  const VoxelGrid& whole_b, const std::function<Vector3i(const Vector3i&)>& image) {
  ASSERT_EQ(a.grid().voxel_count(), b.grid().voxel_count());
  EXPECT_EQ(a.size(), b.size());
  for (const Vector3i& of_a : evidence_maps::cells(a)) {
    const Vector3i of_b = in_evidence(b, whole_b, image(of_a + a.grid().first - whole_a.first));
    ASSERT_EQ(a.kind(of_a), b.kind(of_b));
    if (a.kind(of_a) == Kind::unmeasured)
      ASSERT_EQ(a.unmeasured(of_a), b.unmeasured(of_b)) << of_a.transpose();
    else
      ASSERT_EQ(a.measured(of_a), b.measured(of_b)) << of_a.transpose();
  }
}

TEST(SurfaceEvidence, IsTheSameOfALargerObjectInLargerVoxels) {
  const MadeMap small = plate(0.005), large = plate(0.5);
  expect_alike(small.evidence(), small.map.grid(), large.evidence(), large.map.grid(),
               [](const Vector3i& cell) { return cell; });
}

TEST(SurfaceEvidence, OfAMirroredOrTurnedMapIsMirroredOrTurned) {
  std::mt19937 random(2);
  const Vector3i size(14, 11, 9);
  MadeMap made = evidence_maps::random_map(random, size, 0.05, 0.6);
  MadeMap mirrored(size), turned({9, 14, 11});
  const auto mirror = [&](const Vector3i& cell) { return Vector3i(13 - cell.x(), cell.y(), cell.z()); };
  const auto turn = [&](const Vector3i& cell) { return Vector3i(cell.z(), cell.x(), cell.y()); };
  for (std::uint32_t v = 0; v < made.map.grid().voxel_count(); ++v) {
    if (!made.map.voxels()[v].measured) continue;
    mirrored.set(mirror(made.map.grid().cell(v)), made.map.log_odds(v));
    turned.set(turn(made.map.grid().cell(v)), made.map.log_odds(v));
  }
  expect_alike(made.evidence(), made.map.grid(), mirrored.evidence(), mirrored.map.grid(), mirror);
  expect_alike(made.evidence(), made.map.grid(), turned.evidence(), turned.map.grid(), turn);
}

TEST(SurfaceEvidence, IsOfNoVoxelsIfNoneIsOccupied) {
  MadeMap made({12, 12, 12});
  EXPECT_EQ(made.evidence().grid().voxel_count(), 0u);
  made.set_box({2, 2, 2}, {9, 9, 9}, -1.0);
  EXPECT_EQ(made.evidence().grid().voxel_count(), 0u);
  made.set({5, 5, 5}, 1.0);
  EXPECT_GT(made.evidence().grid().voxel_count(), 0u);
  EXPECT_NEAR(made.evidence().size(), std::sqrt(3.0), 1e-12);
}

TEST(SurfaceEvidence, AThousandthOfOutliersDoesNotMoveTheBox) {
  MadeMap made({60, 60, 60});
  made.set_box({20, 20, 20}, {32, 32, 31}, 1.0);  // 13 x 13 x 12 = 2028
  const SurfaceEvidence before = made.evidence();
  made.set({57, 20, 21}, 1.0);
  made.set({58, 31, 25}, 1.0);  // two of 2030
  const SurfaceEvidence after = made.evidence();
  EXPECT_EQ(after.object().min(), before.object().min());
  EXPECT_EQ(after.object().max(), before.object().max());
  expect_alike(before, made.map.grid(), after, made.map.grid(), [](const Vector3i& cell) { return cell; });
  made.set({59, 25, 25}, 1.0);  // three are more
  EXPECT_GT(made.evidence().object().max().x(), before.object().max().x());
  EXPECT_EQ(made.evidence().object().min(), before.object().min());
}

TEST(SurfaceEvidence, FewVoxelsHaveNoOutliers) {
  MadeMap made({30, 30, 30});
  made.set_box({10, 10, 10}, {18, 18, 18}, 1.0);  // 729
  made.set({25, 10, 10}, 1.0);
  EXPECT_NEAR(made.evidence().object().sizes().x(), 16 * 0.02, 1e-12);
}

TEST(SurfaceEvidence, TheSameOnOneThreadAndTwo) {
  std::mt19937 random(3);
  const MadeMap made = evidence_maps::random_map(random, {40, 37, 41}, 0.2, 0.5);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return made.evidence();
  };
  expect_alike(run(1), made.map.grid(), run(2), made.map.grid(), [](const Vector3i& cell) { return cell; });
}

}  // namespace
}  // namespace nextview
