// `--config paper` on the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "core/file/atomic_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// The lines of a section of a TOML, and all other lines.
struct Sections {
  std::string gibbs, seed, rest;
  explicit Sections(const std::string& toml) {
    std::istringstream lines(toml);
    std::string section;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("[")) section = line;
      (section == "[gibbs]" ? gibbs : line.starts_with("seed = ") ? seed : rest) += line + "\n";
    }
  }
};

class Paper : public ::testing::Test {
 protected:
  void run(const std::string& arguments) const {
    const Result result = nextview(arguments);
    ASSERT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
  }
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  Sections configuration(const std::string& name) const {
    return Sections(read_file(folder_.path() / name / "config.toml"));
  }
  const TemporaryFolder folder_;
};

const std::string noisy_box_scan =
    "scan box --views 2 --sensor.width 60 --sensor.height 45 --map.resolution 0.04 --views.count 6 "
    "--sensor.range_noise "
    "0.003 --evaluation.surface_samples 100 --no-pictures --no-surfaces ";

// The folder's camera, map and views are what was scanned: only how the map is refined, and the seed, can be told.
TEST_F(Paper, RefineTakesOfAConfigurationTheSamplerAndTheSeedOnly) {
  run(noisy_box_scan + "--seed 5 --out " + in("scan"));
  run(noisy_box_scan + "--config paper --seed 6 --out " + in("paper"));
  const Sections scanned = configuration("scan"), paper = configuration("paper");
  ASSERT_NE(scanned.gibbs, paper.gibbs);
  for (const char* line : {"\nmodel = 'paper' ", "\nsampler = 'algorithm1' ", "\nsweeps = 20 ", "\nchains = 1 "})
    ASSERT_THAT(paper.gibbs, ::testing::HasSubstr(line));
  ASSERT_NE(scanned.rest, paper.rest) << "gain and cost weight, at least";
  const std::string refine = "refine " + in("scan") + " --no-pictures --no-surfaces --out " + in("refined");

  run(refine + " --config paper");
  EXPECT_EQ(configuration("refined").gibbs, paper.gibbs);
  EXPECT_EQ(configuration("refined").seed, scanned.seed) << "the paper names none";
  EXPECT_EQ(configuration("refined").rest, scanned.rest);

  run(refine + " --config " + in("paper/config.toml"));
  EXPECT_EQ(configuration("refined").gibbs, paper.gibbs);
  EXPECT_EQ(configuration("refined").seed, paper.seed);
  EXPECT_EQ(configuration("refined").rest, scanned.rest);
}

TEST_F(Paper, ScanTakesAllOfItAndOptionsOverrideIt) {
  run(noisy_box_scan + "--config paper --out " + in("paper"));
  run(noisy_box_scan + "--config paper --planner.cost_weight 0.5 --out " + in("own"));
  EXPECT_THAT(configuration("paper").rest, ::testing::HasSubstr("\ngain = 'occlusion-aware'"));
  EXPECT_THAT(configuration("paper").rest, ::testing::HasSubstr("\ncost_weight = 1 "));
  EXPECT_THAT(configuration("own").rest, ::testing::HasSubstr("\ncost_weight = 0.5 "));
  run(noisy_box_scan + "--out " + in("default"));
  EXPECT_THAT(configuration("default").rest, ::testing::HasSubstr("\ngain = 'new-surface'"));
  EXPECT_THAT(configuration("default").rest, ::testing::HasSubstr("\ncost_weight = 0.3 "));
}

}  // namespace
}  // namespace nextview
