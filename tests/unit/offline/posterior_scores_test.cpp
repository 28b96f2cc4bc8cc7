#include <gtest/gtest.h>

#include "core/offline/refinement.hpp"
#include "core/view/candidate_views.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

const std::string housing = NEXTVIEW_SOURCE_DIR "/assets/objects/slotted_housing.ply";

/// Views of an object that nothing was fitted to.
RefinementJob views_of(const std::string& object, int width, int views) {
  Configuration c = small_scan();
  c.object.file = object;
  c.sensor.width = width, c.sensor.height = width * 3 / 4;
  c.map.resolution = 0.02;
  c.evaluation.surface_samples = 300;
  CandidateViewsConfig around;
  around.layout = ViewLayout::fibonacci;
  around.count = views;
  return refinement_job(c, candidate_views(around, Vector3::Zero()));
}

/// A voxel of each kind of truth, as a posterior that says different things of touch and centre.
struct TwoReadOuts {
  RefinementTruth truth;
  GibbsPosterior posterior;

  TwoReadOuts() {
    const VoxelGrid grid{0.1, {0, 0, 0}, {2, 1, 1}};
    truth.voxels = {grid, BitMask(2), BitMask(2), BitMask(2)};
    truth.voxels.touch.set(0);
    for (const std::size_t v : {0u, 1u}) truth.voxels.near_surface.set(v);
    truth.visited = {1, 1};
    posterior.grid = grid;
    posterior.occupied = {0.3f, 0.3f}, posterior.informed = {1, 1};
    posterior.touch = {0.9f, 0.1f}, posterior.centre = {0.2f, 0.05f};
  }
};

TEST(PosteriorScores, EachTruthHasItsReadOut) {
  const TwoReadOuts t;
  const MapScores s = *score_posterior(t.posterior, {}, t.truth);
  EXPECT_NEAR(s.touch_band.log_loss, -std::log(0.9), 1e-6);
  EXPECT_NEAR(s.touch_visited.log_loss, -std::log(0.9), 1e-6);
  EXPECT_NEAR(s.centre_band.log_loss, -0.5 * (std::log(0.8) + std::log(0.95)), 1e-6);
  EXPECT_NEAR(s.centre_visited.log_loss, -0.5 * (std::log(0.8) + std::log(0.95)), 1e-6);
  EXPECT_EQ(s.surface_recall, 1.0);
  EXPECT_FALSE(score_posterior(t.posterior, {}, std::nullopt));
}

TEST(PosteriorScores, AMapOfOneProbabilityIsScoredByIt) {
  const TwoReadOuts t;
  const auto voxels = t.posterior.centre_voxels({});
  const MapScores one = *score_map(VoxelBricks(t.posterior.grid.size, voxels), t.truth);
  const MapScores both = score_map(voxels, voxels, t.truth);
  EXPECT_EQ(one.touch_band.log_loss, both.touch_band.log_loss);
  EXPECT_EQ(one.centre_band.log_loss, both.centre_band.log_loss);
  EXPECT_EQ(one.surface_recall, 0.0);
}

TEST(PosteriorScores, OpeningsAreOfTheCentreReadOut) {
  RefinementJob job = views_of(housing, 80, 4);
  ASSERT_FALSE(job.truth->openings.empty());
  GibbsPosterior posterior = refine(job).posterior;
  posterior.centre.assign(posterior.centre.size(), 0.9f);
  EXPECT_EQ(score_posterior(posterior, job.model, job.truth)->openings.open_rows, 0u);
  posterior.centre.assign(posterior.centre.size(), 0.1f);
  posterior.touch.assign(posterior.touch.size(), 0.9f);
  EXPECT_GT(score_posterior(posterior, job.model, job.truth)->openings.open_rows, 0u);
}

// Near the surface, at a density of few and of many rays a voxel: it would not be worth its weights otherwise. Not so
// where walls lie right on the voxels' borders, as those of the slotted housing do here.
TEST(PosteriorScores, TheFittedReadOutSaysMoreThanTheLevels) {
  for (const int width : {80, 320}) {
    RefinementJob job = views_of("gearbox", width, 6);
    const MapScores fitted = *refine(job).scores_after;
    job.sampler.read_out = ReadOut::levels;
    job.sampler.model.independence = 1.0;
    const MapScores levels = *refine(job).scores_after;
    EXPECT_LT(fitted.touch_band.log_loss, 0.8 * levels.touch_band.log_loss) << width;
    EXPECT_LT(fitted.centre_band.log_loss, 0.5 * levels.centre_band.log_loss) << width;
    EXPECT_LT(fitted.touch_band.calibration_error, 0.05) << width;
  }
}

}  // namespace
}  // namespace nextview
