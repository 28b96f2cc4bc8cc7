// The surfaces that scan and refine leave behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file/atomic_file.hpp"
#include "core/mesh/mesh_file.hpp"
#include "tests/integration/program.hpp"
#include "tests/integration/tables.hpp"

namespace nextview {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

/// Few pixels, coarse voxels, a region that leaves little room around the object.
const std::string coarse_surface =
    " --sensor.width 80 --sensor.height 60 --map.resolution 0.03 --map.region_edge 0.72 --views.count 12 "
    "--evaluation.surface_samples 1000 ";

class Surfaces : public ::testing::Test {
 protected:
  fs::path in(const std::string& name) const { return folder_.path() / name; }
  /// What the program printed.
  std::string run(const std::string& arguments, const std::string& out) const {
    const Result result = nextview(arguments + " --out " + in(out).string());
    EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
    return result.out;
  }
  json surfaces(const std::string& out) const { return json::parse(read_file(in(out) / "surfaces.json")); }
  std::vector<std::string> surface_names(const std::string& out) const {
    std::vector<std::string> names = file_names(in(out));
    std::erase_if(names, [](const std::string& name) { return !name.starts_with("surface"); });
    return names;
  }
  const TemporaryFolder folder_;
};

/// As the numbers stand in the file: an STL's are millimetres, which load_mesh takes for metres.
TriangleMesh read(const fs::path& file) { return load_mesh(file, {.longest_side = 0.0, .unit = LengthUnit::metres}); }

/// The STLs hold what was seen and, in a file of its own, what was not; together they are the PLY.
void expect_parts(const json& surface, const fs::path& folder, const std::string& name) {
  std::size_t triangles = 0;
  for (const auto& [part, key] : {std::pair(".stl", "area_seen_m2"), {"_unseen.stl", "area_unseen_m2"}}) {
    const fs::path file = folder / (name + part);
    ASSERT_EQ(fs::exists(file), surface[key] > 0.0) << file;
    if (!fs::exists(file)) continue;
    const TriangleMesh mesh = read(file);
    triangles += mesh.triangles.size();
    EXPECT_NEAR(double(surface[key]), 1e-6 * mesh.surface_area(), 1e-4 * double(surface["area_m2"])) << file;
  }
  // Triangles next to without area may have none in one of the two units.
  const double whole = double(read(folder / (name + ".ply")).triangles.size());
  EXPECT_NEAR(double(triangles), whole, 0.01 * whole) << name;
  EXPECT_NEAR(double(surface["area_seen_m2"]) + double(surface["area_unseen_m2"]), surface["area_m2"], 1e-6);
}

void expect_sane(const json& surface, const fs::path& folder, const std::string& name, bool has_error) {
  SCOPED_TRACE(name);
  expect_parts(surface, folder, name);
  const TriangleMesh mesh = read(folder / (name + ".ply"));
  // Noise-free points on a plane leave triangles without area, which are not read.
  EXPECT_GE(std::size_t(surface["triangles"]), mesh.triangles.size());
  EXPECT_LE(0.95 * double(surface["triangles"]), double(mesh.triangles.size()));
  EXPECT_NEAR(double(surface["area_m2"]), mesh.surface_area(), 1e-4 * double(surface["area_m2"]));
  EXPECT_EQ(surface["closed"], topology(mesh).watertight());
  EXPECT_EQ(surface["openings"] == 0, topology(mesh).boundary_edges == 0);
  EXPECT_EQ(surface["longest_openings"].size(), std::min<std::size_t>(20, surface["openings"]));
  double shorter = 1e9;
  for (const json& opening : surface["longest_openings"]) {
    EXPECT_GT(opening["length_m"], 0.0);
    EXPECT_LE(opening["length_m"], shorter);
    shorter = opening["length_m"];
  }
  ASSERT_EQ(surface.contains("surface_error"), has_error);
  if (!has_error) return;
  const json& i = surface["surface_error"];
  EXPECT_NEAR(double(i["area_seen_m2"]) + double(i["area_unseen_m2"]), surface["area_m2"], 1e-6);
  EXPECT_LE(std::abs(double(i["bias_m"])), double(i["rms_m"]));
  EXPECT_LE(i["percentile_50_m"], i["percentile_95_m"]);
  EXPECT_LE(i["percentile_95_m"], i["percentile_99_m"]);
  EXPECT_LE(i["percentile_99_m"], i["largest_m"]);
  EXPECT_LE(i["rms_m"], i["largest_m"]);
  json before = {{"threshold_m", 0.0}, {"accuracy", 0.0}, {"completeness_visible", 0.0}, {"completeness_all", 0.0}};
  ASSERT_EQ(i["thresholds"].size(), 5u);
  for (const json& score : i["thresholds"]) {
    for (const auto& [key, value] : before.items()) EXPECT_LE(value, score[key]) << key << " grows with the threshold";
    for (const char* key : {"accuracy", "completeness_visible", "completeness_all", "f_score"})
      EXPECT_LE(score[key], 1.0) << key;
    EXPECT_GE(score["f_score"], std::min(double(score["accuracy"]), double(score["completeness_visible"])) - 1e-12);
    for (auto& [key, value] : before.items()) value = score[key];
  }
}

TEST_F(Surfaces, AScanOfASphereIsASphereInMillimetres) {
  const std::string printed =
      run("scan sphere --views 14 --views.count 14 --sensor.width 120 --sensor.height 90 --map.resolution 0.02 "
          "--map.region_edge 0.64 --evaluation.surface_samples 1000 --no-pictures",
          "out");
  EXPECT_THAT(printed, HasSubstr("watertight"));
  for (const std::string name : {"surface_map", "surface_cloud"}) {
    const TriangleMesh mesh = read(in("out") / (name + ".ply"));
    expect_sane(surfaces("out")[name], in("out"), name, true);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(mesh.bounding_box().sizes()[axis], 0.5, name == "surface_map" ? 0.02 : 0.005) << name;
    EXPECT_TRUE(topology(mesh).watertight()) << name << ": " << topology(mesh).summary();
    EXPECT_FALSE(topology(mesh).inward) << name;
    EXPECT_EQ(topology(mesh).misoriented_edges, 0u) << name;
    // The STL is the same surface in millimetres: hardly anything was not seen.
    EXPECT_GT(double(surfaces("out")[name]["area_seen_m2"]), 0.95 * mesh.surface_area()) << name;
    EXPECT_LT((1e3 * mesh.bounding_box().sizes() - read(in("out") / (name + ".stl")).bounding_box().sizes()).norm(),
              1.0)
        << name;
  }
  const double radius = 0.25, area = 4.0 * std::numbers::pi * radius * radius;  // [m, m^2]
  EXPECT_NEAR(double(surfaces("out")["surface_cloud"]["area_m2"]), area, 0.02 * area);
  EXPECT_LT(surfaces("out")["surface_cloud"]["surface_error"]["percentile_95_m"], 0.002);
}

TEST_F(Surfaces, OneViewIsEnoughAndPicturesAreDrawn) {
  const std::string printed = run("scan slotted_plate --views 1" + coarse_surface, "out");
  EXPECT_THAT(surface_names("out"),
              ElementsAre("surface_cloud.ply", "surface_cloud.png", "surface_cloud.stl", "surface_map.ply",
                          "surface_map.png", "surface_map.stl", "surface_map_unseen.stl", "surfaces.json"));
  const json found = surfaces("out");
  ASSERT_EQ(found.size(), 2u);
  for (const std::string name : {"surface_map", "surface_cloud"}) expect_sane(found[name], in("out"), name, true);
  EXPECT_THAT(printed, HasSubstr("closed, but only ")) << "not: watertight";
  EXPECT_THAT(printed, HasSubstr("is the hull of what no ray met"));
  EXPECT_THAT(printed.substr(printed.find("Surface of the occ")), Not(HasSubstr("watertight")));
  EXPECT_EQ(found["surface_map"]["closed"], true) << "where no view has looked, too";
  EXPECT_EQ(found["surface_map"]["watertight"], false);
  EXPECT_GT(found["surface_map"]["surface_error"]["area_unseen_m2"], 0.0);
  EXPECT_GT(found["surface_cloud"]["openings"], 0) << "open where no view has looked";
  EXPECT_EQ(found["surface_cloud"]["surface_error"]["area_unseen_m2"], 0.0);
}

TEST_F(Surfaces, NoneIfNotWanted) {
  const std::string printed = run("scan box --views 1 --no-pictures --no-surfaces" + coarse_surface, "scan");
  EXPECT_THAT(surface_names("scan"), ElementsAre());
  EXPECT_THAT(printed, Not(HasSubstr("urface_")));
  EXPECT_THAT(run("refine " + in("scan").string() + " --no-pictures --no-surfaces", "refined"),
              Not(HasSubstr("urface_")));
  EXPECT_THAT(surface_names("refined"), ElementsAre());
}

TEST_F(Surfaces, WithoutEvaluationNothingIsHeldAgainstTheTruth) {
  const std::string printed =
      run("scan box --views 3 --evaluation.enabled false --no-pictures" + coarse_surface, "out");
  EXPECT_THAT(printed, Not(HasSubstr("true surface")));
  for (const std::string name : {"surface_map", "surface_cloud"})
    expect_sane(surfaces("out")[name], in("out"), name, false);
}

TEST_F(Surfaces, AScanPlannedOnTheGibbsMapShowsThatMapOnAnyNumberOfThreads) {
  const std::string scan = " scan box --views 2 --gain gibbs --no-pictures" + coarse_surface;
  run("--threads 1" + scan, "one");
  run("--threads 2" + scan, "two");
  EXPECT_THAT(surface_names("one"),
              ElementsAre("surface_cloud.ply", "surface_cloud.stl", "surface_posterior.ply", "surface_posterior.stl",
                          "surface_posterior_unseen.stl", "surfaces.json"));
  expect_sane(surfaces("one")["surface_posterior"], in("one"), "surface_posterior", true);
  for (const std::string& name : surface_names("one"))
    EXPECT_TRUE(read_file(in("one") / name) == read_file(in("two") / name)) << name << " differs";
}

// The refinement's cloud is that of the scan, which it took again: so is the surface.
TEST_F(Surfaces, RefiningAScanLeavesThePosteriorsAndTheSameCloud) {
  run("scan box --views 3 --no-pictures" + coarse_surface, "scan");
  run("--threads 1 refine --no-pictures " + in("scan").string(), "one");
  run("--threads 2 refine --no-pictures " + in("scan").string(), "two");
  EXPECT_THAT(surface_names("one"),
              ElementsAre("surface_cloud.ply", "surface_cloud.stl", "surface_posterior.ply", "surface_posterior.stl",
                          "surface_posterior_unseen.stl", "surfaces.json"));
  expect_sane(surfaces("one")["surface_posterior"], in("one"), "surface_posterior", true);
  EXPECT_TRUE(read_file(in("one") / "surface_cloud.ply") == read_file(in("scan") / "surface_cloud.ply"));
  EXPECT_EQ(surfaces("one")["surface_cloud"], surfaces("scan")["surface_cloud"]);
  for (const std::string& name : surface_names("one"))
    EXPECT_TRUE(read_file(in("one") / name) == read_file(in("two") / name)) << name << " differs";
}

TEST_F(Surfaces, ARecordedSceneHasUncertaintyInPlaceOfTruth) {
  write_file(in("scene.txt"), wall_scene(0.02));
  const std::string printed = run("refine " + in("scene.txt").string(), "out");
  EXPECT_THAT(printed, Not(HasSubstr("true surface")));
  EXPECT_EQ(surface_names("out").size(), 8u);
  const TriangleMesh cloud = read(in("out") / "surface_cloud.stl");
  for (const std::string name : {"surface_cloud", "surface_posterior"})
    expect_sane(surfaces("out")[name], in("out"), name, false);
  EXPECT_THAT(printed, HasSubstr("% of it was seen: "));
  EXPECT_NEAR(double(surfaces("out")["surface_cloud"]["area_m2"]), 0.16, 0.02);
  EXPECT_NEAR(cloud.bounding_box().sizes().x(), 400.0, 20.0);
  EXPECT_LT(cloud.bounding_box().sizes().z(), 5.0) << "a wall is flat";
}

TEST_F(Surfaces, ACameraThatSeesNothingGivesReasonsAndNoFiles) {
  const std::string printed = run("scan box --views 1 --no-pictures --sensor.max_range 0.3" + coarse_surface, "out");
  EXPECT_THAT(surface_names("out"), ElementsAre("surfaces.json"));
  for (const std::string name : {"surface_map", "surface_cloud"}) {
    EXPECT_EQ(surfaces("out")[name].size(), 1u);
    const std::string reason = surfaces("out")[name]["empty"];
    EXPECT_GT(reason.size(), 5u);
    EXPECT_THAT(printed, HasSubstr(reason));
  }
}

// Nor a list of none of them, which is no list.
TEST_F(Surfaces, AStoppedScanLeavesNone) {
  const std::string printed = in("printed").string();
  // Ctrl+C once the first view is taken; views are coarse_surface to take, and more of them than there is time for.
  const Result result = nextview_behind(
      "sh -c 'env --default-signal=INT \"$0\" \"$@\" > \"" + printed +
          "\" & nextview=$!; for i in $(seq 600); do grep -qs start \"" + printed +
          "\" && break; sleep 0.1; done; kill -INT $nextview; wait $nextview'",
      "scan sphere --no-pictures --views 200 --termination.surface_left 0 --sensor.width 80 --sensor.height 60 "
      "--map.resolution 0.03 --map.region_edge 0.72 --views.count 200 --evaluation.surface_samples 1000 --out " +
          in("out").string());
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_TRUE(fs::exists(in("out") / "steps.csv")) << "it was stopped before it had taken a view";
  EXPECT_THAT(surface_names("out"), ElementsAre());
}

// What the program lists as written is there.
TEST_F(Surfaces, TheListOfFilesTellsTheTruth) {
  EXPECT_THAT(run("scan box --views 2 --no-pictures" + coarse_surface, "scan"), Not(HasSubstr(".png")));
  EXPECT_THAT(run("refine " + in("scan").string() + " --no-pictures", "refined"), Not(HasSubstr(".png")));
  EXPECT_THAT(run("scan box --views 2 --no-pictures --sensor.max_range 0.3" + coarse_surface, "blind"),
              Not(HasSubstr("surface_*.ply")));
}

}  // namespace
}  // namespace nextview
