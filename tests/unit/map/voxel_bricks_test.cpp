#include "core/map/voxel_bricks.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <thread>

#include "core/map/occupancy_map.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

Voxel numbered(std::uint32_t number) {
  Voxel voxel;
  voxel.measured = true;
  voxel.log_odds = static_cast<float>(number);
  return voxel;
}

void number(VoxelBricks& bricks, int x, int y, int z, std::uint32_t number) {
  const std::size_t place = bricks.place(x, y, z);
  bricks.change_brick_of(place).set_measured(place % VoxelBricks::brick_voxels, float(number), VoxelClass::unknown);
}

const std::vector<Eigen::Vector3i> brick_sizes = {{0, 0, 0},  {1, 1, 1},   {8, 8, 8},
                                                  {9, 7, 17}, {16, 8, 24}, {3, 41, 10}};

TEST(VoxelBricks, HoldWhatTheyAreMadeOfInTheGridsOrder) {
  for (const Eigen::Vector3i& size : brick_sizes) {
    std::vector<Voxel> voxels(std::size_t(size.prod()));
    for (std::uint32_t v = 0; v < voxels.size(); ++v) voxels[v] = numbered(v + 1);
    const VoxelBricks bricks(size, voxels);
    ASSERT_EQ(bricks.size(), voxels.size());
    std::uint32_t v = 0;
    for (const Voxel& voxel : bricks) ASSERT_EQ(voxel.log_odds, float(++v));
    EXPECT_EQ(v, voxels.size());
    v = 0;
    for (int z = 0; z < size.z(); ++z)
      for (int y = 0; y < size.y(); ++y)
        for (int x = 0; x < size.x(); ++x, ++v) {
          ASSERT_EQ(bricks.at(x, y, z).log_odds, float(v + 1));
          ASSERT_EQ(bricks[v].log_odds, float(v + 1));
          ASSERT_EQ((*bricks.from(v)).log_odds, float(v + 1));
          ASSERT_EQ(bricks.cell(bricks.place(x, y, z)), Eigen::Vector3i(x, y, z));
        }
    EXPECT_EQ(bricks.dense().size(), voxels.size());
    const VoxelBricks asked_for = VoxelBricks::made_of(size, [&](std::size_t i) { return voxels[i]; });
    EXPECT_TRUE(std::ranges::equal(asked_for, bricks, {}, &Voxel::log_odds, &Voxel::log_odds));
  }
  EXPECT_THROW(VoxelBricks({2, 2, 2}, std::vector<Voxel>(7)), std::invalid_argument);
}

TEST(VoxelBricks, CopiesNeverSeeEachOthersChanges) {
  std::mt19937 random(1);
  const Eigen::Vector3i size(20, 9, 33);
  std::vector<VoxelBricks> copies(1, VoxelBricks(size));
  std::vector<std::vector<Voxel>> expected(1, copies.front().dense());  // the oracle: nothing is shared
  for (int i = 0; i < 400; ++i) {
    const std::size_t which = random() % copies.size();
    if (i % 20 == 19) {
      copies.push_back(copies[which]);
      expected.push_back(expected[which]);
    }
    const int x = int(random() % 20), y = int(random() % 9), z = int(random() % 33);
    number(copies[which], x, y, z, std::uint32_t(i));
    expected[which][std::size_t(z * 9 + y) * 20 + std::size_t(x)] = numbered(std::uint32_t(i));
    if (i % 50 == 49 && copies.size() > 2) {
      copies.erase(copies.begin() + 1);
      expected.erase(expected.begin() + 1);
    }
  }
  for (std::size_t c = 0; c < copies.size(); ++c)
    for (std::size_t v = 0; v < expected[c].size(); ++v) ASSERT_EQ(copies[c][v].log_odds, expected[c][v].log_odds) << c;
}

TEST(VoxelBricks, AVoxelIsWhatItsLogOddsSay) {
  VoxelBricks bricks({9, 9, 9});
  const std::size_t place = bricks.place(8, 8, 8), i = place % VoxelBricks::brick_voxels;
  VoxelBricks::Brick& brick = bricks.change_brick_of(place);
  brick.set_occlusion_distance(i, 65535);
  const Voxel behind = bricks.at(8, 8, 8);
  EXPECT_EQ(std::tuple(behind.measured, behind.occlusion_distance, behind.log_odds, behind.probability, behind.entropy),
            std::tuple(false, 65535, 0.0f, Voxel().probability, Voxel().entropy));
  std::mt19937 random(2);
  std::uniform_real_distribution<float> any(-14.0f, 14.0f);
  for (int n = 0; n < 5000; ++n) {  // many more than are remembered
    const float log_odds = n == 0 ? 0.0f : any(random);
    brick.set_measured(i, log_odds, VoxelClass::free);
    const Voxel voxel = bricks.at(8, 8, 8);
    const double p = probability(log_odds);
    ASSERT_EQ(voxel.probability, float(p));
    ASSERT_EQ(voxel.entropy, float(entropy(p)));
    ASSERT_EQ(brick.entropy(i), voxel.entropy);
    ASSERT_EQ(std::tuple(voxel.measured, voxel.occlusion_distance, voxel.log_odds, voxel.voxel_class),
              std::tuple(true, 0, log_odds, VoxelClass::free));
  }
}

TEST(VoxelBricks, VoxelsThatAreToldStayAsTheyAre) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(0.0f, 1.0f);
  const Eigen::Vector3i size(9, 10, 11);
  std::vector<Voxel> voxels(std::size_t(size.prod()));
  for (Voxel& v : voxels) {
    v = {any(random), any(random), static_cast<VoxelClass>(random() % 3), random() % 2 == 0, 0, 0.0f};
    if (v.measured)
      v.log_odds = any(random);
    else
      v.occlusion_distance = static_cast<std::uint16_t>(random());
  }
  const VoxelBricks bricks(size, voxels);
  const auto all = [](const Voxel& v) {
    return std::tuple(v.probability, v.entropy, v.voxel_class, v.measured, v.occlusion_distance, v.log_odds);
  };
  for (std::size_t i = 0; i < voxels.size(); ++i) ASSERT_EQ(all(bricks[i]), all(voxels[i]));
  EXPECT_TRUE(std::ranges::equal(bricks.dense(), voxels, {}, all, all));
}

TEST(VoxelBricks, OnlyWhatChangesTakesMemory) {
  constexpr std::size_t brick = VoxelBricks::brick_voxels * 5 + 24;
  VoxelBricks bricks({128, 128, 128});
  EXPECT_EQ(bricks.bytes(), 0u);
  number(bricks, 5, 5, 5, 1);
  number(bricks, 7, 0, 7, 2);
  EXPECT_EQ(bricks.bytes(), brick) << "both are of one brick";
  VoxelBricks fork = bricks;
  EXPECT_EQ(fork.bytes_beside(bricks), 0u);
  number(fork, 100, 100, 100, 3);
  EXPECT_EQ(fork.bytes(), 2 * brick);
  EXPECT_LE(fork.bytes_beside(bricks), brick + (std::size_t{64} << 10)) << "and at most 64 KiB to find the bricks";
  EXPECT_LE(sizeof(VoxelBricks), 64u);
}

/// Of the bricks that `of` has and `other` has not, wherever.
std::size_t bytes_of_bricks(const VoxelBricks& of, const VoxelBricks& other) {
  std::set<const VoxelBricks::Brick*> counted;
  for (const auto& brick : other.bricks()) counted.insert(&*brick);
  std::size_t bytes = 0;
  for (const auto& brick : of.bricks())
    if (counted.insert(&*brick).second) bytes += brick->bytes();
  return bytes;
}

TEST(VoxelBricks, OfSeveralMapsEachBrickCountsOnce) {
  std::mt19937 random(12);
  OccupancyMap map(region_of_interest(Vector3::Zero(), 0.64, 0.01));
  const VoxelBricks nothing = map.voxels();
  std::vector<VoxelBricks> maps = {nothing};
  for (const Vector3& origin : random_scans::origins()) {
    Scan scan = random_scans::scan(random, origin, 0.01, 400);
    random_scans::add_passes(scan, random, 4000);  // free space whose bricks are shared
    map.insert(scan);
    maps.push_back(map.voxels());
  }
  const std::size_t table = nothing.brick_count() * sizeof(void*);
  for (const VoxelBricks& a : maps) {
    EXPECT_EQ(a.bytes(), bytes_of_bricks(a, nothing));
    for (const VoxelBricks& b : maps) EXPECT_EQ(a.bytes_beside(b), &a == &b ? 0 : table + bytes_of_bricks(a, b));
  }
}

TEST(VoxelBricks, ForksOfOneMapGrowInSeveralThreads) {
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 0.64, 0.01);
  Scan scan;
  scan.origin = Vector3(0.9, 0.1, 0.2);
  for (int i = 0; i < 2000; ++i) scan.hits.push_back({0.01f * float(i % 20), 0.005f * float(i % 40), -0.1f});
  OccupancyMap root(grid);
  root.insert(scan);
  std::vector<OccupancyMap> forks(4, root);
  std::vector<std::thread> threads;
  for (std::size_t f = 0; f < forks.size(); ++f)
    threads.emplace_back([&, f] {
      for (int i = 0; i < 3; ++i) {
        OccupancyMap deeper = forks[f];
        Scan other = scan;
        other.origin.y() += 0.1 * double(f);
        deeper.insert(other);
        forks[f] = deeper;
      }
    });
  for (std::thread& thread : threads) thread.join();
  OccupancyMap alone(grid);
  alone.insert(scan);
  EXPECT_TRUE(std::ranges::equal(alone.voxels(), root.voxels(), {}, &Voxel::log_odds, &Voxel::log_odds));
  for (int i = 0; i < 3; ++i) alone.insert(scan);
  EXPECT_TRUE(std::ranges::equal(alone.voxels(), forks[0].voxels(), {}, &Voxel::log_odds, &Voxel::log_odds));
}

}  // namespace
}  // namespace nextview
