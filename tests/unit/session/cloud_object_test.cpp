// Objects that are clouds, and candidates that are projection matrices, as in DTU's set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/file/read_file.hpp"
#include "core/session/object_mesh.hpp"
#include "core/session/session_parts.hpp"
#include "tests/unit/file/gzip.hpp"
#include "tests/unit/session/made_projections.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

using made_projections::cameras;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

class CloudObject : public ::testing::Test {
 protected:
  CloudObject() {
    fs::create_directories(folder_);
    made_projections::write_cloud(cloud_, 20'000, 0.1);
    made_projections::write_cameras(views_);
  }
  ~CloudObject() override { fs::remove_all(folder_); }

  Configuration configuration() const {
    Configuration c = small_scan();
    c.object.file = cloud_.string();
    c.map.resolution = Configuration().map.resolution;  // which follows from the object, as does d_reg
    c.evaluation.d_reg = Configuration().evaluation.d_reg;
    c.views.layout = ViewLayout::file;
    c.views.file = views_.string();
    return c;
  }
  std::string why(const std::string& text) const {
    std::ofstream(folder_ / "bad.ply") << text;
    try {
      load_object_mesh(folder_ / "bad.ply");
      return "";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return error.what();
    }
  }
  const fs::path folder_ = fs::temp_directory_path() / fmt::format("nextview_cloud_object_{}", ::getpid());
  const fs::path cloud_ = folder_ / "stl006_total.ply", views_ = folder_ / "calibration";
};

/// Each looks at the middle of the object as it did in the file, from as far off but for the factor [m per mm].
void expect_placed(const std::vector<Pose>& candidates, const MeshPlacement& placement) {
  ASSERT_EQ(candidates.size(), std::size_t(cameras));
  for (int i = 0; i < cameras; ++i) {
    const Pose made = made_projections::camera(i);
    const Vector3 expected = placement(made.translation());
    EXPECT_LT((candidates[i].translation() - expected).norm(), 1e-6 * expected.norm()) << i;
    const Vector3 ahead = placement(made * Vector3::UnitZ()), right = placement(made * Vector3::UnitX());
    EXPECT_LT((candidates[i].linear().col(2) - (ahead - expected).normalized()).norm(), 1e-6) << i;
    EXPECT_LT((candidates[i].linear().col(0) - (right - expected).normalized()).norm(), 1e-6) << i;
  }
}

TEST_F(CloudObject, IsScannedFromItsOwnCameras) {
  Session session(configuration());
  const PlacedMesh& object = session.object();
  EXPECT_EQ(object.unit, LengthUnit::millimetres);
  EXPECT_EQ(object.cloud_points, 20'000u);
  EXPECT_NEAR(session.mesh()->bounding_box().sizes().maxCoeff(), 0.120, 0.0015) << "its true size";
  EXPECT_LT((object.placement.centre - made_projections::middle).norm(), 1.0);
  double error = 0.0;  // [m]
  for (const auto& v : session.mesh()->vertices)
    error += std::abs((v.cast<double>() - object.placement(made_projections::middle)).norm() - 0.060);
  EXPECT_LT(error / double(session.mesh()->vertices.size()), 0.0003);
  expect_placed(session.candidates(), object.placement);
  EXPECT_THAT(
      session.notes(),
      ElementsAre(HasSubstr("the object is a cloud of 20000 points: the program's own surface of it is scanned"),
                  HasSubstr("1 file without a projection matrix passed over: readme.txt")));
  finish(session);
  EXPECT_GT(session.records().back().coverage_visible, 0.5);
  EXPECT_GT(session.records().back().coverage, 0.5);
}

TEST_F(CloudObject, ViewsFollowWhatIsDoneToTheObject) {
  Configuration scaled = configuration(), in_place = configuration(), in_metres = configuration();
  Configuration turned = configuration();
  turned.object.up = UpAxis::minus_y;
  scaled.object.longest_side = 0.5;
  in_place.object.centred = false;
  in_place.map.region_edge = 2.0;
  in_place.map.resolution = 0.02;
  in_metres.object.unit = LengthUnit::centimetres;
  in_metres.views.unit = LengthUnit::millimetres;
  for (Configuration* c : {&scaled, &in_place, &in_metres, &turned}) c->evaluation.enabled = false;
  const Session big(scaled), there(in_place), other(in_metres), up(turned);
  EXPECT_NEAR(big.mesh()->bounding_box().sizes().maxCoeff(), 0.5, 1e-6);
  expect_placed(big.candidates(), big.object().placement);
  expect_placed(there.candidates(), {Vector3::Zero(), 0.001});
  expect_placed(up.candidates(), up.object().placement);
  EXPECT_EQ(up.object().placement.up, UpAxis::minus_y);
  const Vector3 centre = other.object().placement.centre;  // [cm]
  EXPECT_NEAR(
      (other.candidates()[0].translation() - 0.01 * (0.1 * made_projections::camera(0).translation() - centre)).norm(),
      0.0, 1e-6);
  scaled.views.unit = LengthUnit::millimetres;
  EXPECT_THROW(Session{scaled}, std::invalid_argument) << "of an object in who knows what";
  scaled.object.unit = LengthUnit::millimetres;
  const Session said(scaled);
  expect_placed(said.candidates(), said.object().placement);
}

TEST_F(CloudObject, PcdIsReadToo) {
  const PlacedMesh ply = load_object_mesh(cloud_);
  std::ifstream in(cloud_);
  std::string line, data;
  while (std::getline(in, line) && line != "end_header") continue;
  while (std::getline(in, line)) data += line.substr(0, line.find(' ', line.find(' ', line.find(' ') + 1) + 1)) + "\n";
  std::ofstream(folder_ / "a.pcd") << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 20000\n"
                                      "HEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 20000\nDATA ascii\n"
                                   << data;
  const PlacedMesh pcd = load_object_mesh(folder_ / "a.pcd");
  EXPECT_EQ(pcd.mesh.vertices, ply.mesh.vertices);
  EXPECT_EQ(pcd.cloud_points, 20'000u);
}

TEST_F(CloudObject, PointsThatAreNotFiniteAreLeftOutAndCounted) {
  const std::string whole = read_file(cloud_);
  std::ofstream holed(folder_ / "holed.ply");
  const std::size_t count = whole.find("20000"), end = whole.find("end_header\n") + 11;
  const std::string first = whole.substr(end, whole.find('\n', end) + 1 - end);
  const std::string hole = "nan" + first.substr(first.find(' '));
  holed << whole.substr(0, count) << "20002" << whole.substr(count + 5, end - count - 5) << hole << hole
        << whole.substr(end) << std::flush;
  const PlacedMesh object = load_object_mesh(folder_ / "holed.ply");
  EXPECT_EQ(object.mesh.vertices, load_object_mesh(cloud_).mesh.vertices);
  EXPECT_THAT(cloud_note(object), HasSubstr("a cloud of 20000 points (2 that are not finite left out): "));
}

TEST_F(CloudObject, ACompressedMeshIsNone) {
  constexpr const char* objects = NEXTVIEW_SOURCE_DIR "/assets/objects/";
  const fs::path plain = fs::path(objects) / "slotted_plate.ply", packed = folder_ / "plate.ply.gz";
  write_gzip(packed, read_file(plain));
  EXPECT_FALSE(is_cloud(packed));
  const PlacedMesh mesh = load_object_mesh(packed);
  EXPECT_EQ(mesh.cloud_points, 0u);
  EXPECT_EQ(mesh.mesh.vertices, load_object_mesh(plain).mesh.vertices);
  write_gzip(folder_ / "cloud.ply.gz", read_file(cloud_));
  EXPECT_TRUE(is_cloud(folder_ / "cloud.ply.gz"));
  write_gzip(packed, "ply\nformat ascii 1.0\n");
  try {
    load_object_mesh(packed);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(packed.string()));
  }
}

TEST_F(CloudObject, WhatCannotBeScannedIsOneLine) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_THAT(why(head + "end_header\n0 0 0\n1 0 0\n0 1 0\n"),
              HasSubstr("bad.ply: is a cloud of 3 points, and no surface can be made of it: 3 points are too few"));
  EXPECT_THAT(why(head + "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"),
              HasSubstr("is a cloud of 3 points"));
  EXPECT_THAT(why(head + "end_header\n0 0 0\n"), HasSubstr("bad.ply: "));
  EXPECT_THAT(why(head + "end_header\n0 0 nan\n1 0 0\n0 1 0\n"), HasSubstr("2 points are too few"));
  EXPECT_THAT(why(head + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 nan\n1 0 0\n0 1 0\n"
                         "3 0 1 2\n"),
              HasSubstr("bad.ply: "))
      << "a mesh is refused";
  std::string far =
      "ply\nformat ascii 1.0\nelement vertex 100\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (int i = 0; i < 100; ++i) far += fmt::format("{} {} {}\n", i * 7919 % 101, i * 104729 % 103, i * 1299709 % 107);
  EXPECT_THAT(why(far), HasSubstr("no surface can be made of it: the points lie too far apart"));
  EXPECT_EQ(load_object_mesh(small_scan().object.file).cloud_points, 0u) << "a mesh stays a mesh";
}

}  // namespace
}  // namespace nextview
