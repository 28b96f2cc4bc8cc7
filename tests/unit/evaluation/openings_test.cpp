#include "core/evaluation/openings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "tests/unit/evaluation/slotted_plate.hpp"

namespace nextview {
namespace {

TEST(Openings, APerfectMapIsOpenWhereItShouldBe) {
  for (const double width : {0.025, 0.03, 0.041}) {
    const Plate plate(width);
    const OpeningScore score = plate.score(plate.perfect_map());
    EXPECT_EQ(score.rows, 10u);
    EXPECT_EQ(score.row_openness(), 1.0) << width;
    EXPECT_EQ(score.recall(), 1.0);
    EXPECT_EQ(score.control_rows, 20u) << width;
    EXPECT_EQ(score.leaks(), 0.0);
  }
}

TEST(Openings, MapsThatSayOneThingEverywhere) {
  const Plate plate(0.03);
  const OpeningScore all_free = plate.score(plate.map_of(free_voxel));
  EXPECT_EQ(all_free.row_openness(), 1.0);
  EXPECT_EQ(all_free.recall(), 1.0);
  EXPECT_EQ(all_free.leaks(), 1.0);  // what opens walls is caught
  Voxel guessed_free = free_voxel;
  guessed_free.measured = false;  // free only by a prior: not called free
  Voxel even = free_voxel;
  even.probability = 0.5f;  // p < 0.5 is free, 0.5 is not
  for (const Voxel& voxel : {occupied_voxel, Voxel{}, guessed_free, even}) {
    const OpeningScore score = plate.score(plate.map_of(voxel));
    EXPECT_EQ(score.row_openness(), 0.0);
    EXPECT_EQ(score.recall(), 0.0);
    EXPECT_EQ(score.leaks(), 0.0);
  }
}

TEST(Openings, ARowIsClosedOnlyAcrossItsWholeWidth) {
  const Plate plate(0.03);
  std::vector<Voxel> map = plate.map_of(free_voxel);
  // Rows lie at y = 0.0021 + (r - 4.5) cm: close the voxels of three of them within the wall, all but one column in the
  // third.
  for (const int r : {2, 3, 7})
    for (double x = -0.045; x < 0.05; x += edge)
      if (r != 7 || std::abs(x - 0.005) > 1e-9) plate.at(map, {x, 0.0021 + (r - 4.5) * edge, 0.012}) = occupied_voxel;
  EXPECT_EQ(plate.score(map).open_rows, 8u);
}

TEST(Openings, ANarrowRowIsOpenAtItsRimToo) {
  const Plate plate(0.012);  // from x = -2.3 mm to 9.7 mm
  std::vector<Voxel> map = plate.map_of(occupied_voxel);
  for (std::uint32_t i = 0; i < map.size(); ++i)
    if (std::abs(plate.truth.grid.centre(i).x() + 0.005) < 1e-9) map[i] = free_voxel;
  EXPECT_EQ(plate.score(map).row_openness(), 1.0);
}

TEST(Openings, LinesReachOneVoxelEdgeBeyondTheMouths) {
  const Plate plate(0.03);
  for (const double side : {-1.0, 1.0}) {
    std::vector<Voxel> map = plate.map_of(free_voxel);
    for (std::uint32_t i = 0; i < map.size(); ++i)
      if (std::abs(plate.truth.grid.centre(i).z() - side * 0.035) < 1e-9) map[i] = occupied_voxel;  // from 3 cm on
    EXPECT_EQ(plate.score(map).open_rows, 10u);
    for (std::uint32_t i = 0; i < map.size(); ++i)
      if (std::abs(plate.truth.grid.centre(i).z() - side * 0.025) < 1e-9)
        map[i] = Voxel{};  // from 2 to 3 cm; the mouth is at 1.5
    EXPECT_EQ(plate.score(map).open_rows, 0u);
  }
}

TEST(Openings, RecallCountsTheFreeVoxelsWithin) {
  for (const double width : {0.01, 0.025, 0.04})
    for (const auto convention : {TruthConvention::touch, TruthConvention::centre}) {
      const Plate plate(width);
      std::vector<Voxel> map = plate.map_of(occupied_voxel);
      std::vector<std::uint8_t> scored(map.size(), 0);
      std::size_t truly_free = 0, called = 0, free_scored = 0;
      for (std::uint32_t i = 0; i < map.size(); ++i) {
        if (i % 3 == 0) map[i] = free_voxel;
        scored[i] = i % 2;
        const Eigen::Array3d offset = (plate.truth.grid.centre(i) - plate.slot.centre).cwiseAbs().array();
        if (!(offset <= Eigen::Array3d(0.5 * width, 0.06, 0.015)).all()) continue;
        const bool occupied = convention == TruthConvention::touch ? plate.truth.touch[i] : plate.truth.centre[i];
        truly_free += !occupied;
        called += !occupied && i % 3 == 0;
        free_scored += !occupied && i % 2;
      }
      const OpeningScore score = plate.score(map, convention);
      EXPECT_EQ(score.free_voxels, truly_free);
      EXPECT_EQ(score.called_free, called);
      EXPECT_EQ(score_opening(plate.slot, map, plate.truth, convention, scored).free_voxels, free_scored);
      // The surface touches every voxel of an unaligned slot of one voxel's width: recall says nothing there.
      EXPECT_EQ(score.recall().has_value(), width > 0.01 || convention == TruthConvention::centre);
    }
}

TEST(Openings, ALeakIsCountedInItsRow) {
  const Plate plate(0.03);
  std::vector<Voxel> map = plate.perfect_map();
  // The strip to the right lies 5 cm beside the slot.
  for (const double z : {-0.025, -0.015, -0.005, 0.005, 0.015, 0.025})
    plate.at(map, {0.0037 + 0.05, 0.0021 - 0.005, z}) = free_voxel;
  const OpeningScore score = plate.score(map);
  EXPECT_EQ(score.leaking_rows, 1u);
  EXPECT_EQ(score.control_rows, 20u);
}

TEST(Openings, ControlsAreLeftOutWhereTheWallIsNotSolid) {
  const Plate near_rim(0.03, {0.0937, 0.0021, 0.0});  // the strip to the right would reach over the plate's rim
  EXPECT_EQ(near_rim.score(near_rim.perfect_map()).control_rows, 10u);
}

TEST(Openings, ABoreIsRound) {
  Plate plate(0.03);
  Opening bore = plate.slot;
  bore.kind = Opening::Kind::bore;
  bore.width = 0.073;
  bore.centre.x() = 0.0017;
  bore.length = 0.073;
  plate.truth.touch = plate.truth.centre = BitMask(plate.truth.centre.size());
  std::size_t within = 0;
  for (std::uint32_t i = 0; i < plate.truth.grid.voxel_count(); ++i) {
    const Vector3 offset = plate.truth.grid.centre(i) - bore.centre;
    within += std::hypot(offset.x(), offset.y()) <= 0.0365 && std::abs(offset.z()) <= 0.015;
  }
  const OpeningScore score = score_opening(bore, plate.map_of(free_voxel), plate.truth, TruthConvention::touch);
  EXPECT_EQ(score.rows, 5u);
  EXPECT_EQ(score.open_rows, 5u);
  EXPECT_EQ(score.free_voxels, within);
  EXPECT_FALSE(score.leaks().has_value());  // nothing is solid here

  // What lies outside of the circle but inside of its square cannot open the first row, which is 6.1 cm wide.
  std::vector<Voxel> map = plate.map_of(occupied_voxel);
  for (const double x : {-0.035, 0.035})
    for (double z = -0.035; z < 0.04; z += edge)
      plate.at(map, {bore.centre.x() + x, bore.centre.y() - 0.02, z}) = free_voxel;
  EXPECT_EQ(score_opening(bore, map, plate.truth, TruthConvention::touch).open_rows, 0u);
}

TEST(Openings, ATiltedOpeningFollowsItsAxes) {
  const Plate plate(0.03);
  Opening tilted = plate.slot;
  const Eigen::AngleAxisd turn(0.9, Vector3(0.3, 1.0, 0.2).normalized());
  tilted.axis = turn * tilted.axis;
  tilted.along = turn * tilted.along;
  tilted.length = 0.05;
  tilted.width = 0.01;
  tilted.depth = 0.06;
  // Only a channel along the tilted axes is free, wide enough for the voxels on its lines.
  std::vector<Voxel> map = plate.map_of(occupied_voxel);
  for (std::uint32_t i = 0; i < map.size(); ++i) {
    const Vector3 offset = turn.inverse() * (plate.truth.grid.centre(i) - tilted.centre);
    if (std::abs(offset.x()) < 0.014 && std::abs(offset.y()) < 0.024) map[i] = free_voxel;
  }
  const OpeningScore score = score_opening(tilted, map, plate.truth, TruthConvention::touch);
  EXPECT_EQ(score.rows, 3u);
  EXPECT_EQ(score.open_rows, 3u);
  Opening upright = tilted;
  upright.axis = Vector3::UnitZ();
  upright.along = Vector3::UnitY();
  EXPECT_EQ(score_opening(upright, map, plate.truth, TruthConvention::touch).open_rows, 0u);
}

TEST(Openings, OutsideOfTheGridNothingIsOpen) {
  const Plate plate(0.03);
  Opening outside = plate.slot;
  outside.centre.z() = 0.07;
  const OpeningScore score = score_opening(outside, plate.map_of(free_voxel), plate.truth, TruthConvention::touch);
  EXPECT_EQ(score.open_rows, 0u);
  outside.centre.x() = 100.0;
  EXPECT_EQ(score_opening(outside, plate.map_of(free_voxel), plate.truth, TruthConvention::touch).free_voxels, 0u);
}

TEST(Openings, ScoresAddUp) {
  OpeningScore sum{10, 5, 100, 80, 4, 1};
  sum += {10, 10, 100, 100, 0, 0};
  EXPECT_EQ(sum.row_openness(), 0.75);
  EXPECT_EQ(sum.recall(), 0.9);
  EXPECT_EQ(sum.leaks(), 0.25);
  EXPECT_FALSE(OpeningScore{}.row_openness().has_value());
}

TEST(Openings, SurfaceRecallCountsOccupiedVoxels) {
  const Plate plate(0.03);
  EXPECT_EQ(surface_recall(plate.perfect_map(), plate.truth, TruthConvention::touch), 1.0);
  EXPECT_EQ(surface_recall(plate.map_of(free_voxel), plate.truth, TruthConvention::touch), 0.0);
  EXPECT_EQ(surface_recall(plate.map_of(Voxel{}), plate.truth, TruthConvention::touch), 0.0);  // 0.5, but not measured
  std::vector<Voxel> half = plate.map_of(free_voxel);
  std::vector<std::uint8_t> scored(half.size(), 0);
  std::size_t touched = 0;
  for (std::size_t i = 0; i < half.size(); ++i)
    if (plate.truth.touch[i] && touched++ % 2) half[i] = occupied_voxel, scored[i] = 1;
  EXPECT_NEAR(surface_recall(half, plate.truth, TruthConvention::touch).value(), 0.5, 0.001);
  EXPECT_EQ(surface_recall(half, plate.truth, TruthConvention::touch, scored), 1.0);
  BitMask mask(scored.size());
  mask.add(scored);
  const VoxelBricks bricks(plate.truth.grid.size, half);
  EXPECT_EQ(surface_recall(bricks, plate.truth, TruthConvention::touch, mask), 1.0) << "of a map as it is kept";
  scored.assign(scored.size(), 0);
  EXPECT_FALSE(surface_recall(half, plate.truth, TruthConvention::touch, scored).has_value());
}

TEST(Openings, OfOurPartsShowInAMapThatEqualsTheTruth) {
  for (const Part& part : {slotted_plate(), slotted_housing()}) {
    const GroundTruth truth = ground_truth(part.mesh, region_of_interest(Vector3::Zero(), 1.28, edge));
    for (const auto convention : {TruthConvention::touch, TruthConvention::centre}) {
      std::vector<Voxel> map(truth.grid.voxel_count());
      for (std::size_t i = 0; i < map.size(); ++i)
        if (const VoxelTruth voxel = voxel_truth(truth, i, convention); voxel != VoxelTruth::hidden)
          map[i] = voxel == VoxelTruth::occupied ? occupied_voxel : free_voxel;
      for (const Opening& opening : part.openings) {
        const OpeningScore score = score_opening(opening, map, truth, convention);
        // The surface touches every voxel in an opening of one voxel's width.
        const bool can_be_open = opening.width > 0.015 || convention == TruthConvention::centre;
        EXPECT_EQ(score.row_openness(), can_be_open ? 1.0 : 0.0) << part.name << ' ' << opening.width;
        EXPECT_EQ(score.recall(), can_be_open ? std::optional(1.0) : std::nullopt);
        EXPECT_EQ(score.leaks(), 0.0);
      }
    }
  }
}

TEST(Openings, BadInputIsRefused) {
  const Plate plate(0.03);
  const auto map = plate.map_of(free_voxel);
  const auto refused = [&](const Opening& opening) {
    EXPECT_THROW(score_opening(opening, map, plate.truth, TruthConvention::touch), std::invalid_argument);
  };
  Opening bad = plate.slot;
  bad.width = 0.0;
  refused(bad);
  bad = plate.slot;
  bad.along = Vector3(0, 2, 0);
  refused(bad);
  bad = plate.slot;
  bad.along = bad.axis;
  refused(bad);
  const std::vector<Voxel> few(3);
  EXPECT_THROW(score_opening(plate.slot, few, plate.truth, TruthConvention::touch), std::invalid_argument);
  EXPECT_THROW(surface_recall(few, plate.truth, TruthConvention::touch), std::invalid_argument);
  const VoxelBricks bricks(plate.truth.grid.size);
  EXPECT_THROW(surface_recall(bricks, plate.truth, TruthConvention::touch, BitMask(3)), std::invalid_argument);
}

}  // namespace
}  // namespace nextview
