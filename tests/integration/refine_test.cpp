// The refine command as a user runs it, and scans planned on the Gibbs map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "core/file/atomic_file.hpp"
#include "core/map/octree_file.hpp"
#include "tests/data/conformance.hpp"
#include "tests/integration/housing_scan.hpp"
#include "tests/integration/program.hpp"
#include "tests/integration/tables.hpp"
#include "tests/unit/cloud/made_range_scans.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string three_views = housing() + "--views 3 " + coarse_housing + "--no-pictures ";

class Refine : public ::testing::Test {
 protected:
  void SetUp() override {
    const Result run = nextview("scan " + three_views + "--no-surfaces --out " + scan());
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  std::string scan() const { return (folder_.path() / "scan").string(); }
  std::string out(const std::string& name) const { return (folder_.path() / name).string(); }
  const TemporaryFolder folder_;
};

TEST_F(Refine, WritesMapsNumbersAndPictures) {
  const Result run = nextview("refine " + scan() + " --out " + out("refined"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("log loss near the surface"));
  EXPECT_THAT(run.out, HasSubstr("open rows"));
  for (const char* file :
       {"posterior.ot", "posterior.bt", "conventional.ot", "scores.csv", "trace.csv", "metrics.json", "config.toml",
        "timings.csv", "refinement.png", "sensor_models.png", "surface_posterior.ply", "surface_posterior.stl",
        "surface_posterior.png", "surface_posterior_unseen.stl", "manifest.json", "surface_cloud.ply",
        "surface_cloud.stl", "surface_cloud.png", "surfaces.json"})
    EXPECT_GT(fs::file_size(fs::path(out("refined")) / file), 0u) << file;
  EXPECT_EQ(std::distance(fs::directory_iterator(out("refined")), fs::directory_iterator{}), 19)
      << "something else was left behind";
  // The views are taken again exactly: the conventional map is that of the scan.
  EXPECT_TRUE(read_file(fs::path(out("refined")) / "conventional.ot") == read_file(fs::path(scan()) / "map.ot"));
  const auto metrics = nlohmann::json::parse(read_file(fs::path(out("refined")) / "metrics.json"));
  EXPECT_GT(metrics["diagnostics"]["informed_voxels"], 10000);
  EXPECT_LT(metrics["gibbs"]["touch truth"]["visited"]["log_loss_nats"],
            metrics["conventional"]["touch truth"]["visited"]["log_loss_nats"]);
}

TEST_F(Refine, SameBytesOnAnyNumberOfThreadsAndFromItsOwnConfiguration) {
  ASSERT_EQ(nextview("--threads 1 refine " + scan() + " --no-surfaces --out " + out("one")).exit_code, 0);
  ASSERT_EQ(nextview("--threads 2 refine " + scan() + " --no-surfaces --out " + out("two") + " --config " + out("one") +
                     "/config.toml")
                .exit_code,
            0);
  for (const auto& entry : fs::directory_iterator(out("one"))) {
    const fs::path name = entry.path().filename();
    if (name == "timings.csv") continue;
    EXPECT_TRUE(read_file(entry.path()) == read_file(fs::path(out("two")) / name)) << name << " differs";
  }
}

TEST_F(Refine, EveryModelAndThePaperRun) {
  std::set<std::string> maps;
  for (const std::string options : {"--gibbs.model beam", "--gibbs.model cone", "--gibbs.model paper", "--config paper",
                                    "--gibbs.updated occupied", "--gibbs.start random"}) {
    const Result run = nextview("refine " + scan() + " --no-pictures --no-surfaces --gibbs.sweeps 20 " + options +
                                " --out " + out("model"));
    EXPECT_EQ(run.exit_code, 0) << options << ": " << run.err;
    EXPECT_EQ(read_file(fs::path(out("model")) / "metrics.json").find("nan"), std::string::npos) << options;
    EXPECT_TRUE(maps.insert(read_file(fs::path(out("model")) / "posterior.ot")).second)
        << options << ": as another one's";
  }
}

TEST_F(Refine, WarnsWhenItIsNotStationaryAndOfWhatAFinishedScanHasItself) {
  for (const auto& [sweeps, said] :
       {std::pair{"8", "8 sweeps are too few to tell"}, std::pair{"10", "not stationary after 10 sweeps: R-hat"}}) {
    const Result run =
        nextview("refine " + scan() + " --no-pictures --no-surfaces --out " + out("short") + sweeps +
                 " --gibbs.model paper --gibbs.burn_in 0 --gibbs.start occupied --voxel 0.5 --gibbs.sweeps " + sweeps);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr(said));
    EXPECT_THAT(run.err, HasSubstr("--voxel is for range scans"));
  }
}

TEST_F(Refine, BadInputIsOneLineAndExitCode2) {
  const auto expect = [&](const std::string& arguments, const std::string& word) {
    const Result run = nextview("refine " + arguments + " --no-pictures --out " + out("bad"));
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(word));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  };
  expect("/nowhere", "/nowhere");
  expect(scan() + " --gibbs.prior 0", "gibbs.prior");
  expect(scan() + " --gibbs.prior 1", "gibbs.prior");
  expect(scan() + " --gibbs.sigma nan", "sigma");
  expect(scan() + " --gibbs.attenuations 2,1", "attenuations");
  expect(scan() + " --gibbs.model thrun", "gibbs.model");
  expect(scan() + " --gibbs.chains 0", "gibbs.chains");
  const Result onto_itself = nextview("refine " + scan() + " --no-pictures --out " + scan());
  EXPECT_EQ(onto_itself.exit_code, 2);
  EXPECT_THAT(onto_itself.err, HasSubstr("another folder"));
  fs::remove(fs::path(scan()) / "journal");  // as 0.4.0 left it
  write_file(fs::path(scan()) / "views.csv", "step,view,x[m]\n1,77,0,0,1,0,0,0,1\n");
  expect(scan(), "views.csv:2");
  fs::remove(fs::path(scan()) / "views.csv");
  expect(scan(), "holds no finished scan");
}

TEST(RefineScenes, RecordedScansHaveNoTruthAndWork) {
  const TemporaryFolder folder;
  std::string scene =
      "param resolution_m 0.02\nparam bbox_min_x -0.3\nparam bbox_max_x 0.3\nparam bbox_min_y -0.3\n"
      "param bbox_max_y 0.3\nparam bbox_min_z 0.4\nparam bbox_max_z 1.0\nscan 0 0 0 0 0 0 1 400\n";
  for (int i = 0; i < 400; ++i)
    scene += std::to_string(-0.2 + 0.02 * (i % 20)) + " " + std::to_string(-0.2 + 0.02 * (i / 20)) + " 0.7\n";
  scene += "view 0 0 0 0 0 0 1\nview 0.1 0 0 0 0 0 1\n";
  write_file(folder.path() / "scene.txt", scene);
  const std::string out = (folder.path() / "out").string();
  const Result run =
      nextview("refine " + (folder.path() / "scene.txt").string() + " --no-pictures --no-surfaces --out " + out);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const OccupancyMap map = read_octree(fs::path(out) / "posterior.ot");
  std::size_t occupied = 0;
  for (const Voxel& v : map.voxels()) occupied += v.measured && v.probability >= 0.5f;
  EXPECT_GT(occupied, 200u);  // the wall is 20 x 20 voxels
  EXPECT_LT(occupied, 1600u);
}

TEST(RefineScenes, FoldersOfRangeScansAsStanfordHasThem) {
  const TemporaryFolder folder;
  const fs::path scans = folder.path() / "scans", out = folder.path() / "out";
  fs::create_directory(scans);
  made_range_scans::write(scans);
  const Result run = nextview("refine " + scans.string() + " --voxel 0.004 --no-pictures --no-surfaces --out " +
                              out.string() + " --gibbs.sweeps 60");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const OccupancyMap map = read_octree(out / "posterior.ot");
  std::size_t occupied = 0, off = 0;
  for (std::uint32_t v = 0; v < map.voxels().size(); ++v) {
    if (!map.voxels()[v].measured || map.voxels()[v].probability < 0.5f) continue;
    ++occupied;
    off += made_range_scans::distance_to_thing(map.grid().centre(v)) > 2.0 * 0.004;
  }
  EXPECT_GT(occupied, 1500u);
  EXPECT_LT(off, 0.02 * double(occupied)) << "the scans lie where their poses put them";
}

TEST(RefineScenes, ScoringASceneByTheGibbsGainRefinesIt) {
  const TemporaryFolder folder;
  const fs::path scene = unpack_conformance_scene("scans1", folder.path());
  const Result run = nextview("score --scene " + scene.string() + " --gain gibbs --csv -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 49);
  EXPECT_EQ(nextview("score --scene " + scene.string() + " --gain gibbs --semantics reference").exit_code, 2);
  const Table alone = read_table(run.out);
  const Table all = read_table(nextview("score --scene " + scene.string() + " --gain all --csv -").out);
  ASSERT_EQ(all.size(), alone.size());
  std::size_t as_gibbs = 0, as_conventional = 0;  // new-surface-gibbs once was what gibbs is
  for (std::size_t v = 0; v < all.size(); ++v) {
    EXPECT_EQ(all[v].at("gibbs"), alone[v].at("gibbs"));
    as_gibbs += all[v].at("new-surface-gibbs") == all[v].at("gibbs");
    as_conventional += all[v].at("new-surface-gibbs") == all[v].at("new-surface");
  }
  EXPECT_LT(std::max(as_gibbs, as_conventional), all.size() / 2);
}

TEST(GibbsScan, WritesThePosteriorAndWhatRefinementDid) {
  const TemporaryFolder folder;
  const Result run = nextview("scan " + three_views + "--gain gibbs --out " + folder.path().string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("without refinement"));
  EXPECT_NO_THROW(read_octree(folder.path() / "posterior.ot"));
  const std::string rows = read_file(folder.path() / "refinement.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 4);
  EXPECT_THAT(read_file(folder.path() / "scores.csv"), HasSubstr("gain_on_conventional_map"));
}

}  // namespace
}  // namespace nextview
