#include "core/cloud/range_scan_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/unit/file/gzip.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// As the repository has them: a grid of the pixels follows the vertices.
std::string ply(const std::vector<Vector3>& points) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nobj_info num_cols 2\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement range_grid 2\nproperty list uchar int vertex_indices\nend_header\n",
      points.size());
  for (const Vector3& p : points) text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  return text + "0\n1 0\n";
}

constexpr const char* quarter_turn = "0 0 0.70710678 0.70710678";  // R(q) takes x to y, so R(q)^T takes y to x
const std::vector<Vector3> upright = {{0, 0, 0}, {0.2, 0, 0.1}, {0.1, 0.3, 0.04}},
                           turned = {{0.1, 0, 0}, {0, 0.2, -0.1}};

/// Two scans, the second compressed and turned.
class RangeScanFolder : public testing::Test {
 protected:
  RangeScanFolder() {
    write_conf(
        fmt::format("camera 1 2 3  0 0 0 1\nbmesh a.ply 0 0 0 0 0 0 1\r\n\n"
                    "mesh whole.ply 0 0 0 0 0 0 1\n  bmesh\tb.ply 0.5 0 0.005 {}",
                    quarter_turn));
    folder.write("a.ply", ply(upright));
    write_gzip(folder / "b.ply.gz", ply(turned));
  }
  void write_conf(const std::string& text) const { folder.write("two.conf", text); }
  RecordedScene read(double stand_off = default_stand_off, double resolution = 0.0) const {
    return read_range_scan_folder(folder / "", stand_off, resolution);
  }
  /// The one line that reading fails with, after the folder's name.
  std::string complaint() const {
    try {
      read();
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), StartsWith((folder / "").string()));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return std::string(error.what()).substr((folder / "").string().size());
    }
    return "no complaint";
  }

  TemporaryFolder folder;
};

void expect_near(const Vector3& actual, const Vector3& expected) {
  EXPECT_LT((actual - expected).norm(), 1e-7) << actual.transpose() << " is not " << expected.transpose();
}

TEST_F(RangeScanFolder, PointsAreInTheCamerasFrame) {
  const RecordedScene scene = read(0.5);
  ASSERT_EQ(scene.scans.size(), 2u);
  const auto& a = scene.scans[0].points;  // the camera is at (0.1, 0.1, 0.6) in the scan's frame
  ASSERT_EQ(a.size(), 3u);
  expect_near(a[0], {-0.1, 0.1, 0.6});
  expect_near(a[1], {0.1, 0.1, 0.5});
  expect_near(a[2], {0.0, -0.2, 0.56});
  const auto& b = scene.scans[1].points;  // at (0.05, 0.1, 0.5)
  ASSERT_EQ(b.size(), 2u);
  expect_near(b[0], {0.05, 0.1, 0.5});
  expect_near(b[1], {-0.05, -0.1, 0.6});
}

// Two of the three folders of the repository have such: written by hand, after the declarations.
TEST_F(RangeScanFolder, HeaderLinesThatAreNotKnownAreReadOnOver) {
  const RecordedScene expected = read();
  const std::string range_grid = "element range_grid", end = "end_header\n";
  std::string a = ply(upright);
  a.insert(a.find(end), "bye\n");
  a.insert(a.find(range_grid), "comment between elements\nobj_info num_rows 3\nscanned by\x1b[31m hand\n");
  folder.write("a.ply", a);
  std::string b = ply(turned);
  b.insert(b.find(end), "bye\r\n");
  write_gzip(folder / "b.ply.gz", b);
  std::vector<std::string> notices;
  const RecordedScene scene = read_range_scan_folder(folder / "", default_stand_off, 0.0,
                                                     [&](const std::string& text) { notices.push_back(text); });
  ASSERT_EQ(scene.scans.size(), 2u);
  for (std::size_t s = 0; s < 2; ++s) EXPECT_EQ(scene.scans[s].points, expected.scans[s].points);
  ASSERT_EQ(notices.size(), 1u) << "one for the folder";
  EXPECT_EQ(notices[0],
            "2 of its scans have header lines that are not known; they are read on over: the first is "
            "'scanned by?[31m hand' in a.ply");
  EXPECT_EQ(read().scans.size(), 2u) << "also where nobody hears of them";
}

TEST_F(RangeScanFolder, OfHeaderLinesThatAreKnownNobodyHears) {
  std::vector<std::string> notices;
  const auto read_and_note = [&] {
    read_range_scan_folder(folder / "", default_stand_off, 0.0,
                           [&](const std::string& text) { notices.push_back(text); });
  };
  read_and_note();
  EXPECT_TRUE(notices.empty()) << notices.front();
  std::string a = ply(upright);
  a.insert(a.find("end_header\n"), std::string(70, 'x') + "\n");
  folder.write("a.ply", a);
  read_and_note();
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0], "1 of its scans has header lines that are not known; they are read on over: the first is '" +
                            std::string(60, 'x') + "' in a.ply");
}

TEST_F(RangeScanFolder, AUnitScalesPointsAndPlaces) {
  const RecordedScene metres = read();
  std::vector<Vector3> in_mm = upright, turned_in_mm = turned;
  for (Vector3& p : in_mm) p *= 1e3;
  for (Vector3& p : turned_in_mm) p *= 1e3;
  folder.write("a.ply", ply(in_mm));
  folder.write("b.ply", ply(turned_in_mm));
  write_conf(fmt::format("bmesh a.ply 0 0 0 0 0 0 1\nbmesh b.ply 500 0 5 {}\n", quarter_turn));
  const RecordedScene scaled = read_range_scan_folder(folder / "", default_stand_off, 0.0, {}, 1e-3);
  ASSERT_EQ(scaled.scans.size(), 2u);
  for (std::size_t s = 0; s < 2; ++s) {
    expect_near(scaled.scans[s].T_world_camera.translation(), metres.scans[s].T_world_camera.translation());
    for (std::size_t i = 0; i < metres.scans[s].points.size(); ++i)
      expect_near(scaled.scans[s].points.at(i), metres.scans[s].points[i]);
  }
}

TEST_F(RangeScanFolder, PosesPlaceCamerasAndPointsInTheWorld) {
  const RecordedScene scene = read(0.5);
  const Pose& a = scene.scans.at(0).T_world_camera;
  for (std::size_t i = 0; i < 3; ++i) expect_near(a * scene.scans[0].points[i], upright[i]);
  expect_near(a.translation(), {0.1, 0.1, 0.6});
  expect_near(a.linear().col(2), {0, 0, -1});  // looks along -z
  expect_near(a.linear().col(1), {0, -1, 0});
  // By hand: (x, y, z) goes to (y + 0.5, -x, z + 0.005).
  const Pose& b = scene.scans.at(1).T_world_camera;
  expect_near(b * scene.scans[1].points[0], {0.5, -0.1, 0.005});
  expect_near(b * scene.scans[1].points[1], {0.7, 0.0, -0.095});
  expect_near(b.translation(), {0.6, -0.05, 0.505});
  expect_near(b.linear().col(0), {0, -1, 0});
  expect_near(b.linear().col(2), {0, 0, -1});
}

TEST_F(RangeScanFolder, TheStandOffMovesTheCamerasOnly) {
  const RecordedScene near = read(0.3), far = read();
  for (std::size_t s = 0; s < 2; ++s) {
    const Pose &n = near.scans[s].T_world_camera, &f = far.scans[s].T_world_camera;
    expect_near(f.translation() - n.translation(), Vector3(0, 0, default_stand_off - 0.3));
    for (std::size_t i = 0; i < near.scans[s].points.size(); ++i)
      expect_near(n * near.scans[s].points[i], f * far.scans[s].points[i]);
  }
}

TEST_F(RangeScanFolder, TheRegionHoldsAllPointsAndAMargin) {
  const RecordedScene scene = read(0.5, 0.004);
  // The points fill (0, -0.1, -0.095) to (0.7, 0.3, 0.1): 0.07 m more on each side, then outwards to the next 4 mm. The
  // farthest point is the first of the first scan.
  const std::map<std::string, double> expected = {
      {"resolution_m", 0.004},
      {"bbox_min_x_m", -0.072},
      {"bbox_min_y_m", -0.172},
      {"bbox_min_z_m", -0.168},
      {"bbox_max_x_m", 0.772},
      {"bbox_max_y_m", 0.372},
      {"bbox_max_z_m", 0.172},
      {"max_sensor_range_m", 1.01 * std::sqrt(0.01 + 0.01 + 0.36)},
      {"max_ray_depth_m", 1.8 * 0.844 + 0.5 * std::sqrt(0.844 * 0.844 + 0.544 * 0.544 + 0.34 * 0.34)}};
  EXPECT_EQ(scene.parameters.size(), expected.size());
  for (const auto& [name, value] : expected) {
    ASSERT_TRUE(scene.parameters.contains(name)) << name;
    EXPECT_NEAR(scene.parameters.at(name), value, 1e-7) << name;
  }
}

TEST_F(RangeScanFolder, TheResolutionIsAHundredthOfTheLongestSideInOneDigit) {
  EXPECT_DOUBLE_EQ(read().parameters.at("resolution_m"), 0.007);
  write_conf("bmesh a.ply 0 0 0 0 0 0 1\n");
  for (const auto& [side, resolution] : std::vector<std::pair<double, double>>{
           {0.1, 0.001}, {0.158, 0.002}, {0.0124, 0.0001}, {1.26, 0.01}, {9.7, 0.1}, {36.0, 0.4}}) {
    folder.write("a.ply", ply({{0, 0, 0}, {0.001, side, 0}}));
    EXPECT_DOUBLE_EQ(read().parameters.at("resolution_m"), resolution) << side;
  }
}

TEST_F(RangeScanFolder, CandidateViewsFaceTheRegionFromAllAround) {
  const RecordedScene scene = read(0.5, 0.004);
  const Vector3 centre(0.35, 0.1, 0.002);
  ASSERT_EQ(scene.views.size(), 48u);
  Vector3 sum = Vector3::Zero();
  for (const Pose& view : scene.views) {
    expect_near(view * Vector3(0, 0, 1.8 * 0.844), centre);
    sum += view.translation() - centre;
  }
  EXPECT_LT(sum.norm() / 48, 0.05);
}

TEST_F(RangeScanFolder, APlainFileGoesBeforeACompressedOne) {
  folder.write("b.ply.gz", "is not looked at");
  folder.write("b.ply", ply(turned));
  EXPECT_EQ(read().scans.at(1).points.size(), 2u);
}

TEST_F(RangeScanFolder, ThereMustBeOneConf) {
  std::filesystem::create_directory(folder / "folder.conf");  // is none
  EXPECT_EQ(complaint(), "no complaint");
  folder.write("one.conf", "");
  EXPECT_THAT(complaint(), HasSubstr("has 2 .conf files, where one is expected: one.conf, two.conf"));
  std::filesystem::remove(folder / "one.conf");
  std::filesystem::remove(folder / "two.conf");
  EXPECT_THAT(complaint(), HasSubstr("holds neither a finished scan nor range scans, which a .conf file places"));
}

TEST_F(RangeScanFolder, WhatIsNoFolderSaysWhy) {
  for (const auto& [name, reason] : std::vector<std::pair<const char*, const char*>>{
           {"nowhere", "No such file or directory"}, {"a.ply", "Not a directory"}})
    EXPECT_THAT([&] { read_range_scan_folder(folder / name); },
                testing::ThrowsMessage<std::runtime_error>((folder / name).string() + ": cannot be read: " + reason));
}

TEST_F(RangeScanFolder, AWrongLineOfTheConfIsNamed) {
  for (const auto& [line, reason] : std::vector<std::pair<const char*, const char*>>{
           {"bmesh", "expected `bmesh FILE.ply tx ty tz qx qy qz qw`"},
           {"bmesh a.ply 0 0 0 0 0 0", "expected `bmesh"},
           {"bmesh a.ply 0 0 0 0 0 0 1 0", "expected `bmesh"},
           {"bmesh a.ply 0 0 x 0 0 0 1", "expected `bmesh"},
           {"bmesh a.ply 0 0 nan 0 0 0 1", "expected `bmesh"},
           {"bmesh a.ply 0 0 1e999 0 0 0 1", "expected `bmesh"},
           {"bmesh /tmp/a.ply 0 0 0 0 0 0 1", "'/tmp/a.ply' must be relative to the folder"},
           {"bmesh ../a.ply 0 0 0 0 0 0 1", "'../a.ply' must not lead out of the folder"},
           {"bmesh b/../../a.ply 0 0 0 0 0 0 1", "must not lead out of the folder"},
           {"bmesh a.ply 0 0 0 0 0 0 1e300", "has length inf; it must be 1"},
           {"bmesh a.ply 0 0 0 0 0 0.5 0.5", "has length 0.707107; it must be 1"},
           {"bmesh a.ply 0 0 0 0 0 0 0", "has length 0; it must be 1"}}) {
    write_conf(fmt::format("camera 1\n{}\n", line));
    EXPECT_THAT(complaint(), StartsWith("two.conf:2: ")) << line;
    EXPECT_THAT(complaint(), HasSubstr(reason)) << line;
  }
  write_conf("camera 0 0 0 0 0 0 1\nmesh a.ply 0 0 0 0 0 0 1\n");
  EXPECT_EQ(complaint(), "two.conf: has no line `bmesh`");
}

TEST_F(RangeScanFolder, MissingScansAreNamedTogether) {
  std::filesystem::remove(folder / "a.ply");
  std::filesystem::remove(folder / "b.ply.gz");
  EXPECT_THAT(complaint(), EndsWith(": scans are missing, plain and as .gz: a.ply, b.ply"));
  ASSERT_EQ(mkfifo((folder / "a.ply").c_str(), 0600), 0);  // nobody writes to it: reading it would not end
  folder.write("b.ply", ply(turned));
  EXPECT_THAT(complaint(), EndsWith(".gz: a.ply"));
}

TEST_F(RangeScanFolder, ScansThatCannotBeReadAreNamed) {
  std::filesystem::resize_file(folder / "b.ply.gz", std::filesystem::file_size(folder / "b.ply.gz") - 9);
  EXPECT_EQ(complaint(), "b.ply.gz: cannot be read: it is truncated");
  write_gzip(folder / "b.ply.gz", "no cloud");
  EXPECT_THAT(complaint(), StartsWith("b.ply.gz: cannot be read: it is no PLY file"));
  write_gzip(folder / "b.ply.gz", ply({}));
  EXPECT_EQ(complaint(), "b.ply.gz: holds no points");
}

TEST_F(RangeScanFolder, ExtentsThatAreHardlyInMetresAreRefused) {
  write_conf("bmesh a.ply 0 0 0 0 0 0 1\n");
  for (const double side : {0.0, 0.0099, 40.1, 1e30}) {
    folder.write("a.ply", ply({{0, 0, 0}, {0, 0, side}}));
    EXPECT_THAT(complaint(), HasSubstr("its points span")) << side;
  }
  for (const double side : {0.0101, 39.9}) {
    folder.write("a.ply", ply({{0, 0, 0}, {0, 0, side}}));
    for (const double resolution : {0.0, 0.0001, 1.0})
      EXPECT_EQ(read(default_stand_off, resolution).views.size(), 48u) << side;
  }
}

TEST_F(RangeScanFolder, StandOffAndResolutionAreChecked) {
  const double nan = std::nan("");
  for (const double stand_off : {0.0, 0.0099, -0.7, 100.1, nan}) EXPECT_THROW(read(stand_off), std::invalid_argument);
  for (const double stand_off : {0.01, 100.0}) EXPECT_NO_THROW(read(stand_off)) << stand_off;
  for (const double resolution : {-0.01, 0.00001, 1.1, nan}) EXPECT_THROW(read(0.7, resolution), std::invalid_argument);
}

}  // namespace
}  // namespace nextview
