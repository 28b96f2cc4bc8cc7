#include <octomap/OcTree.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "core/file/atomic_file.hpp"
#include "core/map/octree_file.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

class HostileOctreeFile : public InTemporaryFolder {
 protected:
  /// Why the bytes are refused: one line that names the file. Empty if they are read.
  std::string reason(const std::string& bytes, const char* name) const {
    write_file(folder_ / name, bytes);
    return reason(folder_ / name);
  }
  std::string reason(const fs::path& file) const {
    try {
      read_octree(file);
      return "";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return error.what();
    }
  }
  std::string good_file(const char* name) const {
    std::mt19937 random(1);
    OccupancyMap map(region_of_interest(Vector3::Zero(), 0.4, 0.05), {});
    map.insert(random_scans::scan(random, Vector3(0.3, 0.1, 0.2), 0.05, 60));
    write_octree(map, folder_ / name);
    return read_file(folder_ / name);
  }
};

constexpr const char* names[] = {"map.ot", "map.bt"};

TEST_F(HostileOctreeFile, MissingEmptyAndFolders) {
  for (const char* name : names) {
    EXPECT_NE(reason(folder_ / "nowhere" / name), "");
    EXPECT_NE(reason("", name), "");
  }
  fs::create_directories(folder_ / "folder.ot");
  EXPECT_NE(reason(folder_ / "folder.ot"), "");
}

// The first line tells what a file holds, not its name.
TEST_F(HostileOctreeFile, OneKindUnderTheNameOfTheOther) {
  for (const char* name : names) {
    good_file(name);
    const OccupancyMap expected = read_octree(folder_ / name);
    fs::rename(folder_ / name, folder_ / "map.other");
    const OccupancyMap map = read_octree(folder_ / "map.other");
    EXPECT_TRUE(std::ranges::equal(map.voxels(), expected.voxels(), {}, &Voxel::log_odds, &Voxel::log_odds));
  }
}

TEST_F(HostileOctreeFile, TruncatedAtEveryLength) {
  for (const char* name : names) {
    const std::string good = good_file(name);
    ASSERT_GT(good.size(), 300u);
    for (std::size_t length = 0; length < good.size(); ++length)
      ASSERT_NE(reason(good.substr(0, length), name), "") << name << " cut to " << length << " of " << good.size();
    EXPECT_EQ(reason(good, name), "");
  }
}

TEST_F(HostileOctreeFile, MoreBytesThanTheTree) {
  for (const char* name : names) EXPECT_NE(reason(good_file(name) + std::string(50, 'x'), name), "") << name;
}

TEST_F(HostileOctreeFile, FlippedBytesAreReadOrRefused) {
  std::mt19937 random(2);
  std::size_t refused = 0;
  for (const char* name : names) {
    const std::string good = good_file(name);
    for (int n = 0; n < 700; ++n) {
      std::string bad = good;
      for (unsigned k = 0; k <= random() % 3; ++k) {
        const std::size_t at = n % 2 ? random() % 150 : random() % bad.size();  // the head, or anywhere
        bad[at] = char(random());
      }
      refused += !reason(bad, name).empty();
    }
  }
  EXPECT_GT(refused, 300u);
}

TEST_F(HostileOctreeFile, Noise) {
  std::mt19937 random(3);
  for (const char* name : names) {
    const std::string head = good_file(name).substr(0, 100);
    for (int n = 0; n < 200; ++n) {
      std::string noise(random() % 500, ' ');
      for (char& c : noise) c = char(random());
      EXPECT_NE(reason(noise, name), "");
      EXPECT_NE(reason(head + noise, name), "");
    }
  }
}

/// The file with its value of a head's line replaced.
std::string with(std::string file, const std::string& key, const std::string& value) {
  const std::size_t at = file.find("\n" + key + " ") + 1 + key.size() + 1;
  return file.replace(at, file.find('\n', at) - at, value);
}

TEST_F(HostileOctreeFile, ClaimsOfTheHead) {
  for (const char* name : names) {
    const std::string good = good_file(name);
    EXPECT_NE(reason(with(good, "id", "CountingOcTree"), name), "") << name;
    EXPECT_NE(reason(with(good, "id", ""), name), "") << name;
    for (const char* res : {"0", "-0.05", "nan", "inf", "1e-320", "1e300", "x", "", "0.05x"})
      EXPECT_NE(reason(with(good, "res", res), name), "") << name << " res " << res;
    for (const char* size :
         {"0", "1", "-1", "18446744073709551615", "999999999999999999999999", "1000000000000", "x", ""})
      EXPECT_NE(reason(with(good, "size", size), name), "") << name << " size " << size;
  }
}

/// OctoMap's reader takes the word `data` anywhere for the end of the head, so a check of what follows the line `data`
/// is not a check of what it reads: children without end.
TEST_F(HostileOctreeFile, TheWordDataBehindAnotherValue) {
  std::string endless;
  for (int n = 0; n < 50; ++n) endless += std::string("\0\0\0\0\xff", 5);
  for (const char* head : {"id OcTree\nsize 1\nres 0.05 data\n", "id OcTree\nres 0.05\nsize 1 data\n",
                           "size 1\nres 0.05\nid OcTree data\n", "id OcTree\nsize 1\nres 0.05\n data\n"})
    EXPECT_NE(
        reason(std::string("# Octomap OcTree file\n") + head + endless + "\ndata\n" + std::string("\0\0\x80\x3f\0", 5),
               "map.ot"),
        "");
}

TEST_F(HostileOctreeFile, DeeperThanATree) {
  const std::string full_head = "# Octomap OcTree file\nid OcTree\nsize 18\nres 0.05\ndata\n";
  const std::string binary_head = "# Octomap OcTree binary file\nid OcTree\nsize 18\nres 0.05\ndata\n";
  std::string full, binary;
  for (int depth = 0; depth < 17; ++depth) full += std::string("\0\0\x80\x3f\1", 5);
  for (int depth = 0; depth < 16; ++depth) binary += std::string("\3\0", 2);
  EXPECT_NE(reason(full_head + full + std::string("\0\0\x80\x3f\0", 5), "map.ot"), "");
  EXPECT_NE(reason(binary_head + binary + std::string("\1\0", 2), "map.bt"), "");
}

// Few bytes, many voxels: two far apart leaves, and one leaf that is the whole tree.
TEST_F(HostileOctreeFile, TooLargeToHoldDensely) {
  octomap::OcTree apart(0.01);
  apart.setNodeValue(octomap::OcTreeKey(1, 1, 1), 1.0f);
  apart.setNodeValue(octomap::OcTreeKey(65000, 65000, 65000), 1.0f);
  apart.updateInnerOccupancy();
  ASSERT_TRUE(apart.write((folder_ / "map.ot").string()));
  ASSERT_TRUE(apart.writeBinary((folder_ / "map.bt").string()));
  for (const char* name : names) EXPECT_NE(reason(folder_ / name), "") << name;
  const std::string head = "# Octomap OcTree file\nid OcTree\nsize 1\nres 0.05\ndata\n";
  EXPECT_NE(reason(head + std::string("\0\0\x80\x3f\0", 5), "map.ot"), "");
}

// Log-odds that are no number must not enter a map.
TEST_F(HostileOctreeFile, ValuesThatAreNoNumber) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::string file = good_file("map.ot");  // ends in a leaf: its log-odds, and no children
    std::memcpy(file.data() + file.size() - 5, &bad, sizeof bad);
    EXPECT_NE(reason(file, "map.ot"), "") << bad;
  }
}

}  // namespace
}  // namespace nextview
