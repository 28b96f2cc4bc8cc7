#include "core/offline/map_calibration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/view/candidate_views.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

/// `views` views of a part of ours, spread evenly around it.
RefinementJob seen(const std::string& part, int views, double max_range = 1.5) {
  Configuration c = small_scan();
  c.object.file = fmt::format("{}/assets/objects/{}.ply", NEXTVIEW_SOURCE_DIR, part);
  c.sensor.width = 40, c.sensor.height = 30, c.sensor.max_range = max_range;
  c.evaluation.surface_samples = 300;
  CandidateViewsConfig around;
  around.layout = ViewLayout::fibonacci;
  around.count = views;
  return refinement_job(c, candidate_views(around, Vector3::Zero()));
}

std::vector<CalibrationExample> sphere_and_box() {
  return {{seen("sphere", 3), false}, {seen("slotted_housing", 4), false}, {seen("box", 3), true}};
}

/// MapCalibrationConfig::band, from the definition. A voxel that the conventional map does not know has no history.
std::vector<std::uint32_t> scored_voxels(const Refinement& r, int band) {
  const GibbsPosterior& gibbs = r.posterior;
  std::vector<std::uint32_t> result, occupied;
  for (std::uint32_t v = 0; v < gibbs.occupied.size(); ++v)
    if (gibbs.informed[v] && gibbs.touch[v] >= 0.5f) occupied.push_back(v);
  for (std::uint32_t v = 0; v < gibbs.occupied.size(); ++v) {
    if (!gibbs.informed[v] || !r.conventional.voxels()[v].measured) continue;
    const auto near = [&](std::uint32_t other) {
      return (gibbs.grid.cell(v) - gibbs.grid.cell(other)).cwiseAbs().maxCoeff() <= band;
    };
    if (band == 0 || std::any_of(occupied.begin(), occupied.end(), near)) result.push_back(v);
  }
  return result;
}

OccupancyMap made_with(const InverseSensorModel& model, const RefinementJob& job) {
  OccupancyMap map(job.grid, model);
  for (const Scan& scan : job.scans) map.insert(scan);
  return map;
}

double cross_entropy(const OccupancyMap& map, const std::vector<float>& gibbs,
                     const std::vector<std::uint32_t>& voxels) {
  double sum = 0.0;
  for (const std::uint32_t v : voxels) {
    const double p = probability(map.log_odds(v)), g = gibbs[v];
    sum -= g * std::log(p) + (1.0 - g) * std::log(1.0 - p);
  }
  return sum / double(voxels.size());
}

void expect_reliability(const GibbsReliability& bins, const OccupancyMap& map, const std::vector<float>& gibbs,
                        const std::vector<std::uint32_t>& voxels) {
  std::size_t counted = 0;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    double p_sum = 0.0, g_sum = 0.0, count = 0.0;
    for (const std::uint32_t v : voxels) {
      const double p = map.voxels()[v].probability;
      if (p < 0.1 * double(b) || (b < 9 && p >= 0.1 * double(b + 1))) continue;
      ++count, p_sum += p, g_sum += gibbs[v];
    }
    EXPECT_EQ(bins[b].voxels, count) << b;
    EXPECT_NEAR(bins[b].mean_probability, count > 0 ? p_sum / count : 0.0, 1e-9) << b;
    EXPECT_NEAR(bins[b].occupied_share, count > 0 ? g_sum / count : 0.0, 1e-9) << b;
    counted += bins[b].voxels;
  }
  EXPECT_EQ(counted, voxels.size());
}

class Band : public ::testing::TestWithParam<int> {};

// Everything that is said of an example, computed anew from its scans.
TEST_P(Band, ScoresAreThoseOfMapsMadeAnew) {
  const std::vector<CalibrationExample> examples = sphere_and_box();
  MapCalibrationConfig config;
  config.band = GetParam();
  const MapCalibration found = calibrate_map(examples, config);
  EXPECT_EQ(found.before, examples.front().job.model);
  ASSERT_EQ(found.examples.size(), examples.size());
  double before = 0.0, after = 0.0, fitted = 0.0;
  for (std::size_t e = 0; e < examples.size(); ++e) {
    const RefinementJob& job = examples[e].job;
    const ExampleScores& s = found.examples[e];
    SCOPED_TRACE(s.name);
    EXPECT_EQ(s.name, job.name);
    EXPECT_EQ(s.views, job.scans.size());
    EXPECT_EQ(s.held_out, examples[e].held_out);
    const Refinement r = refine(job);
    const auto voxels = scored_voxels(r, config.band);
    ASSERT_GT(voxels.size(), 100u);
    EXPECT_EQ(s.voxels, voxels.size());
    const std::vector<float>& gibbs = r.posterior.touch;
    const OccupancyMap map_before = made_with(found.before, job), map_after = made_with(found.fit.model, job);
    EXPECT_NEAR(s.cross_entropy_before.value(), cross_entropy(map_before, gibbs, voxels), 1e-5);
    EXPECT_NEAR(s.cross_entropy_after.value(), cross_entropy(map_after, gibbs, voxels), 1e-5);
    double gibbs_entropy = 0.0;
    for (const std::uint32_t v : voxels) gibbs_entropy += entropy(gibbs[v]);
    EXPECT_NEAR(s.gibbs_entropy.value(), gibbs_entropy / double(voxels.size()), 1e-9);
    EXPECT_LE(s.gibbs_entropy, s.cross_entropy_after);
    expect_reliability(s.reliability_before, map_before, gibbs, voxels);
    expect_reliability(s.reliability_after, map_after, gibbs, voxels);
    ASSERT_TRUE(s.before && s.after && s.gibbs);
    EXPECT_EQ(s.before->touch_band.log_loss, score_map(map_before.voxels(), job.truth)->touch_band.log_loss);
    EXPECT_EQ(s.after->centre_visited.brier, score_map(map_after.voxels(), job.truth)->centre_visited.brier);
    EXPECT_EQ(s.gibbs->touch_band.log_loss, r.scores_after->touch_band.log_loss);
    if (s.held_out) continue;
    before += s.cross_entropy_before.value() * double(s.voxels);
    after += s.cross_entropy_after.value() * double(s.voxels);
    fitted += double(s.voxels);
  }
  EXPECT_NEAR(found.fit.cross_entropy_before, before / fitted, 1e-9) << "all voxels weigh the same";
  EXPECT_NEAR(found.fit.cross_entropy, after / fitted, 1e-9);
  EXPECT_LT(found.fit.cross_entropy, found.fit.cross_entropy_before);
}

INSTANTIATE_TEST_SUITE_P(MapCalibration, Band, ::testing::Values(0, 1, band_width));

TEST(MapCalibration, WhatIsHeldOutDoesNotEnterTheFit) {
  std::vector<CalibrationExample> examples = {{seen("sphere", 3), false}, {seen("box", 3), true}};
  const MapCalibration with = calibrate_map(examples, {});
  examples.pop_back();
  const MapCalibration without = calibrate_map(examples, {});
  EXPECT_EQ(with.fit.model, without.fit.model);
  EXPECT_EQ(with.fit.cross_entropy, without.fit.cross_entropy);
  examples.push_back({seen("box", 2), false});
  EXPECT_NE(calibrate_map(examples, {}).fit.model, without.fit.model);
}

TEST(MapCalibration, StartsFromTheFirstExamplesModelAndKeepsWhatIsNotFitted) {
  std::vector<CalibrationExample> examples = {{seen("sphere", 3), false}, {seen("box", 3), false}};
  examples[0].job.model.clamp_max = 0.9, examples[0].job.model.free_below = 0.25;
  MapCalibrationConfig config;
  config.fit.clamps = false;
  const MapCalibration found = calibrate_map(examples, config);
  EXPECT_EQ(found.before, examples[0].job.model);
  InverseSensorModel expected = examples[0].job.model;
  expected.hit = found.fit.model.hit, expected.miss = found.fit.model.miss;
  EXPECT_EQ(found.fit.model, expected);
}

TEST(MapCalibration, TheSameOnOneThreadAndTwo) {
  const auto run = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    MapCalibrationConfig config;
    config.fit.range_dependent = true;
    return calibrate_map(sphere_and_box(), config);
  };
  const MapCalibration one = run(1), two = run(2);
  EXPECT_EQ(one.fit.model, two.fit.model);
  EXPECT_TRUE(one.fit.model.range_dependent());
  for (std::size_t e = 0; e < one.examples.size(); ++e) {
    EXPECT_EQ(one.examples[e].cross_entropy_after, two.examples[e].cross_entropy_after);
    EXPECT_EQ(one.examples[e].gibbs_entropy, two.examples[e].gibbs_entropy);
  }
}

/// The reason; empty if nothing was thrown.
template <class Error>
std::string refused(std::vector<CalibrationExample> examples) {
  try {
    calibrate_map(std::move(examples), {});
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
}

TEST(MapCalibration, NothingToFitToIsAnError) {
  const RefinementJob sphere = seen("sphere", 2);
  EXPECT_NE(refused<std::invalid_argument>({}), "");
  EXPECT_NE(refused<std::invalid_argument>({{sphere, true}, {sphere, true}}).find("held out"), std::string::npos);
  // A camera that reaches nothing: no voxel is near what the Gibbs map calls occupied.
  const std::string blind = refused<std::invalid_argument>({{seen("sphere", 2, 0.3), false}, {sphere, true}});
  EXPECT_NE(blind.find("fit"), std::string::npos) << "no reason for people: " << blind;
  RefinementJob coarse = sphere;
  coarse.grid = region_of_interest(Vector3::Zero(), 1.28, 0.08);
  const std::string two = refused<std::invalid_argument>({{sphere, false}, {coarse, true}});
  EXPECT_NE(two.find("0.08"), std::string::npos) << two;
  EXPECT_NE(two.find("0.04"), std::string::npos) << two;
}

TEST(MapCalibration, AnExampleThatSawNothingHarmsNobody) {
  const RefinementJob sphere = seen("sphere", 3), blind = seen("box", 2, 0.3);
  const MapCalibration alone = calibrate_map({{sphere, false}}, {});
  for (const bool held_out : {false, true}) {
    const MapCalibration found = calibrate_map({{sphere, false}, {blind, held_out}}, {});
    EXPECT_EQ(found.fit.model, alone.fit.model);
    ASSERT_EQ(found.examples.size(), 2u);
    const ExampleScores& s = found.examples[1];
    EXPECT_EQ(s.voxels, 0u);
    EXPECT_TRUE(s.before && s.after && s.gibbs) << "the true surface is known";
    EXPECT_FALSE(s.cross_entropy_before || s.cross_entropy_after || s.gibbs_entropy) << "of no voxels there is none";
  }
}

// Whenever the stop comes: an error, and no half a calibration.
TEST(MapCalibration, AStopAtAnyMomentThrows) {
  const std::vector<CalibrationExample> examples = {{seen("sphere", 2), false}, {seen("box", 2), true}};
  std::vector<double> fractions;
  calibrate_map(examples, {}, [&](double fraction, std::string_view what) {
    EXPECT_FALSE(what.empty());
    fractions.push_back(fraction);
  });
  ASSERT_GT(fractions.size(), 10u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_LE(fractions.back(), 1.0);
  for (const std::size_t moment : {std::size_t{0}, std::size_t{3}, fractions.size() / 2, fractions.size() - 1}) {
    std::stop_source stop;
    std::size_t calls = 0;
    const Progress stop_there = [&](double, std::string_view) {
      if (calls++ == moment) stop.request_stop();
    };
    EXPECT_THROW(calibrate_map(examples, {}, stop_there, stop.get_token()), std::runtime_error) << moment;
  }
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_THROW(calibrate_map(examples, {}, {}, stopped.get_token()), std::runtime_error);
}

}  // namespace
}  // namespace nextview
