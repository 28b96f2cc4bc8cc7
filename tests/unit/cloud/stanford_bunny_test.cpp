#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <sstream>

#include "core/cloud/point_cloud.hpp"
#include "core/cloud/range_scan_folder.hpp"
#include "core/evaluation/mesh_distance.hpp"
#include "core/file/gzip_file.hpp"
#include "core/mesh/mesh_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

/// Real range scans, ten of the Stanford bunny, where they are at hand: their licence keeps them out of this
/// repository. MadeRangeScans proves the reader without them.
class StanfordBunny : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder / "bun.conf"))
      GTEST_SKIP() << "an addition: " << folder << " is not there, so scans like it were read, but no real ones";
    scene = read_range_scan_folder(folder);
  }
  const std::filesystem::path folder = std::filesystem::path(NEXTVIEW_SHARED_DIR) / "data/scans/stanford_bunny";
  RecordedScene scene;
};

/// `poses.txt` holds, beside each scan's name, the matrix that takes it to the common frame, from another program.
TEST_F(StanfordBunny, EveryPointIsWhereThePosesPutIt) {
  std::ifstream poses(folder / "poses.txt");
  std::size_t scan = 0;
  double worst = 0.0;
  for (std::string line; std::getline(poses, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    std::string name;
    Eigen::Matrix4d T_world_scan;
    words >> name;
    for (int i = 0; i < 16; ++i) words >> T_world_scan(i / 4, i % 4);
    ASSERT_TRUE(words) << line;
    const PointCloud points = read_ply(folder / (name + ".gz"));
    const RecordedScan& read = scene.scans.at(scan++);
    ASSERT_EQ(read.points.size(), points.size()) << name;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3 expected = (T_world_scan * points[i].cast<double>().homogeneous()).head<3>();
      worst = std::max(worst, (read.T_world_camera * read.points[i] - expected).norm());
    }
  }
  EXPECT_EQ(scan, 10u);
  EXPECT_EQ(scene.scans.size(), scan);
  EXPECT_LT(worst, 1e-8) << "[m]; the matrices have nine digits";
}

TEST_F(StanfordBunny, CamerasStandOffAndSeeTheScanBeforeThem) {
  for (const RecordedScan& scan : scene.scans) {
    double nearest = 1e9, farthest = 0.0;
    for (const Vector3& p : scan.points) {
      nearest = std::min(nearest, p.z());
      farthest = std::max(farthest, p.norm());
    }
    EXPECT_NEAR(nearest, default_stand_off, 1e-9);
    EXPECT_LE(1.01 * farthest, scene.parameters.at("max_sensor_range_m") + 1e-12);
  }
}

/// The mesh that the repository's authors made of these scans. A few points of the scanner are strays; one of
/// ear_back.ply lies 79 mm off.
TEST_F(StanfordBunny, TheScansLieOnTheMeshThatWasMadeOfThem) {
  const TemporaryFolder temporary;
  const auto file = temporary.write("bunny.ply", read_gzip_file(folder / "bun_zipper.ply.gz"));
  const PlacedMesh placed = load_placed_mesh(file, {.longest_side = 0.0});
  const MeshDistance distance_to_mesh(placed.mesh);
  double sum = 0.0;
  std::size_t count = 0, strays = 0;
  for (const RecordedScan& scan : scene.scans)
    for (const Vector3& p : scan.points) {
      const double distance = distance_to_mesh(placed.placement(scan.T_world_camera * p).cast<float>());
      sum += distance;
      strays += distance > 0.002;
      ++count;
    }
  const double mean = sum / static_cast<double>(count);
  std::cout << count << " points, " << 1e3 * mean << " mm from the mesh in the mean, " << strays << " over 2 mm\n";
  EXPECT_EQ(count, 362272u);
  EXPECT_LT(mean, 0.0002);
  EXPECT_LE(strays, 5u);
}

}  // namespace
}  // namespace nextview
