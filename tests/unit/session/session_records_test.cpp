// A step's record, worked out again from the scans, the map and the candidates.
#include <gtest/gtest.h>

#include "core/gain/view_score.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

/// Some of its surface no candidate sees.
Configuration housing() {
  Configuration c = small_scan();
  c.object.file = NEXTVIEW_SOURCE_DIR "/assets/objects/slotted_housing.ply";
  c.evaluation.surface_samples = 500;
  return c;
}

/// Share of the samples, or of those that `visible` marks, with a point of the first `steps` scans within d_reg.
double coverage(const Session& session, std::size_t steps, double d_reg, std::span<const std::uint8_t> visible) {
  const auto& points = session.known_object()->samples().points;
  std::size_t counted = 0, covered = 0;
  for (std::size_t s = 0; s < points.size(); ++s) {
    if (!visible.empty() && !visible[s]) continue;
    ++counted;
    bool found = false;
    for (std::size_t k = 0; k < steps && !found; ++k)
      for (const Eigen::Vector3f& p : session.scans()[k]->hits)
        if ((p - points[s]).cast<double>().norm() <= d_reg) {
          found = true;
          break;
        }
    covered += found;
  }
  return double(covered) / double(counted);
}

TEST(SessionRecords, CoverageIsOfTheCloudSoFar) {
  Session session(housing());
  finish(session);
  const auto visible = session.known_object()->visible();
  for (std::size_t i = 0; i < session.records().size(); ++i) {
    const StepRecord& r = session.records()[i];
    EXPECT_EQ(r.coverage, coverage(session, i + 1, 0.02, {}));
    EXPECT_EQ(r.coverage_visible, coverage(session, i + 1, 0.02, visible));
    EXPECT_EQ(r.coverage_paper, coverage(session, i + 1, 0.0005, {}));
    EXPECT_LT(r.coverage_paper, r.coverage);
    EXPECT_NE(r.coverage, r.coverage_visible);
  }
}

// Eq. 13 over the candidates that are left, from where the camera stands after the step.
TEST(SessionRecords, UtilityWeighsGainAgainstTheWay) {
  for (const auto& [gain, weights] : {std::pair("occlusion-aware", UtilityWeights{0.7, 0.2}),
                                      {"proximity-count", UtilityWeights{1.0, 2.0}},
                                      {"farthest", UtilityWeights{0.7, 0.2}}}) {
    Configuration c = small_scan();
    c.planner.gain = gain;
    c.planner.weights = weights;
    const UtilityWeights expected =
        policy_entry(gain).baseline ? UtilityWeights{1.0, 0.0} : weights;  // a policy of its own
    Session session(c);
    finish(session);
    for (const StepRecord& r : session.records()) {
      double gains = 0.0, ways = 0.0, best = -1e9;
      const auto way = [&](std::size_t v) {
        return (session.candidates()[v].translation() - r.T_world_camera.translation()).norm();
      };
      for (std::size_t v = 0; v < r.candidates.size(); ++v)
        if (r.candidates[v].available) gains += r.candidates[v].gain, ways += way(v);
      for (std::size_t v = 0; v < r.candidates.size(); ++v) {
        const Candidate& candidate = r.candidates[v];
        EXPECT_NEAR(candidate.cost, way(v), 1e-12);
        if (!candidate.available) continue;
        const double utility = expected.gain * candidate.gain / gains - expected.cost * way(v) / ways;
        EXPECT_NEAR(candidate.utility, utility, 1e-12) << gain;
        best = std::max(best, utility);
      }
      ASSERT_TRUE(r.ranking.best.has_value());
      EXPECT_TRUE(r.candidates[*r.ranking.best].available);
      EXPECT_NEAR(r.candidates[*r.ranking.best].utility, best, 1e-12) << gain;
    }
  }
}

// Candidates are ranked on the map with the step's measurement in it, and on no other.
TEST(SessionRecords, GainsAreOfTheMapAfterTheStep) {
  Configuration c = small_scan();
  c.planner.gain = "occlusion-aware";
  Session session(c);
  const RayBundle bundle = RayBundle::regular(session.camera(), c.planner.ray_columns, c.planner.ray_rows);
  const Gain* one = &gain("occlusion-aware");
  while (session.finished().empty()) {
    session.step();
    const MapRays rays(session.map().grid(), session.map().voxels(), c.map.model.occupancy_threshold,
                       c.planner.ray_length);
    const auto scores = score_views(rays, session.candidates(), bundle, {&one, 1});
    const StepRecord& r = session.records().back();
    for (std::size_t v = 0; v < scores.size(); ++v) {
      EXPECT_EQ(r.candidates[v].gain, r.candidates[v].available ? scores[v].gains.front() : 0.0) << v;
    }
  }
}

// The map is that of all scans, each inserted once, in the order in which they came.
TEST(SessionRecords, TheMapIsThatOfTheScans) {
  Session session(small_scan());
  OccupancyMap map(session.map().grid(), session.map().model());
  while (session.finished().empty()) {
    session.step();
    map.insert(*session.scans().back());
    EXPECT_EQ(session.scans().back()->max_range, session.configuration().sensor.max_range);
    EXPECT_TRUE(same_map_but_for_occlusions(map, session.map()));
    EXPECT_EQ(session.scans().back()->origin, session.records().back().T_world_camera.translation());
  }
}

TEST(SessionRecords, QualityIsOfTheVisitedVoxels) {
  Configuration c = housing();
  c.planner.gain = "gibbs";
  c.termination.views = 2;
  Session session(c);
  finish(session);
  const StepRecord& r = session.records().back();
  const GroundTruth& truth = session.known_object()->truth();
  const auto score = [&](const VoxelBricks& voxels, ScoredSet set) {
    return map_quality(voxels, truth, TruthConvention::touch, std::span(&set, 1), session.evaluation()->visited_voxels)
        .front();
  };
  EXPECT_TRUE(same_quality(r.quality, score(session.map().voxels(), ScoredSet::visited)));
  EXPECT_TRUE(same_quality(r.quality_near_surface, score(session.map().voxels(), ScoredSet::visited_band)));
  EXPECT_TRUE(
      same_quality(r.refinement->quality_near_surface, score(session.refinement()->voxels(), ScoredSet::visited_band)));
  std::size_t changed = 0;
  for (std::size_t v = 0; v < session.map().voxels().size(); ++v)
    changed += session.map().voxels()[v].voxel_class != session.refinement()->voxels()[v].voxel_class;
  EXPECT_EQ(r.refinement->changed_class, changed);
}

// As many sweeps per view as are asked for; 0 means until stationary.
TEST(SessionRecords, SweepsAreThoseThatWereAskedFor) {
  for (const int sweeps : {5, 12, 0}) {
    Configuration c = small_scan();
    c.planner.gain = "gibbs";
    c.termination.views = 2;
    c.gibbs.view_sweeps = sweeps;
    c.gibbs.sampler.sweeps = 64;
    Session session(c);
    finish(session);
    for (const StepRecord& r : session.records()) {
      const SamplerDiagnostics& d = r.refinement->diagnostics;
      if (sweeps > 0) {
        EXPECT_EQ(d.sweeps, sweeps);
      } else {
        EXPECT_TRUE(d.stationary || d.sweeps > 64 - 4) << d.sweeps;
      }
      EXPECT_EQ(d.log_posterior.size(), std::size_t(c.gibbs.sampler.chains));
      for (const auto& trace : d.log_posterior) EXPECT_EQ(trace.size(), std::size_t(d.sweeps));
    }
  }
}

/// Spearman's: the correlation of the ranks, ties sharing theirs.
double spearman(const std::vector<double>& a, const std::vector<double>& b) {
  const auto ranks = [](const std::vector<double>& x) {
    std::vector<double> result;
    for (const double v : x) {
      double rank = 0.0;
      for (const double other : x) rank += other < v ? 1.0 : other == v ? 0.5 : 0.0;
      result.push_back(rank);
    }
    return result;
  };
  const auto x = ranks(a), y = ranks(b);
  const double middle = 0.5 * double(x.size());
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i)
    xy += (x[i] - middle) * (y[i] - middle), xx += (x[i] - middle) * (x[i] - middle),
        yy += (y[i] - middle) * (y[i] - middle);
  return xy / std::sqrt(xx * yy);
}

TEST(SessionRecords, BothRankingsAreComparedOverTheCandidatesLeft) {
  Configuration c = small_scan();
  c.planner.gain = "gibbs";
  c.planner.weights = {1.0, 0.0};
  Session session(c);
  finish(session);
  for (const StepRecord& r : session.records()) {
    std::vector<double> refined, conventional;
    std::size_t best = 0;
    for (std::size_t v = 0; v < r.candidates.size(); ++v) {
      if (!r.candidates[v].available) continue;
      refined.push_back(r.candidates[v].gain);
      conventional.push_back(r.refinement->conventional_gains[v]);
      if (conventional.size() == 1 || conventional.back() > r.refinement->conventional_gains[best]) best = v;
    }
    EXPECT_NEAR(r.refinement->rank_correlation, spearman(refined, conventional), 1e-9);
    EXPECT_EQ(r.refinement->conventional_best, best);
  }
}

/// After how many views a scan with this criterion ends, and why.
std::size_t views_taken(const Configuration& c, const std::string& reason) {
  Session session(c);
  finish(session);
  EXPECT_NE(session.finished().find(reason), std::string::npos) << session.finished();
  return session.records().size();
}

// Each criterion ends the scan after the view after which the records say so.
TEST(SessionRecords, TheScanEndsWhenTheRecordsSaySo) {
  Configuration c = small_scan();
  c.termination.views = 9;
  Session free_run(c);
  finish(free_run);
  const auto& records = free_run.records();
  const auto best_gain = [&](std::size_t i) {
    double best = 0.0;
    for (const Candidate& candidate : records[i].candidates)
      if (candidate.available) best = std::max(best, candidate.gain);
    return best;
  };
  const double voxels = double(free_run.map().voxels().size());
  const auto ends = [&](const Configuration& ended, const char* reason, auto met) {
    std::size_t first = 0;
    while (first < records.size() && !met(first)) ++first;
    ASSERT_GT(first, 0u) << reason;
    ASSERT_LT(first + 1, records.size()) << reason;
    EXPECT_EQ(views_taken(ended, reason), first + 1) << reason;
  };
  for (const std::size_t at : {2u, 4u}) {
    Configuration by_gain = c, by_voxels = c, by_entropy = c, by_coverage = c;
    const double gain = 1.0001 * best_gain(at) / best_gain(0);
    by_gain.termination.gain = gain;
    ends(by_gain, "gain", [&](std::size_t i) { return best_gain(i) <= gain * best_gain(0); });
    const double share = 1.0001 * double(records[at].new_voxels) / voxels;
    by_voxels.termination.new_voxels = share;
    ends(by_voxels, "first time", [&](std::size_t i) { return double(records[i].new_voxels) < share * voxels; });
    const auto drop = [&](std::size_t i) { return i == 0 ? 1.0 : 1.0 - records[i].entropy / records[i - 1].entropy; };
    const double slope = 1.0001 * drop(at);
    by_entropy.termination.entropy_slope = slope;
    ends(by_entropy, "entropy", [&](std::size_t i) { return drop(i) < slope; });
    const double covered = 0.9999 * records[at].coverage_visible;
    by_coverage.termination.coverage = covered;
    ends(by_coverage, "coverage", [&](std::size_t i) { return records[i].coverage_visible >= covered; });
  }
}

}  // namespace
}  // namespace nextview
