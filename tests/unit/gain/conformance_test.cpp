#include "tests/data/conformance.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "core/gain/map_rays.hpp"
#include "core/gain/view_score.hpp"
#include "core/sensor/recorded_scans.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::string> name_of_column = {
    {"OcclusionAwareIg", "occlusion-aware"}, {"UnobservedVoxelIg", "unobserved-voxel"},
    {"RearSideVoxelIg", "rear-side-voxel"},  {"RearSideEntropyIg", "rear-side-entropy"},
    {"ProximityCountIg", "proximity-count"}, {"VasquezGomezAreaFactorIg", "area-factor"},
    {"AverageEntropyIg", "average-entropy"}};

struct Expected {
  std::vector<const Gain*> gains;
  std::vector<std::vector<double>> views;
};

Expected read_expected(const fs::path& file) {
  Expected expected;
  std::ifstream in(file);
  std::string line, cell;
  std::getline(in, line);
  std::istringstream head(line);
  std::getline(head, cell, ',');
  while (std::getline(head, cell, ',')) expected.gains.push_back(&gain(name_of_column.at(cell)));
  while (std::getline(in, line)) {
    std::istringstream row(line);
    std::getline(row, cell, ',');
    EXPECT_EQ(std::stoul(cell), expected.views.size());
    auto& values = expected.views.emplace_back();
    while (std::getline(row, cell, ',')) values.push_back(std::stod(cell));
  }
  return expected;
}

ReferenceMap::Parameters parameters_of(const RecordedScene& scene) {
  const auto& p = scene.parameters;
  ReferenceMap::Parameters parameters;
  parameters.resolution = p.at("resolution_m");
  parameters.model.hit = p.at("hit_probability");
  parameters.model.miss = p.at("miss_probability");
  parameters.model.clamp_min = p.at("clamping_threshold_min");
  parameters.model.clamp_max = p.at("clamping_threshold_max");
  parameters.model.occupancy_threshold = p.at("occupancy_threshold");
  parameters.model.free_below = p.at("p_unknown_lower_bound");
  parameters.model.occupied_above = p.at("p_unknown_upper_bound");
  parameters.use_bounding_box = p.at("use_bounding_box") != 0;
  parameters.lower = {p.at("bbox_min_x"), p.at("bbox_min_y"), p.at("bbox_min_z")};
  parameters.upper = {p.at("bbox_max_x"), p.at("bbox_max_y"), p.at("bbox_max_z")};
  parameters.max_sensor_range = p.at("max_sensor_range_m");
  parameters.occlusion_distance = p.at("occlusion_update_dist_m");
  parameters.max_ray_depth = p.at("max_ray_depth_m");
  return parameters;
}

RayBundle bundle_of(const RecordedScene& scene) {
  const auto& p = scene.parameters;
  PinholeCamera camera;
  camera.width = int(p.at("img_width_px")), camera.height = int(p.at("img_height_px"));
  camera.fx = p.at("fx"), camera.fy = p.at("fy"), camera.cx = p.at("cx"), camera.cy = p.at("cy");
  return RayBundle::reference(camera, {p.at("min_x_perc"), p.at("min_y_perc")},
                              {p.at("max_x_perc"), p.at("max_y_perc")},
                              {1 / p.at("raycasting_resolution_x"), 1 / p.at("raycasting_resolution_y")});
}

std::unique_ptr<ReferenceMap> map_of(const RecordedScene& scene) {
  auto map = std::make_unique<ReferenceMap>(parameters_of(scene));
  for (const RecordedScan& scan : scene.scans) {
    std::vector<Eigen::Vector3f> points;
    for (const Vector3& p : scan.points) points.push_back((scan.T_world_camera * p).cast<float>());
    map->insert(scan.T_world_camera.translation(), points);
  }
  return map;
}

void expect_explanations_to_sum(const ReferenceMap& map, const Pose& view, const RayBundle& bundle) {
  for (const Gain& g : gains()) {
    const auto why = explain_score(map, view, bundle, g, {Semantics::reference, 60});
    double sum = 0.0;
    for (const auto& ray : why.rays)
      for (const auto& voxel : ray.voxels) sum += voxel.contribution;
    EXPECT_NEAR(sum, why.value, 1e-9 * (1 + std::abs(why.value))) << g.name;
  }
}

void expect_the_same_on_one_thread(const ReferenceMap& map, std::span<const Pose> views, const RayBundle& bundle,
                                   std::span<const Gain* const> gains, const ScoreOptions& options,
                                   std::span<const ViewScore> scores) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  const auto again = score_views(map, views.first(8), bundle, gains, options);
  for (std::size_t v = 0; v < again.size(); ++v) EXPECT_EQ(again[v].gains, scores[v].gains);
}

class Conformance : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { scene_file_ = unpack_conformance_scene(GetParam(), folder_ / ""); }
  const TemporaryFolder folder_;
  fs::path scene_file_;
};

TEST_P(Conformance, EveryGainOfEveryViewIsThatOfTheReferenceCode) {
  const RecordedScene scene = read_recorded_scene(scene_file_);
  const Expected expected = read_expected(conformance_file(std::string(GetParam()) + ".expected.csv"));
  const auto map = map_of(scene);
  const ScoreOptions options{Semantics::reference,
                             2 * scene.parameters.at("occlusion_update_dist_m") / scene.parameters.at("resolution_m")};
  const auto scores = score_views(*map, scene.views, bundle_of(scene), expected.gains, options);
  ASSERT_EQ(scores.size(), 48u);
  ASSERT_EQ(expected.views.size(), 48u);
  ASSERT_EQ(expected.gains.size(), 7u);
  double worst = 0.0;
  for (std::size_t v = 0; v < 48; ++v)
    for (std::size_t g = 0; g < 7; ++g) {
      const double wanted = expected.views[v][g], found = scores[v].gains[g];
      const std::string_view name = expected.gains[g]->name;
      const double absolute = name == "proximity-count" ? 60.0 : name == "rear-side-voxel" ? 1.0 : 1e-9;
      EXPECT_LE(std::abs(found - wanted), std::max(1e-3 * std::abs(wanted), absolute))
          << name << " of view " << v << ": " << found << " instead of " << wanted;
      if (wanted != 0) worst = std::max(worst, std::abs(found / wanted - 1));
    }
  expect_the_same_on_one_thread(*map, scene.views, bundle_of(scene), expected.gains, options, scores);
  expect_explanations_to_sum(*map, scene.views[20], bundle_of(scene));
  RecordProperty("largest_relative_difference", std::to_string(worst));
}

INSTANTIATE_TEST_SUITE_P(Sets, Conformance, testing::ValuesIn(conformance_sets));

}  // namespace
}  // namespace nextview
