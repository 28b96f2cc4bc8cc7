#include "core/evaluation/map_quality.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace nextview {
namespace {

/// A row of voxels whose truth is set by hand.
GroundTruth truth_of(std::vector<std::uint8_t> touch, std::vector<std::uint8_t> centre,
                     std::vector<std::uint8_t> distance) {
  GroundTruth truth;
  truth.grid.size = {int(touch.size()), 1, 1};
  truth.touch = BitMask(touch);
  truth.centre = BitMask(centre);
  truth.near_surface = BitMask(distance.size());
  for (std::size_t i = 0; i < distance.size(); ++i) truth.near_surface.set(i, distance[i] <= band_width);
  return truth;
}

struct RandomCase {
  GroundTruth truth;
  std::vector<float> p;
  std::vector<std::uint8_t> visited;
};

RandomCase random_case(std::size_t voxels) {
  std::mt19937 generator(17);
  std::uniform_real_distribution<float> uniform;
  RandomCase c{
      truth_of(std::vector<std::uint8_t>(voxels), std::vector<std::uint8_t>(voxels), std::vector<std::uint8_t>(voxels)),
      {},
      {}};
  for (std::size_t i = 0; i < voxels; ++i) {
    c.truth.touch.set(i, uniform(generator) < 0.2f);
    c.truth.centre.set(i, uniform(generator) < 0.3f);
    c.truth.near_surface.set(i, c.truth.touch[i] || std::uint8_t(1.0f + 7.0f * uniform(generator)) <= band_width);
    c.visited.push_back(uniform(generator) < 0.6f);
    const float p = 1.2f * uniform(generator) - 0.1f;
    c.p.push_back(std::min(1.0f, std::max(0.0f, p)));  // 0 and 1 themselves occur
  }
  return c;
}

TEST(MapQuality, ScoresByHand) {
  // free said 0.12, occupied said 0.97, free said 0.7, hidden, occupied said 0 (wrong and certain), far and free said
  // 0.12
  const GroundTruth truth = truth_of({0, 1, 0, 0, 1, 0}, {0, 1, 0, 1, 0, 0}, {1, 0, 3, 2, 0, 4});
  const std::vector<float> p = {0.12f, 0.97f, 0.7f, 0.5f, 0.0f, 0.12f};
  const MapQuality band = map_quality(p, truth, TruthConvention::touch, ScoredSet::band);
  EXPECT_EQ(band.voxels, 4u);
  EXPECT_NEAR(band.log_loss, (-std::log(0.88) - std::log(0.97) - std::log(0.3) - std::log(0.001)) / 4, 1e-6);
  EXPECT_NEAR(band.brier, (0.12 * 0.12 + 0.03 * 0.03 + 0.7 * 0.7 + 1.0) / 4, 1e-6);
  const double of_free = 0.12 * std::log(0.12 / 0.001) + 0.88 * std::log(0.88 / 0.999);
  const double in_band = of_free + 0.97 * std::log(0.97 / 0.999) + 0.03 * std::log(0.03 / 0.001) +
                         0.7 * std::log(0.7 / 0.001) + 0.3 * std::log(0.3 / 0.999) + std::log(1.0 / 0.001);
  EXPECT_NEAR(band.divergence, in_band, 1e-5);
  EXPECT_EQ(band.divergence_outside_band, 0.0);
  EXPECT_NEAR(band.calibration_error, (0.12 + 0.03 + 0.7 + 1.0) / 4, 1e-6);
  EXPECT_EQ(band.reliability[9].voxels, 1u);
  EXPECT_NEAR(band.reliability[9].mean_probability, 0.97, 1e-6);
  EXPECT_EQ(band.reliability[9].occupied_share, 1.0);
  EXPECT_EQ(band.reliability[5].voxels, 0u);  // the hidden voxel

  const MapQuality region = map_quality(p, truth, TruthConvention::touch, ScoredSet::region);
  EXPECT_EQ(region.voxels, 5u);
  EXPECT_NEAR(region.divergence, in_band + of_free, 1e-5);
  EXPECT_NEAR(region.divergence_outside_band, of_free / (in_band + of_free), 1e-6);
}

/// Straight from the formulas, one score after the other, in long double.
MapQuality twin(const RandomCase& c, bool by_touch, bool only_visited, bool only_band) {
  MapQuality q;
  long double log_loss = 0, brier = 0, divergence = 0, outside = 0, calibration = 0;
  std::vector<std::size_t> scored;
  for (std::size_t i = 0; i < c.p.size(); ++i) {
    const bool hidden = c.truth.centre[i] == 1 && c.truth.touch[i] == 0;
    if (!hidden && (c.visited[i] || !only_visited) && (c.truth.near_surface[i] || !only_band)) scored.push_back(i);
  }
  const auto is_occupied = [&](std::size_t i) { return (by_touch ? c.truth.touch : c.truth.centre)[i] == 1; };
  for (const std::size_t i : scored) {
    const long double p = c.p[i], m = is_occupied(i);
    const long double given = m > 0 ? p : 1 - p;
    log_loss += -std::log(given < 0.001L ? 0.001L : given > 0.999L ? 0.999L : given);
    brier += std::pow(p - m, 2);
    long double d = 0;
    for (const int state : {0, 1}) {
      const long double said = state ? p : 1 - p, q_state = state == int(m) ? 0.999L : 0.001L;
      if (said > 0) d += said * (std::log(said) - std::log(q_state));
    }
    divergence += d;
    if (!c.truth.near_surface[i]) outside += d;
  }
  for (int b = 0; b < 10; ++b) {
    long double sum = 0, occupied = 0, count = 0;
    for (const std::size_t i : scored)
      if (double(c.p[i]) * 10 >= b && (double(c.p[i]) * 10 < b + 1 || b == 9))
        sum += c.p[i], occupied += is_occupied(i), ++count;
    if (count == 0) continue;
    calibration += count / (long double)(scored.size()) * std::abs(occupied / count - sum / count);
    q.reliability[std::size_t(b)] = {std::size_t(count), double(sum / count), double(occupied / count)};
  }
  const auto n = (long double)(scored.size());
  q.voxels = scored.size();
  q.log_loss = double(log_loss / n);
  q.brier = double(brier / n);
  q.divergence = double(divergence);
  q.divergence_outside_band = double(outside / divergence);
  q.calibration_error = double(calibration);
  return q;
}

TEST(MapQuality, OfSeveralSetsIsThatOfEach) {
  const RandomCase c = random_case(100'000);
  const std::vector<ScoredSet> sets = {ScoredSet::visited_band, ScoredSet::region, ScoredSet::visited};
  const auto all = map_quality(c.p, c.truth, TruthConvention::touch, sets, c.visited);
  ASSERT_EQ(all.size(), sets.size());
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const MapQuality one = map_quality(c.p, c.truth, TruthConvention::touch, sets[s], c.visited);
    EXPECT_EQ(all[s].voxels, one.voxels);
    EXPECT_EQ(all[s].log_loss, one.log_loss);
    EXPECT_EQ(all[s].divergence, one.divergence);
    EXPECT_EQ(all[s].reliability[3].mean_probability, one.reliability[3].mean_probability);
  }
}

TEST(MapQuality, AgreesWithTheFormulasOnEverySetAndConvention) {
  const RandomCase c = random_case(100'000);
  for (const auto set : {ScoredSet::visited, ScoredSet::region, ScoredSet::band, ScoredSet::visited_band})
    for (const auto convention : {TruthConvention::touch, TruthConvention::centre}) {
      SCOPED_TRACE(std::string(name(set)) + ", " + std::string(name(convention)));
      const MapQuality q = map_quality(c.p, c.truth, convention, set, c.visited);
      const MapQuality t =
          twin(c, convention == TruthConvention::touch, set == ScoredSet::visited || set == ScoredSet::visited_band,
               set == ScoredSet::band || set == ScoredSet::visited_band);
      EXPECT_EQ(q.voxels, t.voxels);
      EXPECT_NEAR(q.log_loss, t.log_loss, 1e-9);
      EXPECT_NEAR(q.brier, t.brier, 1e-9);
      EXPECT_NEAR(q.divergence, t.divergence, 1e-9 * t.divergence);
      EXPECT_NEAR(q.divergence_outside_band, t.divergence_outside_band, 1e-9);
      EXPECT_NEAR(q.calibration_error, t.calibration_error, 1e-9);
      for (std::size_t b = 0; b < 10; ++b) {
        EXPECT_EQ(q.reliability[b].voxels, t.reliability[b].voxels) << b;
        EXPECT_NEAR(q.reliability[b].mean_probability, t.reliability[b].mean_probability, 1e-9);
        EXPECT_NEAR(q.reliability[b].occupied_share, t.reliability[b].occupied_share, 1e-9);
      }
    }
}

TEST(MapQuality, APerfectMapHasNoErrorAndKeepsTheFloor) {
  RandomCase c = random_case(5000);
  for (std::size_t i = 0; i < c.p.size(); ++i) c.p[i] = c.truth.touch[i];
  const MapQuality q = map_quality(c.p, c.truth, TruthConvention::touch, ScoredSet::region);
  EXPECT_NEAR(q.log_loss, -std::log(0.999), 1e-12);
  EXPECT_EQ(q.brier, 0.0);
  EXPECT_EQ(q.calibration_error, 0.0);
  EXPECT_NEAR(q.divergence, -double(q.voxels) * std::log(0.999), 1e-9);
}

TEST(MapQuality, AnEmptySetScoresNothing) {
  const GroundTruth truth = truth_of({0, 0}, {1, 1}, {255, 255});
  const MapQuality q = map_quality(std::vector<float>{0.5f, 0.5f}, truth, TruthConvention::centre, ScoredSet::region);
  EXPECT_EQ(q.voxels, 0u);
  EXPECT_EQ(q.log_loss, 0.0);
  EXPECT_EQ(q.divergence, 0.0);
  EXPECT_EQ(q.divergence_outside_band, 0.0);
}

TEST(MapQuality, SameBitsOnAnyNumberOfThreads) {
  const RandomCase c = random_case(300'000);
  const auto score = [&] { return map_quality(c.p, c.truth, TruthConvention::touch, ScoredSet::visited, c.visited); };
  const MapQuality many = score();
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const MapQuality one = score();
  EXPECT_EQ(one.log_loss, many.log_loss);
  EXPECT_EQ(one.divergence, many.divergence);
  EXPECT_EQ(one.calibration_error, many.calibration_error);
}

/// Some bricks hold one value, as free space does, some many, and some were never measured.
VoxelBricks bricks_of_all_kinds(const Eigen::Vector3i& size, bool told) {
  std::mt19937 generator(5);
  VoxelBricks voxels(size);
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x) {
        const std::size_t place = voxels.place(x, y, z), brick = place / VoxelBricks::brick_voxels;
        if (brick % 3 == 0) continue;
        const float log_odds = brick % 3 == 1 ? -1.9924302f : 0.25f * float(int(generator() % 20) - 8);
        VoxelBricks::Brick& change = voxels.change_brick_of(place);
        change.set_measured(place % VoxelBricks::brick_voxels, log_odds, VoxelClass::unknown);
        if (!told) continue;
        Voxel voxel = change[place % VoxelBricks::brick_voxels];
        voxel.probability = 0.5f * voxel.probability + 1e-5f * float(generator() % 10'000);
        change.set(place % VoxelBricks::brick_voxels, voxel);
      }
  return voxels;
}

TEST(MapQuality, OfBricksIsThatOfTheirVoxels) {
  const Eigen::Vector3i size(150, 21, 13);  // whole bricks along no axis, and more than 64 along one
  RandomCase c = random_case(std::size_t(size.prod()));
  c.truth.grid.size = size;
  for (std::size_t i = c.p.size() / 2; i < c.p.size(); ++i)  // far from the surface, and where nobody has looked
    c.truth.touch.set(i, false), c.truth.centre.set(i, false), c.truth.near_surface.set(i, false),
        c.visited[i] = i % 150 < 75;
  const BitMask visited(c.visited);
  const std::vector<ScoredSet> all = {ScoredSet::visited, ScoredSet::region, ScoredSet::band, ScoredSet::visited_band};
  for (const bool told : {false, true})
    for (const auto& sets : {all, std::vector{ScoredSet::visited, ScoredSet::visited_band}})
      for (const auto convention : {TruthConvention::touch, TruthConvention::centre}) {
        const VoxelBricks bricks = bricks_of_all_kinds(size, told);
        const auto of_bricks = map_quality(bricks, c.truth, convention, sets, visited);
        const auto of_voxels = map_quality(probabilities(bricks), c.truth, convention, sets, c.visited);
        for (std::size_t s = 0; s < sets.size(); ++s) {
          EXPECT_GT(of_bricks[s].voxels, 0u);
          EXPECT_EQ(of_bricks[s].voxels, of_voxels[s].voxels);
          EXPECT_NEAR(of_bricks[s].log_loss, of_voxels[s].log_loss, 1e-12);
          EXPECT_NEAR(of_bricks[s].brier, of_voxels[s].brier, 1e-12);
          EXPECT_NEAR(of_bricks[s].divergence, of_voxels[s].divergence, 1e-12 * of_voxels[s].divergence);
          EXPECT_NEAR(of_bricks[s].divergence_outside_band, of_voxels[s].divergence_outside_band, 1e-12);
          EXPECT_NEAR(of_bricks[s].calibration_error, of_voxels[s].calibration_error, 1e-12);
          for (std::size_t b = 0; b < 10; ++b)
            EXPECT_EQ(of_bricks[s].reliability[b].voxels, of_voxels[s].reliability[b].voxels) << b;
        }
      }
}

TEST(MapQuality, LengthsThatDifferAreRefused) {
  const GroundTruth truth = truth_of({0, 1}, {0, 0}, {1, 0});
  const std::vector<float> p = {0.1f, 0.9f};
  EXPECT_THROW(map_quality(std::vector<float>{0.1f}, truth, TruthConvention::touch, ScoredSet::region),
               std::invalid_argument);
  EXPECT_THROW(map_quality(p, truth, TruthConvention::touch, ScoredSet::visited), std::invalid_argument);
  EXPECT_THROW(map_quality(p, truth, TruthConvention::touch, ScoredSet::visited_band, std::vector<std::uint8_t>{1}),
               std::invalid_argument);
  EXPECT_NO_THROW(map_quality(p, truth, TruthConvention::touch, ScoredSet::band));
}

}  // namespace
}  // namespace nextview
