// Sums over voxels round alike on any number of threads, run after run: with terms of many magnitudes any other order
// of adding shows in the last bits.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <random>

#include "core/evaluation/entropy.hpp"
#include "core/evaluation/map_quality.hpp"
#include "core/map/ground_truth.hpp"

namespace nextview {
namespace {

constexpr std::size_t count = 400'000;
const Eigen::Vector3i size(100, 100, 40);
constexpr int repetitions = 20;

/// Probabilities from 1e-12 to 1/2, evenly by their logarithm, and entropies to match.
VoxelBricks voxels_of_many_magnitudes(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> exponent(-12.0, std::log10(0.5));
  std::vector<Voxel> voxels(count);
  for (Voxel& v : voxels) {
    const double p = std::pow(10.0, exponent(generator));
    v.probability = static_cast<float>(p);
    v.entropy = static_cast<float>(entropy(p) * 0.7);
    v.measured = true;
  }
  return {size, voxels};
}

/// The same on 1, 2, 3 and 8 threads, each many times over, as who takes which part is chance.
template <class Sum>
void expect_one_value(const char* what, Sum sum) {
  const auto expected = [&] {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    return sum();
  }();
  for (const std::size_t threads : {1, 2, 3, 8}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    for (int repeat = 0; repeat < repetitions; ++repeat)
      ASSERT_EQ(sum(), expected) << what << ", " << threads << " threads, run " << repeat + 1;
  }
}

// What the test stands on: added the other way round, the terms give another sum.
TEST(DeterministicSums, TheOrderOfTheseTermsMatters) {
  const auto voxels = voxels_of_many_magnitudes(1).dense();
  double forwards = 0.0, backwards = 0.0;
  for (std::size_t i = 0; i < count; ++i) forwards += voxels[i].entropy, backwards += voxels[count - 1 - i].entropy;
  EXPECT_NE(forwards, backwards);
}

TEST(DeterministicSums, TotalEntropy) {
  const auto voxels = voxels_of_many_magnitudes(1);
  expect_one_value("total entropy", [&] { return map_entropy(voxels).total; });
}

TEST(DeterministicSums, RealisedGain) {
  const auto before = voxels_of_many_magnitudes(2), after = voxels_of_many_magnitudes(3);
  expect_one_value("realised gain", [&] { return map_change(before, after).realised_gain; });
}

TEST(DeterministicSums, MapQuality) {
  GroundTruth truth;
  truth.grid = {0.01, {0, 0, 0}, size};
  truth.touch = truth.centre = BitMask(count);
  for (std::size_t v = 0; v < count; v += 3) truth.touch.set(v);
  truth.near_surface = truth.touch;
  const auto p = probabilities(voxels_of_many_magnitudes(4));
  expect_one_value("map quality", [&] {
    const MapQuality q = map_quality(p, truth, TruthConvention::touch, ScoredSet::region);
    return std::array{q.log_loss, q.brier, q.divergence, q.divergence_outside_band, q.calibration_error};
  });
}

}  // namespace
}  // namespace nextview
