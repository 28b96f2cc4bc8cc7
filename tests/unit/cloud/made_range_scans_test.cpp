// Range scans as a real scanner's repository has them, of a thing whose surface is known exactly.
#include "tests/unit/cloud/made_range_scans.hpp"

#include <gtest/gtest.h>

#include "core/cloud/point_cloud.hpp"
#include "core/cloud/range_scan_folder.hpp"
#include "tests/unit/file/gzip.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using made_range_scans::scans;

constexpr double six_digits = 1e-6;  ///< what the text of the scans keeps [m]

class MadeRangeScans : public testing::TestWithParam<bool> {
 protected:
  MadeRangeScans() {
    if (GetParam())
      made_range_scans::write(folder / "", [](const auto& file, const std::string& bytes) { write_gzip(file, bytes); });
    else
      made_range_scans::write(folder / "");
    scene = read_range_scan_folder(folder / "");
  }
  TemporaryFolder folder;
  RecordedScene scene;
};

TEST_P(MadeRangeScans, EveryPointIsWhereThePosesPutIt) {
  ASSERT_EQ(scene.scans.size(), scans.size());
  for (std::size_t s = 0; s < scans.size(); ++s) {
    const auto points = made_range_scans::range_image(scans[s]).points;
    const RecordedScan& read = scene.scans[s];
    ASSERT_GT(points.size(), 1000u) << scans[s].name;
    ASSERT_EQ(read.points.size(), points.size()) << scans[s].name;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector3 world = read.T_world_camera * read.points[i];
      const Vector3 expected = scans[s].turn().transpose() * points[i] + scans[s].shift;
      ASSERT_LT((world - expected).norm(), six_digits) << scans[s].name << ", point " << i;
    }
  }
}

TEST_P(MadeRangeScans, AllScansLieOnTheThing) {
  std::size_t count = 0;
  for (const RecordedScan& scan : scene.scans)
    for (const Vector3& p : scan.points) {
      ASSERT_LT(made_range_scans::distance_to_thing(scan.T_world_camera * p), six_digits);
      ++count;
    }
  EXPECT_GT(count, 8000u);
}

TEST_P(MadeRangeScans, CamerasStandOffAndSeeTheScanBeforeThem) {
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

INSTANTIATE_TEST_SUITE_P(Files, MadeRangeScans, testing::Bool(),
                         [](const auto& compressed) { return compressed.param ? "Compressed" : "Plain"; });

}  // namespace
}  // namespace nextview
