// One thing of a session by itself: read back by other readers, and what must not be written over.
#include "core/export/single_export.hpp"

#include <gmock/gmock.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/export/frame_folder.hpp"
#include "core/export/scan_files.hpp"
#include "core/export/scan_surfaces.hpp"
#include "core/file/atomic_file.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/recording/cloud_file.hpp"
#include "core/session/session_folder.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/results/begun.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class SingleExport : public InTemporaryFolder {
 protected:
  SingleExport() : session_(small_scan()) {
    for (int view = 0; view < 3; ++view) session_.step();
  }
  std::vector<fs::path> write(ExportKind kind, const std::string& name, const SurfaceExport& surface = {}) {
    return export_file(session_, kind, folder_ / name, surface);
  }
  std::string refusal(ExportKind kind, const fs::path& file, const fs::path& session_folder = {}) const {
    try {
      require_exportable(kind, file, session_.configuration(), session_folder);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }
  PointCloud points() const {
    PointCloud all;
    for (const auto& scan : session_.scans()) all.insert(all.end(), scan->hits.begin(), scan->hits.end());
    return all;
  }

  Session session_;
};

TEST_F(SingleExport, EveryKindHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const ExportEntry& entry : export_entries()) {
    EXPECT_TRUE(names.insert(entry.name).second);
    EXPECT_EQ(&export_entry(entry.kind), &entry);
    EXPECT_EQ(&export_entry(entry.name), &entry);
  }
  try {
    export_entry("clod");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'cloud'?"));
  }
}

TEST_F(SingleExport, CloudsHaveEveryPointWhoeverReadsThem) {
  write(ExportKind::cloud, "c.ply");
  write(ExportKind::cloud, "c.pcd");
  ASSERT_GT(points().size(), 1000u);
  EXPECT_EQ(read_ply(folder_ / "c.ply"), points());
  EXPECT_EQ(read_cloud_file(folder_ / "c.pcd").points, points());
  EXPECT_FALSE(read_cloud_file(folder_ / "c.pcd").viewpoint.has_value());
}

/// By the format's description: a header in lines, then three floats a point.
TEST_F(SingleExport, ThePcdIsAsItsFormatIsDescribed) {
  write(ExportKind::cloud, "c.pcd");
  const std::string bytes = read_file(folder_ / "c.pcd");
  std::map<std::string, std::string> header;
  std::istringstream lines(bytes);
  std::size_t at = 0;
  for (std::string line; std::getline(lines, line);) {
    at += line.size() + 1;
    if (line[0] != '#') header[line.substr(0, line.find(' '))] = line.substr(line.find(' ') + 1);
    if (line.starts_with("DATA")) break;
  }
  const std::string count = std::to_string(points().size());
  const std::map<std::string, std::string> wanted = {
      {"VERSION", "0.7"}, {"FIELDS", "x y z"}, {"SIZE", "4 4 4"}, {"TYPE", "F F F"},
      {"COUNT", "1 1 1"}, {"WIDTH", count},    {"HEIGHT", "1"},   {"VIEWPOINT", "0 0 0 1 0 0 0"},
      {"POINTS", count},  {"DATA", "binary"}};
  EXPECT_EQ(header, wanted);
  ASSERT_EQ(bytes.size() - at, 12 * points().size());
  EXPECT_EQ(std::memcmp(bytes.data() + at, points().data(), bytes.size() - at), 0);
}

TEST_F(SingleExport, MapsAndTablesAreThoseOfTheWholeScan) {
  OutputFolder out = begun(folder_ / "whole");
  write_scan(session_, out);
  write(ExportKind::map, "m.ot");
  write(ExportKind::map, "m.bt");
  write(ExportKind::views, "v.csv");
  write(ExportKind::curves, "s.csv");
  for (const auto& [one, of_all] : {std::pair("m.ot", "map.ot"), std::pair("m.bt", "map.bt"),
                                    std::pair("v.csv", "views.csv"), std::pair("s.csv", "steps.csv")})
    EXPECT_EQ(read_file(folder_ / one) == read_file(folder_ / "whole" / of_all), true) << one;
}

TEST_F(SingleExport, ViewsAreThePosesThatWereTaken) {
  write(ExportKind::views, "v.json");
  write(ExportKind::views, "v.txt");
  const auto views = nlohmann::json::parse(read_file(folder_ / "v.json"));
  std::istringstream lines(read_file(folder_ / "v.txt"));
  std::string comment;
  std::getline(lines, comment);
  EXPECT_EQ(comment[0], '#');
  EXPECT_THAT(comment, HasSubstr("x y z [m] qx qy qz qw"));
  ASSERT_EQ(views.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const Pose& pose = session_.records()[k].T_world_camera;
    EXPECT_EQ(views[k]["step"], k + 1);
    for (int i = 0; i < 16; ++i) EXPECT_EQ(views[k]["T_world_camera"][i], pose.matrix()(i / 4, i % 4));
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(views[k]["position_m"][i], pose.translation()[i]);
      EXPECT_EQ(views[k]["look_direction"][i], pose.linear()(i, 2));
    }
    double p[3], q[4];
    lines >> p[0] >> p[1] >> p[2] >> q[0] >> q[1] >> q[2] >> q[3];
    ASSERT_TRUE(lines);
    EXPECT_EQ(Vector3(p), pose.translation());
    const Eigen::Matrix3d R = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
    EXPECT_LT((R - pose.linear()).norm(), 1e-12);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(views[k]["quaternion_xyzw"][i], q[i]);
  }
}

TEST_F(SingleExport, ASurfaceIsWhatWasSeenAndTheRestAFileOfItsOwn) {
  const ScanSurface whole = scan_surface(session_, SurfaceSource::map);
  for (const std::string ending : {".ply", ".stl"}) {
    SCOPED_TRACE(ending);
    EXPECT_EQ(write(ExportKind::surface, "seen" + ending).size(), 1u);
    EXPECT_FALSE(fs::exists(folder_ / ("seen_unseen" + ending)));
    const auto files = write(ExportKind::surface, "all" + ending, {SurfaceSource::map, true});
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files[1], folder_ / ("all_unseen" + ending));
    EXPECT_EQ(read_file(files[0]) == read_file(folder_ / ("seen" + ending)), true);
    MeshFileOptions as_it_is;
    as_it_is.longest_side = 0.0;
    as_it_is.unit = LengthUnit::metres;
    const double unit = ending == ".stl" ? 1e-3 : 1.0;
    const double seen = unit * unit * load_mesh(files[0], as_it_is).surface_area();
    const double unseen = unit * unit * load_mesh(files[1], as_it_is).surface_area();
    EXPECT_GT(seen, 0.0);
    EXPECT_GT(unseen, 0.0);
    EXPECT_NEAR(seen + unseen, whole.surface.mesh.surface_area(), 1e-4 * seen);
  }
}

TEST_F(SingleExport, EndingsThatThereAreNotAreNamed) {
  EXPECT_THAT(refusal(ExportKind::cloud, "a.xyz"), HasSubstr("a.xyz: a cloud can be written as .ply or .pcd"));
  EXPECT_THAT(refusal(ExportKind::map, "a"), HasSubstr(".ot or .bt"));
  EXPECT_THAT(refusal(ExportKind::curves, "a.pdf"), HasSubstr(".csv or .svg or .png"));
  EXPECT_EQ(refusal(ExportKind::turntable, "a.folder"), "");
}

TEST_F(SingleExport, WhatASessionReadsOrKeepsIsNotWrittenOver) {
  OutputFolder out = begun(folder_ / "session");
  SessionFolder::begin(std::move(out), session_);
  fs::create_directories(folder_ / "session/scans");
  std::ofstream(folder_ / "session/scans/0001.ply") << "a scan";
  fs::create_symlink(folder_ / "session/scans/0001.ply", folder_ / "link.ply");
  fs::create_symlink(folder_ / "session/config.toml", folder_ / "link.csv");
  const fs::path session = folder_ / "session";
  EXPECT_THAT(refusal(ExportKind::cloud, folder_ / "link.ply", session), HasSubstr("a scan of the session"));
  EXPECT_THAT(refusal(ExportKind::views, folder_ / "link.csv", session), HasSubstr("the session's configuration"));
  EXPECT_THAT(refusal(ExportKind::cloud, session / "scans/0002.ply", session), HasSubstr("among the session's scans"));
  EXPECT_THAT(refusal(ExportKind::turntable, session, session), HasSubstr("the session's folder"));
  EXPECT_EQ(refusal(ExportKind::cloud, session / "cloud.ply", session), "") << "it can be made again";
  fs::create_symlink(resolve_object(session_.configuration()), folder_ / "object.ply");
  EXPECT_THAT(refusal(ExportKind::surface, folder_ / "object.ply"), HasSubstr("the object that is scanned"));
  fs::create_symlink(resolve_object(session_.configuration()), folder_ / "part_unseen.ply");
  EXPECT_THAT(refusal(ExportKind::surface, folder_ / "part.ply"), HasSubstr("the object that is scanned"));
}

TEST_F(SingleExport, WithoutAViewThereIsNothingToWrite) {
  const Session empty(small_scan());
  EXPECT_THROW(export_file(empty, ExportKind::cloud, folder_ / "c.ply"), std::invalid_argument);
  EXPECT_FALSE(fs::exists(folder_ / "c.ply"));
}

TEST_F(SingleExport, FramesReplaceEarlierFramesAndNothingElse) {
  const fs::path folder = folder_ / "frames";
  make_frame_folder(folder);
  EXPECT_EQ(frame_name(7), "frame_00007.png");
  std::ofstream(folder / frame_name(7)) << "an earlier frame";
  make_frame_folder(folder);
  EXPECT_TRUE(fs::is_empty(folder));
  std::ofstream(folder / frame_name(7)) << "an earlier frame";
  std::ofstream(folder / "frame_notes.png") << "notes";
  EXPECT_THROW(make_frame_folder(folder), std::invalid_argument);
  EXPECT_TRUE(fs::exists(folder / frame_name(7)));
  EXPECT_THROW(make_frame_folder(folder / "frame_notes.png"), std::runtime_error);
}

TEST_F(SingleExport, FramesAreThoseWithFiveDigitsOrMore) {
  const fs::path folder = folder_ / "frames";
  make_frame_folder(folder);
  EXPECT_EQ(frame_name(123456), "frame_123456.png") << "more frames than five digits count";
  for (const char* frame : {"frame_00000.png", "frame_99999.png", "frame_123456.png"}) {
    std::ofstream(folder / frame) << "an earlier frame";
    make_frame_folder(folder);
    EXPECT_TRUE(fs::is_empty(folder)) << frame;
  }
  for (const char* other : {"frame_0001.png", "frame_0000x.png", "frame_00001.jpg", "Frame_00001.png", "notes"}) {
    std::ofstream(folder / other) << "mine";
    EXPECT_THROW(make_frame_folder(folder), std::invalid_argument) << other;
    EXPECT_TRUE(fs::remove(folder / other));
  }
  fs::create_directory(folder / "frame_00001.png");
  EXPECT_THROW(make_frame_folder(folder), std::invalid_argument) << "a folder is no picture";
}

}  // namespace
}  // namespace nextview
