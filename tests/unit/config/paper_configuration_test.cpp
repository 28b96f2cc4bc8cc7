// `--config paper` stays what the paper, and where it is silent version 0.4.0, did, however the defaults move.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/config/configuration.hpp"

namespace nextview {
namespace {

/// What 0.4.0 wrote into config.toml with its own `--config paper`. Never to be changed.
constexpr std::array<std::array<const char*, 2>, 86> pinned = {{
    {"object.longest_side", "0.5"},
    {"object.unit", "auto"},
    {"object.centred", "true"},
    {"object.ground", "false"},
    {"sensor.width", "640"},
    {"sensor.height", "480"},
    {"sensor.field_of_view", "58"},
    {"sensor.intrinsics", ""},
    {"sensor.min_range", "0.2"},
    {"sensor.max_range", "1.5"},
    {"sensor.range_noise", "0.002"},
    {"sensor.dropout", "0"},
    {"sensor.outliers", "0"},
    {"sensor.grazing_limit", "85"},
    {"sensor.seconds", "4"},
    {"cloud.outlier_removal", "true"},
    {"cloud.outlier_neighbours", "16"},
    {"cloud.outlier_deviations", "3"},
    {"cloud.down_sampling", "false"},
    {"cloud.down_sampling_leaf", "0.002"},
    {"map.resolution", "0.01"},
    {"map.region_edge", "1.28"},
    {"map.region", ""},
    {"map.occlusion_distance", "0.3"},
    {"map.insertion", "local-octree"},
    {"map.hit", "0.7"},
    {"map.miss", "0.4"},
    {"map.hit_decay", "0"},
    {"map.miss_decay", "0"},
    {"map.clamp_min", "0.12"},
    {"map.clamp_max", "0.97"},
    {"map.occupancy_threshold", "0.5"},
    {"map.free_below", "0.2"},
    {"map.occupied_above", "0.8"},
    {"gibbs.model", "paper"},
    {"gibbs.voxel_range", "centre"},
    {"gibbs.sigma", "0"},
    {"gibbs.angular_sigma", "0"},
    {"gibbs.random_weight", "0.05"},
    {"gibbs.max_weight", "0.05"},
    {"gibbs.eta_hit", "1"},
    {"gibbs.attenuations", "0.05, 0.2"},
    {"gibbs.independence", "1"},
    {"gibbs.prior", "0.5"},
    {"gibbs.sampler", "algorithm1"},
    {"gibbs.updated", "occupied-and-free"},
    {"gibbs.start", "octree"},
    {"gibbs.swaps", "0"},
    {"gibbs.plaquettes", "0"},
    {"gibbs.chains", "1"},
    {"gibbs.sweeps", "20"},
    {"gibbs.burn_in", "10"},
    {"gibbs.until_stationary", "false"},
    {"gibbs.view_sweeps", "20"},
    {"gibbs.read_out", "levels"},
    {"gibbs.ray_spacing", "0.6"},
    {"views.layout", "sphere"},
    {"views.count", "48"},
    {"views.radius", "0.9"},
    {"views.rings", "3"},
    {"planner.gain", "occlusion-aware"},
    {"planner.semantics", "published"},
    {"planner.utility", "weighted-shares"},
    {"planner.gain_weight", "1"},
    {"planner.cost_weight", "1"},
    {"planner.combined_weights", ""},
    {"planner.ray_columns", "38"},
    {"planner.ray_rows", "25"},
    {"planner.ray_refinement", "1"},
    {"planner.ray_window", "1"},
    {"planner.ray_length", "1.5"},
    {"planner.simulations", "0"},
    {"planner.start_azimuth", "30"},
    {"planner.start_elevation", "20"},
    {"planner.start_view", ""},
    {"termination.views", "20"},
    {"termination.surface_left", "0"},
    {"termination.coverage", "0"},
    {"termination.gain", "0"},
    {"termination.new_voxels", "0"},
    {"termination.entropy_slope", "0"},
    {"evaluation.enabled", "true"},
    {"evaluation.d_reg", "0.005"},
    {"evaluation.samples", "surface"},
    {"evaluation.surface_samples", "50000"},
    {"evaluation.any_pose", "false"},
}};
const std::set<std::string> not_pinned = {
    "seed",       "object.file",          "sensor.preset",   "views.file",
    "views.unit", "robot.working_volume", "driver.hand_eye", "registration.min_overlap"};

Configuration paper(const Configuration& base) {
  return read_configuration(std::filesystem::path(NEXTVIEW_SOURCE_DIR) / "assets/configurations/paper.toml", base);
}

/// Another value of the same kind.
std::string other_value(const Setting& setting) {
  if (const auto* choice = std::get_if<Setting::Choice>(&setting.value))
    return choice->names[(choice->get() + 1) % choice->names.size()];
  if (std::holds_alternative<bool*>(setting.value)) return setting.text() == "true" ? "false" : "true";
  if (std::holds_alternative<std::string*>(setting.value)) return setting.text() + "x";
  return std::to_string(std::stoi(setting.text()) + 3);
}

void expect_pinned(Configuration configuration) {
  const auto found = settings(configuration);
  for (const auto& [key, value] : pinned) {
    const auto setting =
        std::find_if(found.begin(), found.end(), [key = key](const Setting& s) { return s.key == key; });
    ASSERT_NE(setting, found.end()) << key << " is gone";
    EXPECT_EQ(setting->text(), value) << key;
  }
}

TEST(PaperConfiguration, PinsWhatVersion040Did) { expect_pinned(paper(Configuration())); }

TEST(PaperConfiguration, PinsItWhateverTheDefaultsAre) {
  Configuration moved;
  auto all = settings(moved);
  for (Setting& s : all)
    if (!not_pinned.contains(s.key)) s.set(other_value(s));
  const Configuration result = paper(moved);
  expect_pinned(result);
}

TEST(PaperConfiguration, LeavesTheSeedTheObjectTheSensorsNameAndTheViewsFileAlone) {
  Configuration own;
  own.seed = 77, own.object.file = "mine.ply", own.sensor_preset = "narrow", own.views.file = "mine.txt";
  const Configuration result = paper(own);
  EXPECT_EQ(result.seed, 77u);
  EXPECT_EQ(result.object.file, "mine.ply");
  EXPECT_EQ(result.sensor_preset, "narrow");
  EXPECT_EQ(result.views.file, "mine.txt");
}

TEST(PaperConfiguration, TheDefaultPlanIsExpectedNewSurfaceWithALowerCost) {
  const Configuration defaults;
  EXPECT_EQ(defaults.planner.gain, "new-surface");
  EXPECT_EQ(defaults.planner.weights.gain, 1.0);
  EXPECT_EQ(defaults.planner.weights.cost, 0.3);
  EXPECT_EQ(paper(defaults).planner.gain, "occlusion-aware");
  EXPECT_EQ(paper(defaults).planner.weights.cost, 1.0);
}

}  // namespace
}  // namespace nextview
