// The sentence that says why a view was chosen.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/planner/planner.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;
using testing::Not;

struct GivenValues : Policy {
  explicit GivenValues(std::vector<double> values) : all(std::move(values)) {}
  std::string unit() const override { return "nats"; }
  Valuation values(const PlanningState&, std::span<const std::size_t> available, std::stop_token) const override {
    std::vector<double> some;
    for (const std::size_t v : available) some.push_back(all[v]);
    return {some, left, remaining};
  }
  std::vector<double> all;
  std::optional<double> left;
  std::vector<std::size_t> remaining;
};

Ranking ranked(const std::vector<double>& values, std::vector<Candidate> candidates, const PlannerConfig& config = {},
               std::optional<double> surface_left = {}, const std::vector<std::size_t>& remaining = {},
               std::size_t most_views = 100, const VoxelGrid& region = {}, double negligible = 0.005) {
  const RayBundle bundle;
  auto policy = std::make_unique<GivenValues>(values);
  policy->left = surface_left, policy->remaining = remaining;
  const OneStepPlanner planner(std::move(policy));
  std::vector<View> views(values.size());
  for (std::size_t v = 0; v < views.size(); ++v) views[v].T_world_camera.translation().x() = double(v);
  Knowledge known;
  if (region.voxel_count() > 0) known.map = OccupancyMap(region);
  known.taken.emplace_back();  // at the origin
  return planner
      .plan({config, 1, 60.0, 4.0, bundle, nullptr, negligible, nullptr, most_views}, known, views,
            std::move(candidates), {})
      .ranking;
}

Candidate at(double metres, bool available = true) { return {available, 0.0, metres, 0.0}; }

TEST(Reason, NamesTheChoiceAndTheRunnerUp) {
  const Ranking ranking = ranked({10, 300, 250, 999}, {at(0.5), at(0.9), at(0.4), at(0.1, false)});
  EXPECT_EQ(ranking.best, 1u);
  EXPECT_EQ(ranking.reason, "Candidate 1: gain 300 nats; 0.9 m away. Runner-up 2: 250 nats, 0.4 m.");
}

TEST(Reason, WithoutOthersNamesTheOneAndWithoutAnySaysNothing) {
  EXPECT_EQ(ranked({10, 20}, {at(1, false), at(2)}).reason, "Candidate 1: gain 20 nats; 2 m away.");
  EXPECT_EQ(ranked({10}, {at(1, false)}).reason, "");
}

TEST(Reason, SaysWhereTheGainHardlyTellsThemApart) {
  const Ranking near_ties = ranked({1000.1, 1000.2, 1000.3, 500}, {at(0.2), at(1), at(2), at(3)});
  EXPECT_EQ(near_ties.best, 0u) << "the nearest";
  EXPECT_THAT(near_ties.reason, HasSubstr(" 3 of 4 gain the same within 0.1 %: the way there decides."));
  EXPECT_EQ(near_ties.degenerate, "");
  EXPECT_THAT(ranked({1000, 1000, 980, 500}, {at(0.2), at(1), at(2), at(3)}).reason, Not(HasSubstr("decides")))
      << "half of them are not most";
  EXPECT_THAT(ranked({1000, 1000}, {at(0.2), at(1)}).reason, HasSubstr(" 2 of 2 gain the same"));
  EXPECT_THAT(ranked({1000, 980}, {at(0.2), at(1)}).reason, Not(HasSubstr("decides")));
  EXPECT_THAT(ranked({0, 0}, {at(0.2), at(1)}).reason, Not(HasSubstr("decides"))) << "nothing is to be gained";
  EXPECT_THAT(ranked({1000, 990, 980, 500}, {at(0.2), at(1), at(2), at(3)}).reason, Not(HasSubstr("decides")));
}

TEST(Reason, SaysHowMuchIsExpectedToBeLeft) {
  EXPECT_EQ(ranked({10, 20}, {at(1, false), at(2)}, {}, 0.0372).reason,
            "Candidate 1: gain 20 nats; 2 m away. About 3.7 % of the surface is left.");
}

TEST(Reason, SaysWhichWayTheRestWouldTake) {
  const std::vector<Candidate> all = {at(0, false), at(1), at(2), at(3)};
  EXPECT_THAT(ranked({0, 10, 20, 30}, all, {}, 0.1, {3, 1}).reason,
              HasSubstr(" About 10 % of the surface is left: 2 views, 3 m."));
  EXPECT_THAT(ranked({0, 10, 20, 30}, all, {}, 0.004, {2}).reason,
              HasSubstr(" About 0.4 % of the surface is left: 1 view, 2 m."));
}

TEST(Reason, SaysNoViewsForTheLastCrumbs) {
  const std::vector<Candidate> all = {at(0, false), at(1), at(2), at(3)};
  const auto reason = [&](double left) { return ranked({0, 10, 20, 30}, all, {}, left, {2, 3}, 100, {}, 0.0).reason; };
  EXPECT_TRUE(reason(0.004).ends_with(" About 0.4 % of the surface is left."));
  EXPECT_THAT(reason(0.01), HasSubstr(" About 1 % of the surface is left: 2 views, 3 m."));
}

TEST(Reason, SaysWhereTheLimitOfViewsEndsTheScanBefore) {
  const std::vector<Candidate> all = {at(0, false), at(1), at(2), at(3)};
  const auto reason = [&](std::size_t most_views) {  // one is taken
    return ranked({0, 10, 20, 30}, all, {}, 0.1, {3, 1}, most_views).reason;
  };
  EXPECT_THAT(reason(2), HasSubstr(" is left: 2 views, 3 m; the limit of 2 views leaves 1."));
  EXPECT_THAT(reason(3), HasSubstr(" is left: 2 views, 3 m.")) << "all of them are within it";
  EXPECT_THAT(reason(1), HasSubstr(" is left: 2 views, 3 m.")) << "it has ended, and says so itself";
}

TEST(Reason, SaysWhoIsPassedOverForRegistration) {
  std::vector<Candidate> all = {at(1), at(1), at(1)};
  all[2].overlaps = false;
  EXPECT_THAT(ranked({10, 20, 30}, all).reason,
              HasSubstr("Candidate 1: gain 20 nats; 1 m away. Runner-up 0: 10 nats, 1 m. One candidate is better, but "
                        "would show too little of what was scanned to be registered with it."));
  all[1].overlaps = false;
  EXPECT_THAT(ranked({10, 20, 30}, all).reason, HasSubstr(" 2 candidates are better, but would show too little"));
  EXPECT_THAT(ranked({40, 20, 30}, all).reason, Not(HasSubstr("registered")));
  all[0].overlaps = false;
  EXPECT_THAT(ranked({10, 20, 30}, all).reason, HasSubstr(" No candidate shows enough of what was scanned"));
}

TEST(Reason, AllWaysHaveOneUnitByTheSizeOfTheRegion) {
  const auto reason = [](double edge) {
    return ranked({10, 300, 150}, {at(0.5), at(1.25), at(0.4)}, {}, 0.1, {0, 2}, 100,
                  region_of_interest(Vector3::Zero(), edge, edge / 8))
        .reason;
  };
  EXPECT_THAT(reason(0.4),
              HasSubstr("1250 mm away. Runner-up 2: 150 nats, 400 mm. About 10 % of the surface is left: 2 "
                        "views, 2000 mm."));
  EXPECT_THAT(reason(1.2), HasSubstr("1.25 m away. Runner-up 2: 150 nats, 0.4 m. About 10 % of the surface is left: 2 "
                                     "views, 2 m."));
}

TEST(Reason, PerSecondTheWayCostsItsTime) {
  PlannerConfig config;
  config.utility = UtilityKind::gain_per_second;
  std::vector<Candidate> candidates = {at(1), at(2)};
  candidates[0].seconds = 1.0, candidates[1].seconds = 6.0;  // and 4 to scan
  const Ranking ranking = ranked({100, 150}, candidates, config);
  EXPECT_EQ(ranking.best, 0u) << "20 and 15 a second";
  EXPECT_THAT(ranking.reason, HasSubstr("1 m away, 20 nats a second."));
}

TEST(Reason, TheRunnerUpIsTheNextBestThatIsAvailable) {
  const std::vector<Candidate> candidates = {
      {true, 1, 1, 0.1}, {true, 1, 1, 0.3}, {false, 1, 1, 0.9}, {true, 1, 1, 0.2}};
  EXPECT_EQ(runner_up(candidates, 1), 3u);
  EXPECT_EQ(runner_up(candidates, 3), 1u);
  EXPECT_EQ(runner_up(std::span(candidates).first(1), 0), std::nullopt);
}

}  // namespace
}  // namespace nextview
