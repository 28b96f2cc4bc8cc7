#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

std::vector<int> views_of(const Session& session) {
  std::vector<int> views;
  for (const StepRecord& r : session.records()) views.push_back(r.view);
  return views;
}

Configuration with_gain(const std::string& gain, Semantics semantics = Semantics::published) {
  Configuration c = small_scan();
  c.planner.gain = gain;
  c.planner.semantics = semantics;
  c.termination.views = 3;
  return c;
}

TEST(SessionGains, EveryGainAndBaselineRuns) {
  for (const auto& [gain, summary, baseline, make] : policies())
    for (const Semantics semantics : {Semantics::published, Semantics::reference}) {
      if ((baseline || gain.ends_with("gibbs")) && semantics == Semantics::reference) continue;
      Session session(with_gain(gain, semantics));
      finish(session);
      const auto views = views_of(session);
      EXPECT_EQ(std::set<int>(views.begin(), views.end()).size(), 3u) << gain;
      double largest = 0.0;
      for (const StepRecord& r : session.records())
        for (const Candidate& c : r.candidates) {
          EXPECT_TRUE(std::isfinite(c.gain) && std::isfinite(c.utility)) << gain;
          largest = std::max(largest, c.gain);
        }
      EXPECT_GT(largest, 0.0) << gain << " is nothing all the time";
      EXPECT_FALSE(summary.empty()) << gain;
    }
}

TEST(SessionGains, ExplanationsAreThoseOfTheRanking) {
  for (const auto& [gain, summary, baseline, make] : policies())
    for (const Semantics semantics : {Semantics::published, Semantics::reference}) {
      if ((baseline || gain.ends_with("gibbs")) && semantics == Semantics::reference) continue;
      Configuration c = with_gain(gain, semantics);
      c.planner.ray_refinement = 1;
      Session session(c);
      session.step();
      for (std::size_t v = 0; v < session.candidates().size(); v += 3) {
        const auto why = session.explain(v);
        ASSERT_EQ(why.has_value(), gain != "combined" && !baseline) << gain;
        if (why) {
          const double ranked = session.records()[0].candidates[v].gain;
          EXPECT_NEAR(why->value, ranked, 1e-12 * ranked) << gain;
        }
      }
    }
}

TEST(SessionGains, OfTheBestTwoIsWhatFinerRaysExplain) {
  Session session(with_gain("new-surface"));
  for (int step = 0; step < 2; ++step) {
    session.step();
    const StepRecord& r = session.records().back();
    const std::size_t best = r.ranking.best.value(), second = runner_up(r.candidates, best).value();
    for (std::size_t v = 0; v < session.candidates().size(); ++v) {
      if (!r.candidates[v].available) continue;
      const ScoreExplanation why = session.explain(v).value();
      EXPECT_EQ(why.rays.size(), 48u * 36u) << "four times 12 x 9 each way";
      const double gain = r.candidates[v].gain;
      EXPECT_NEAR(why.value, gain, (v == best || v == second ? 1e-9 : 0.5) * gain);
    }
  }
}

TEST(SessionGains, FixedOrderGoesThroughTheListAndNoCostSaysOtherwise) {
  Session session(with_gain("fixed-order"));
  finish(session);
  EXPECT_EQ(views_of(session), (std::vector<int>{-1, 0, 1}));
}

TEST(SessionGains, FarthestIsFarthestFromAllViewsTaken) {
  Configuration c = with_gain("farthest");
  c.termination.views = 6;
  Session session(c);
  finish(session);
  for (std::size_t i = 1; i < 6; ++i) {
    const auto distance = [&](const Pose& view) {
      double nearest = 1e9;
      for (std::size_t k = 0; k < i; ++k)
        nearest = std::min(nearest, (session.records()[k].T_world_camera.translation() - view.translation()).norm());
      return nearest;
    };
    for (const Pose& candidate : session.candidates())
      EXPECT_LE(distance(candidate), distance(session.records()[i].T_world_camera) + 1e-12);
  }
}

TEST(SessionGains, RandomDependsOnTheSeedAlone) {
  std::set<std::vector<int>> different;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Configuration c = with_gain("random");
    c.seed = seed;
    Session a(c), b(c);
    finish(a);
    finish(b);
    EXPECT_EQ(views_of(a), views_of(b));
    different.insert(views_of(a));
  }
  EXPECT_GE(different.size(), 6u);
}

TEST(SessionGains, TheOracleCountsSamplesThatNoViewHasSeen) {
  Session session(with_gain("oracle"));
  std::set<std::uint32_t> seen;
  while (session.finished().empty()) {
    const Pose view = session.next_view();
    session.step();
    for (const std::uint32_t s : session.known_object()->samples_seen(view)) seen.insert(s);
    const StepRecord& r = session.records().back();
    for (std::size_t v = 0; v < r.candidates.size(); ++v) {
      if (!r.candidates[v].available) continue;
      double expected = 0;
      for (const std::uint32_t s : session.known_object()->samples_seen(session.candidates()[v]))
        expected += !seen.contains(s);
      EXPECT_EQ(r.candidates[v].gain, expected) << v;
    }
  }
}

// The views of the cover come first, and together they see all that any candidate sees.
TEST(SessionGains, CoveringOrderCoversFirst) {
  Configuration c = with_gain("covering-order");
  c.views.count = 30;
  const Session session(c);
  const KnownObject& object = *session.known_object();
  const auto order = object.sight().covering_order(c.seed);
  EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), 30u);
  std::set<std::uint32_t> all, covered;
  for (const Pose& view : session.candidates())
    for (const std::uint32_t s : object.samples_seen(view)) all.insert(s);
  std::size_t needed = 0;
  while (covered.size() < all.size())
    for (const std::uint32_t s : object.samples_seen(session.candidates()[order.at(needed++)])) covered.insert(s);
  EXPECT_LE(needed, 14u);  // a box shows itself to eight corners
  EXPECT_EQ(object.sight().covering_order(c.seed), order);
}

TEST(SessionGains, CombinedWithOneGainRanksAsThatGain) {
  for (const Semantics semantics : {Semantics::published, Semantics::reference}) {
    Configuration combined = with_gain("combined", semantics), alone = with_gain("occlusion-aware", semantics);
    combined.planner.combined_weights = "occlusion-aware=3";
    Session a(combined), b(alone);
    a.step();
    b.step();
    double total = 0.0;
    for (const Candidate& x : b.records()[0].candidates) total += x.gain;
    for (std::size_t v = 0; v < 10; ++v)
      EXPECT_NEAR(a.records()[0].candidates[v].gain,
                  (semantics == Semantics::published ? 3.0 : 1.0) * b.records()[0].candidates[v].gain / total, 1e-12);
    EXPECT_EQ(a.next_candidate(), b.next_candidate());
  }
}

TEST(SessionGains, OcclusionIsMarkedWhereAGainWantsIt) {
  const auto marked = [](const Configuration& c) {
    Session session(c);
    session.step();
    return std::any_of(session.map().voxels().begin(), session.map().voxels().end(),
                       [](const Voxel& v) { return v.occlusion_distance > 0; });
  };
  EXPECT_TRUE(marked(with_gain("proximity-count")));
  EXPECT_TRUE(marked(with_gain("area-factor")));
  Configuration combined = with_gain("combined");
  combined.planner.combined_weights = "proximity-count=1,occlusion-aware=1";
  EXPECT_TRUE(marked(combined));
  EXPECT_FALSE(marked(with_gain("occlusion-aware")));
}

}  // namespace
}  // namespace nextview
