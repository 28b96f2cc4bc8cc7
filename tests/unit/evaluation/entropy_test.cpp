#include "core/evaluation/entropy.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace nextview {
namespace {

/// `layers` layers of 100 by 100 voxels, which are no whole bricks.
VoxelBricks random_voxels(unsigned seed, int layers) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> uniform;
  const Eigen::Vector3i size(100, 100, layers);
  std::vector<Voxel> voxels(size.prod());
  for (Voxel& v : voxels) {
    v.measured = uniform(generator) < 0.4f;
    if (!v.measured) continue;
    v.probability = uniform(generator);
    v.entropy = static_cast<float>(entropy(v.probability));
  }
  return {size, voxels};
}

/// Entropy by the definition [bits].
double bits(double p) { return -p * std::log2(p) - (1.0 - p) * std::log2(1.0 - p); }

TEST(Entropy, AnUnmeasuredMapHasOneBitAVoxel) {
  const VoxelBricks voxels({128, 128, 128});
  EXPECT_EQ(map_entropy(voxels).unmeasured, 2097152.0);
  EXPECT_NEAR(map_entropy(voxels).total, 2097152.0, 0.1);
  EXPECT_EQ(map_entropy(VoxelBricks()).unmeasured, 0.0);
}

TEST(Entropy, MeasuredVoxelsAreDecidedInTheOneAndKeepTheirDoubtInTheOther) {
  const auto voxels = random_voxels(1, 10);
  double unmeasured = 0.0, total = 0.0;
  for (const Voxel& v : voxels) {
    unmeasured += v.measured ? 0 : 1;
    total += bits(v.probability);
  }
  EXPECT_EQ(map_entropy(voxels).unmeasured, unmeasured);
  EXPECT_NEAR(map_entropy(voxels).total, total, 1e-6 * total);
}

TEST(Entropy, AChangeIsWhatTheVoxelsLostAndThoseNewlyMeasured) {
  const auto before = random_voxels(2, 10), after = random_voxels(3, 10);
  double lost = 0.0;
  std::size_t newly = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    lost += (bits(before[i].probability) - bits(after[i].probability)) * std::log(2.0);
    newly += after[i].measured && !before[i].measured;
  }
  EXPECT_EQ(map_change(before, after).newly_measured, newly);
  EXPECT_NEAR(map_change(before, after).realised_gain, lost, 0.01);
  EXPECT_EQ(map_change(before, before).realised_gain, 0.0);
  EXPECT_EQ(map_change(before, after).realised_gain, -map_change(after, before).realised_gain);  // nats, and signed
  const VoxelBricks unknown({10, 1, 1});
  const VoxelBricks certain({10, 1, 1}, std::vector<Voxel>(10, {0.0f, 0.0f, VoxelClass::free, true, 0}));
  EXPECT_NEAR(map_change(unknown, certain).realised_gain, 10.0 * std::log(2.0), 1e-6);
  EXPECT_NEAR(map_change(certain, unknown).realised_gain, -10.0 * std::log(2.0), 1e-6);
}

TEST(Entropy, ClassesDifferWhereVoxelByVoxelTheyDo) {
  std::mt19937 generator(5);
  for (const Eigen::Vector3i& size : {Eigen::Vector3i(100, 100, 10), {9, 7, 17}, {16, 8, 24}, {1, 1, 1}}) {
    std::vector<Voxel> one(std::size_t(size.prod())), other(one.size());
    for (std::vector<Voxel>* voxels : {&one, &other})
      for (Voxel& v : *voxels) v.voxel_class = static_cast<VoxelClass>(generator() % 3);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < one.size(); ++i) differing += one[i].voxel_class != other[i].voxel_class;
    const VoxelBricks a(size, one), b(size, other);
    EXPECT_EQ(differing_classes(a, b), differing);
    EXPECT_EQ(differing_classes(a, a), 0u);
  }
}

TEST(Entropy, LengthsThatDifferAreRefused) {
  const VoxelBricks two({2, 1, 1}), three({3, 1, 1});
  EXPECT_THROW(map_change(two, three), std::invalid_argument);
  EXPECT_THROW(differing_classes(two, three), std::invalid_argument);
}

TEST(Entropy, SameBitsOnAnyNumberOfThreads) {
  const auto voxels = random_voxels(4, 40);
  const double many = map_entropy(voxels).total;
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(map_entropy(voxels).total, many);
}

}  // namespace
}  // namespace nextview
