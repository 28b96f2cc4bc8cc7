#include "core/map/octree_file.hpp"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <memory>

#include "core/file/atomic_file.hpp"
#include "core/file/gzip_file.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/map/octomap_twin.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using octomap::OcTree;

using OctreeFile = InTemporaryFolder;

/// Scans whose rays stay in the region, so that the tree and the map hold the same voxels; enough to prune.
struct MapAndTree {
  explicit MapAndTree(double resolution)
      : map(region_of_interest(Vector3(0.1, 0, -0.05), 0.64, resolution), {}),
        tree(octomap_twin::tree(resolution, {})) {
    std::mt19937 random(23);
    for (const Vector3& origin : {Vector3(0.3, 0.1, 0.1), Vector3(-0.1, -0.2, -0.2), Vector3(0.3, 0.1, 0.1)}) {
      Scan scan{origin, {}, {}, 1.5};
      for (int n = 0; n < 4000; ++n) scan.hits.push_back((0.15 * random_scans::direction(random)).cast<float>());
      map.insert(scan);
      octomap_twin::insert(tree, scan);
    }
    tree.prune();
  }
  OccupancyMap map;
  OcTree tree;
};

std::unique_ptr<OcTree> read_by_octomap(const fs::path& file) {
  if (file.extension() == ".bt") {
    auto tree = std::make_unique<OcTree>(0.1);
    tree->setClampingThresMin(0.12);
    tree->setClampingThresMax(0.97);
    return tree->readBinary(file.string()) ? std::move(tree) : nullptr;
  }
  return std::unique_ptr<OcTree>(dynamic_cast<OcTree*>(octomap::AbstractOcTree::read(file.string())));
}

void expect_same_leaves(const OcTree& a, const OcTree& b) {
  ASSERT_EQ(a.getResolution(), b.getResolution());
  ASSERT_EQ(a.size(), b.size());  // inner nodes too: both are pruned
  auto leaf = b.begin_leafs();
  for (auto l = a.begin_leafs(); l != a.end_leafs(); ++l, ++leaf) {
    ASSERT_TRUE(leaf != b.end_leafs());
    ASSERT_EQ(l.getKey(), leaf.getKey());
    ASSERT_EQ(l.getDepth(), leaf.getDepth());
    ASSERT_EQ(l->getLogOdds(), leaf->getLogOdds());
  }
  ASSERT_TRUE(leaf == b.end_leafs());
}

TEST_F(OctreeFile, OctoMapReadsTheTreeThatItWouldHaveBuilt) {
  for (const double resolution : {0.01, 0.02}) {
    MapAndTree both(resolution);
    write_octree(both.map, folder_ / "map.ot");
    const auto full = read_by_octomap(folder_ / "map.ot");
    ASSERT_TRUE(full);
    expect_same_leaves(*full, both.tree);
    EXPECT_TRUE(*full == both.tree);  // inner nodes' values as well

    write_octree(both.map, folder_ / "map.bt");
    const auto binary = read_by_octomap(folder_ / "map.bt");
    ASSERT_TRUE(binary);
    ASSERT_TRUE(both.tree.writeBinary((folder_ / "twin.bt").string()));  // makes the tree maximum-likelihood
    expect_same_leaves(*binary, *read_by_octomap(folder_ / "twin.bt"));
    EXPECT_EQ(read_file(folder_ / "map.bt"), read_file(folder_ / "twin.bt"));
  }
}

/// Trees of RGB-D mapping have colours: the map is that of the tree without.
TEST_F(OctreeFile, ColouredTreesAreReadWithoutTheirColours) {
  octomap::ColorOcTree coloured(0.05);
  OcTree plain(0.05);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> at(-0.4f, 0.4f);
  for (int i = 0; i < 4000; ++i) {
    const octomap::point3d point(at(random), at(random), at(random));
    const bool occupied = random() % 3 != 0;
    coloured.updateNode(point, occupied);
    plain.updateNode(point, occupied);
    coloured.integrateNodeColor(point.x(), point.y(), point.z(), std::uint8_t(random()), std::uint8_t(random()), 7);
  }
  for (const char* name : {"map.ot", "map.bt"}) {
    const fs::path file = folder_ / name, twin = folder_ / (std::string("twin_") + name);
    const bool binary = file.extension() == ".bt";
    ASSERT_TRUE(binary ? coloured.writeBinary(file.string()) : coloured.write(file.string()));
    ASSERT_TRUE(binary ? plain.writeBinary(twin.string()) : plain.write(twin.string()));
    const OccupancyMap read = read_octree(file), expected = read_octree(twin);
    ASSERT_EQ(read.grid().size, expected.grid().size);
    EXPECT_TRUE(std::ranges::equal(read.voxels(), expected.voxels(), {}, &Voxel::log_odds, &Voxel::log_odds)) << name;
    EXPECT_GT(std::ranges::count_if(read.voxels(), &Voxel::measured), 1000) << name;
    const std::string bytes = read_file(file);
    for (std::size_t cut = 1; cut < 40; ++cut) {
      write_file(file, bytes.substr(0, bytes.size() - cut));
      EXPECT_THROW(read_octree(file), std::runtime_error) << name << ", " << cut << " bytes less";
    }
  }
}

TEST_F(OctreeFile, FullRoundTripKeepsEveryVoxel) {
  const MapAndTree both(0.01);
  write_octree(both.map, folder_ / "map.ot");
  const OccupancyMap read = read_octree(folder_ / "map.ot");
  ASSERT_EQ(read.grid().resolution, both.map.grid().resolution);
  const Eigen::Vector3i offset = read.grid().first - both.map.grid().first;
  std::size_t measured = 0, measured_read = 0;
  for (std::uint32_t i = 0; i < both.map.grid().voxel_count(); ++i) {
    const Voxel& v = both.map.voxels()[i];
    const Eigen::Vector3i cell = both.map.grid().cell(i) - offset;
    measured += v.measured;
    if (!read.grid().contains(cell)) {
      ASSERT_FALSE(v.measured);
      continue;
    }
    const std::uint32_t k = read.grid().index(cell);
    ASSERT_EQ(read.voxels()[k].measured, v.measured);
    ASSERT_EQ(read.log_odds(k), both.map.log_odds(i));
    ASSERT_EQ(read.voxels()[k].voxel_class, v.voxel_class);
  }
  for (const Voxel& v : read.voxels()) measured_read += v.measured;
  EXPECT_EQ(measured, measured_read);
  write_octree(read, folder_ / "again.ot");
  EXPECT_EQ(read_file(folder_ / "again.ot"), read_file(folder_ / "map.ot"));
}

// "The smallest box": a measured voxel lies on each of its six sides.
TEST_F(OctreeFile, TheGridIsTheSmallestBox) {
  const MapAndTree both(0.02);
  write_octree(both.map, folder_ / "map.ot");
  const OccupancyMap read = read_octree(folder_ / "map.ot");
  Eigen::AlignedBox3i box;
  for (std::uint32_t i = 0; i < read.grid().voxel_count(); ++i)
    if (read.voxels()[i].measured) box.extend(read.grid().cell(i));
  EXPECT_EQ(box.min(), Eigen::Vector3i::Zero());
  EXPECT_EQ(box.max(), read.grid().size - Eigen::Vector3i::Ones());
}

TEST_F(OctreeFile, BinaryFilesKeepWhichVoxelsAreOccupied) {
  const MapAndTree both(0.02);
  write_octree(both.map, folder_ / "map.bt");
  const OccupancyMap read = read_octree(folder_ / "map.bt");
  const Eigen::Vector3i offset = read.grid().first - both.map.grid().first;
  std::array<int, 2> compared = {};  // free and occupied ones
  for (std::uint32_t i = 0; i < both.map.grid().voxel_count(); ++i) {
    const Voxel& v = both.map.voxels()[i];
    if (!v.measured) continue;
    const Voxel& r = read.voxels()[read.grid().index(both.map.grid().cell(i) - offset)];
    ASSERT_TRUE(r.measured);
    ASSERT_NEAR(r.probability, v.probability >= 0.5f ? 0.97 : 0.12, 1e-6);
    ++compared[v.probability >= 0.5f];
  }
  EXPECT_GT(compared[0], 100);
  EXPECT_GT(compared[1], 100);
}

TEST_F(OctreeFile, LargeLeavesAreFilled) {
  OcTree tree(0.05);  // one leaf of 4³ voxels, one of 1
  tree.setNodeValue(octomap::OcTreeKey(32768, 32768, 32768), 1.25f);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y)
      for (int z = 0; z < 4; ++z) tree.setNodeValue(octomap::OcTreeKey(32776 + x, 32768 + y, 32768 + z), -0.75f);
  tree.updateInnerOccupancy();
  tree.prune();
  ASSERT_EQ(tree.getNumLeafNodes(), 2u);
  ASSERT_TRUE(tree.write((folder_ / "tree.ot").string()));
  const OccupancyMap map = read_octree(folder_ / "tree.ot");
  EXPECT_EQ(map.grid().first, Eigen::Vector3i(0, 0, 0));
  EXPECT_EQ(map.grid().size, Eigen::Vector3i(12, 4, 4));
  for (std::uint32_t i = 0; i < map.grid().voxel_count(); ++i) {
    const float expected = i == 0 ? 1.25f : map.grid().cell(i).x() >= 8 ? -0.75f : 0.0f;
    ASSERT_EQ(map.log_odds(i), expected);
    ASSERT_EQ(map.voxels()[i].measured, expected != 0.0f);
  }
}

/// A real building; and the same as a full octree, after many random updates.
void write_building(const fs::path& folder) {
  write_file(folder / "building.bt", read_gzip_file(fs::path(NEXTVIEW_SOURCE_DIR) / "tests/data/maps/geb079.bt.gz"));
  const auto tree = read_by_octomap(folder / "building.bt");
  ASSERT_TRUE(tree);
  std::vector<octomap::OcTreeKey> keys;
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) keys.push_back(leaf.getKey());
  std::mt19937 random(5);
  for (int i = 0; i < 300'000; ++i) tree->updateNode(keys[random() % keys.size()], random() % 3 == 0);
  tree->prune();
  ASSERT_TRUE(tree->write((folder / "building.ot").string()));
}

TEST_F(OctreeFile, ARealBuildingIsReadAsOctoMapReadsIt) {
  write_building(folder_);
  for (const char* name : {"building.bt", "building.ot"}) {
    const auto tree = read_by_octomap(folder_ / name);
    ASSERT_TRUE(tree);
    EXPECT_GT(tree->getNumLeafNodes(), 400'000u);
    const OccupancyMap map = read_octree(folder_ / name);
    std::size_t volume = 0, measured = 0, different = 0;
    for (const Voxel& v : map.voxels()) measured += v.measured;
    for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) {
      const int edge = 1 << (16 - leaf.getDepth());
      volume += std::size_t(edge) * edge * edge;
      const auto key = leaf.getIndexKey();
      for (const int corner : {0, edge - 1}) {
        const Eigen::Vector3i lattice =
            Eigen::Vector3i(key[0], key[1], key[2]) + Eigen::Vector3i::Constant(corner - 32768);
        const Eigen::Vector3i cell = lattice - map.grid().first;
        different += !map.grid().contains(cell) || map.log_odds(map.grid().index(cell)) != leaf->getLogOdds();
      }
    }
    EXPECT_EQ(measured, volume) << name;
    EXPECT_EQ(different, 0u) << name;
  }
}

TEST_F(OctreeFile, WritingNamesTheFileThatCannotBeWritten) {
  const MapAndTree both(0.02);
  for (const char* name : {"no/such/folder/map.ot", "map.txt", "map"}) {
    try {
      write_octree(both.map, folder_ / name);
      ADD_FAILURE() << name;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(OctreeFile, AFullDiskLosesNothing) {
  const MapAndTree both(0.02);
  write_octree(both.map, folder_ / "map.ot");
  const std::string old = read_file(folder_ / "map.ot");
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{old.size() / 2, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write_octree(both.map, folder_ / "map.ot"), std::runtime_error);
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(read_file(folder_ / "map.ot"), old);
}

}  // namespace
}  // namespace nextview
