// Where an object reaches beyond the region, the voxels near what is occupied end at the region's borders.
#include <gtest/gtest.h>

#include "core/offline/map_calibration.hpp"
#include "core/view/candidate_views.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

/// The sphere of half a metre, cut by all six sides of a region of 0.4 m.
RefinementJob cut_sphere() {
  Configuration c = small_scan();
  c.object.file = NEXTVIEW_SOURCE_DIR "/assets/objects/sphere.ply";
  c.sensor.width = 40, c.sensor.height = 30;
  CandidateViewsConfig around;
  around.layout = ViewLayout::fibonacci;
  around.count = 6;
  RefinementJob job = refinement_job(c, candidate_views(around, Vector3::Zero()));
  job.grid = region_of_interest(Vector3::Zero(), 0.4, 0.04);
  job.truth.reset();  // it is of the whole region
  return job;
}

bool is_occupied(const GibbsPosterior& gibbs, std::uint32_t v) { return gibbs.informed[v] && gibbs.touch[v] >= 0.5f; }

/// The voxels that both maps know and that lie so near an occupied one.
std::vector<std::uint32_t> near_occupied(const Refinement& r, int band) {
  const VoxelGrid& grid = r.posterior.grid;
  std::vector<std::uint32_t> near;
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
    bool is_near = false;
    for (std::uint32_t o = 0; o < grid.voxel_count() && !is_near; ++o)
      is_near = is_occupied(r.posterior, o) && (grid.cell(v) - grid.cell(o)).cwiseAbs().maxCoeff() <= band;
    if (is_near && r.posterior.informed[v] && r.conventional.voxels()[v].measured) near.push_back(v);
  }
  return near;
}

TEST(CalibrationAtBorders, TheBandIsOfTheVoxelsThatThereAre) {
  const RefinementJob job = cut_sphere();
  const Refinement r = refine(job);
  std::size_t at_lower = 0, at_upper = 0;  // occupied ones, at the borders
  for (std::uint32_t v = 0; v < job.grid.voxel_count(); ++v) {
    if (!is_occupied(r.posterior, v)) continue;
    at_lower += (job.grid.cell(v).array() == 0).any();
    at_upper += (job.grid.cell(v).array() == job.grid.size.array() - 1).any();
  }
  ASSERT_GT(std::min(at_lower, at_upper), 10u);
  for (const int band : {1, 2}) {
    MapCalibrationConfig config;
    config.band = band;
    const ExampleScores scores = calibrate_map({{job, false}}, config).examples.at(0);
    const std::vector<std::uint32_t> near = near_occupied(r, band);
    double entropies = 0.0;
    for (const std::uint32_t v : near) entropies += entropy(r.posterior.touch[v]);
    EXPECT_EQ(scores.voxels, near.size()) << band;
    EXPECT_NEAR(scores.gibbs_entropy.value(), entropies / double(near.size()), 1e-9) << band;
  }
}

}  // namespace
}  // namespace nextview
