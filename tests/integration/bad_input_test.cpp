// Whatever is wrong with what a user gives: one clear line, exit code 2, nothing half-written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>

#include "core/file/atomic_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class BadInput : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& content) {
    std::ofstream(folder_.path() / name, std::ios::binary) << content;
    return folder_.path() / name;
  }

  /// Runs `nextview ARGUMENTS` and expects a single line on standard error that holds `words`.
  void expect_error(const std::string& arguments, const std::vector<std::string>& words) {
    const Result run = nextview(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    for (const std::string& word : words) EXPECT_THAT(run.err, HasSubstr(word));
    EXPECT_FALSE(fs::exists(folder_.path() / "out" / "steps.csv"));
  }

  void expect_bad_object(const std::string& name, const std::string& content) {
    const fs::path file = write(name, content);
    expect_error("scan " + file.string() + " --no-pictures --out " + out(), {name});
  }

  std::string out() const { return (folder_.path() / "out").string(); }
  std::string box() const { return NEXTVIEW_SOURCE_DIR "/assets/objects/box.ply"; }

  TemporaryFolder folder_;
};

const char* const ply_head =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";

TEST_F(BadInput, ANulCutsNoMessageShort) {
  const auto with_nul = [&](const std::string& name, std::string content) {
    std::replace(content.begin(), content.end(), '@', '\0');
    return write(name, content).string();
  };
  expect_error("info " + with_nul("a.ply", "ply\nformat asc@ii 1.0\n"), {"'format asc\\x00ii 1.0'\n"});
  expect_error("demo " + with_nul("a.nextview", "\nst@ep\n") + " --out " + out(), {"a.nextview:2: holds a NUL"});
  const std::string nul = "holds a NUL, which no text has\n";
  expect_error("info " + write("a.toml", "[object]\nfile = \"a\\u0000b\"\n").string(), {":2: object.file " + nul});
  expect_error("info " + write("b.toml", "[map]\n\"re\\u0000s\" = 3\n").string(), {":2: map.re\\x00s " + nul});
  expect_error("info " + write("c.toml", "sensor.preset = \"a\\u0000b\"\n").string(), {":1: sensor.preset " + nul});
  write("dataset.toml", "frames = \"a\\u0000b\"\n");
  expect_error("scan --recorded " + folder_.path().string() + " --out " + out(), {"dataset.toml:1: frames " + nul});
  const std::string study = "[[planning]]\nobjects = ['box']\npolicies = [\"ran\\u0000dom\"]\nseeds = [1]\nviews = 2\n";
  expect_error("study " + write("d.toml", study).string() + " --out " + out(),
               {"'policies' has no 'ran\\x00dom'; did"});
}

TEST_F(BadInput, Objects) {
  expect_error("scan " + (folder_.path() / "missing.ply").string() + " --no-pictures --out " + out(), {"missing.ply"});
  expect_error("scan " + folder_.path().string() + " --no-pictures --out " + out(), {folder_.path().string()});
  expect_bad_object("empty.ply", "");
  expect_bad_object("empty.stl", "");
  expect_bad_object("garbage.ply", std::string(5000, '\xA7'));
  expect_bad_object("garbage.obj", std::string("\x00\x01\xFF\xFE", 4) + std::string(3000, '\x7F'));
  expect_bad_object("faceless.ply", std::string(ply_head) + "end_header\n0 0 0\n1 0 0\n0 1 0\n");
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  expect_bad_object("nan.ply", ply_head + faces + "0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n");
  expect_bad_object("truncated.ply", ply_head + faces + "0 0 0\n1 0 0\n");
  expect_bad_object(
      "claims.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n1234");
  std::string stl(84, '\0');
  stl[80] = stl[81] = stl[82] = stl[83] = '\x7F';
  expect_bad_object("claims.stl", stl);
  // A million kilometres: as large as it says, it does not fit the region.
  const fs::path huge = write("huge.ply", ply_head + faces + "0 0 0\n1e9 0 0\n0 1e9 0\n3 0 1 2\n");
  expect_error("scan " + huge.string() + " --object.longest_side 0 --no-pictures --out " + out(), {"huge.ply"});
}

TEST_F(BadInput, AnObjectOfOneTriangleIsScanned) {
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const fs::path file = write("one.ply", ply_head + faces + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Result run =
      nextview("scan " + file.string() +
               " --views 2 --views.count 12 --evaluation.surface_samples 1000 --no-pictures --sensor.width 80 "
               "--sensor.height 60 --out " +
               out());
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(BadInput, Options) {
  const std::string scan = "scan " + box() + " --no-pictures --out " + out() + " ";
  expect_error(scan + "--gain occlusion-awar", {"occlusion-aware"});
  expect_error(scan + "--views 0", {"views"});
  expect_error(scan + "--views -3", {"views"});
  expect_error(scan + "--views many", {"views", "many"});
  expect_error(scan + "--map.resolution 0", {"map.resolution"});
  expect_error(scan + "--map.resolution nan", {"map.resolution"});
  expect_error(scan + "--map.resolution 1e-300", {"map.resolution"});
  expect_error(scan + "--sensor.range_noise -1", {"range_noise"});
  expect_error(scan + "--sensor.width 1000000", {"width"});
  expect_error(scan + "--sensor telescope", {"telescope", "narrow"});
  expect_error(scan + "--views.layout file", {"views"});
  expect_error(scan + "--views.layout file --views.file " + (folder_.path() / "none.txt").string(), {"none.txt"});
  const fs::path far_view = write("far_view.txt", "0.9 0 0 0.5 -0.5 -0.5 0.5\n1e300 0 0 0 0 0 1\n");
  expect_error(scan + "--views.layout file --views.file " + far_view.string(), {"far_view.txt:2", "m off"});
  expect_error(scan + "--no-such-option", {"--no-such-option"});
  expect_error(scan + "--planner.combined_weights nonsense", {"combined_weights"});
  expect_error("scan no-such-object --no-pictures --out " + out(), {"no-such-object"});
  expect_error("--threads -1 " + scan, {"threads"});
}

TEST_F(BadInput, ConfigurationFiles) {
  const auto with = [&](const std::string& name, const std::string& content, const std::vector<std::string>& words) {
    expect_error("scan " + box() + " --no-pictures --out " + out() + " --config " + write(name, content).string(),
                 words);
  };
  with("unknown.toml", "[sensor]\nrange_nose = 0.1\n", {"unknown.toml:2", "range_nose", "sensor.range_noise"});
  with("syntax.toml", "[sensor\n", {"syntax.toml"});
  with("type.toml", "seed = \"seven\"\n", {"type.toml:1", "seed"});
  with("garbage.toml", std::string(300, '\xFE'), {"garbage.toml"});
}

TEST_F(BadInput, OutputFolders) {
  const fs::path file = write("file", "not a folder");
  expect_error("scan " + box() + " --no-pictures --out " + file.string(), {"file"});
  expect_error("scan " + box() + " --no-pictures --out /proc/nextview", {"/proc/nextview"});
  EXPECT_EQ(read_file(file), "not a folder");
}

TEST_F(BadInput, Scenes) {
  const auto with = [&](const std::string& name, const std::string& content) {
    const std::string csv = (folder_.path() / "scores.csv").string();
    expect_error("score --scene " + write(name, content).string() + " --csv " + csv, {name});
    EXPECT_FALSE(fs::exists(csv));
  };
  with("empty.txt", "");
  with("garbage.txt", std::string(3000, '\x05'));
  with("truncated.txt", "scan 0 0 0 0 0 0 1 5\n1 2 3\n");
  with("claims.txt", "scan 0 0 0 0 0 0 1 2000000000\n1 2 3\n");
  with("nan.txt", "scan 0 0 0 0 0 0 1 1\nnan 2 3\nview 0 0 0 0 0 0 1\n");
  with("quaternion.txt", "scan 0 0 0 0 0 0 7 1\n1 2 3\nview 0 0 0 0 0 0 1\n");
  const std::string scan = "scan 0 0 0 0 0 0 1 1\n0 0 1\nview 0 0 0 0 0 0 1\n";
  with("resolution.txt", "param resolution_m 0\n" + scan);
  with("fine.txt", "param resolution_m 1e-9\n" + scan);
  with("far.txt", "param bbox_max_x 1e300\n" + scan);
  with("far_scan.txt", "scan 1e9 0 0 0 0 0 1 1\n0 0 1\nview 0 0 0 0 0 0 1\n");
  for (const char* file : {"resolution.txt", "fine.txt"})
    expect_error("score --semantics reference --scene " + (folder_.path() / file).string(), {file, "resolution_m"});
  for (const char* file : {"far.txt", "far_scan.txt"})
    expect_error("score --semantics reference --scene " + (folder_.path() / file).string(), {file, "octree"});
  with("no_views.txt", "scan 0 0 0 0 0 0 1 1\n0 0 1\n");
  expect_error("score --scene " + (folder_.path() / "none.txt").string(), {"none.txt"});
  expect_error("score", {"--scene"});
}

}  // namespace
}  // namespace nextview
