// The best views are valued again by finer rays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/gain/map_rays.hpp"
#include "core/planner/new_surface_policy.hpp"
#include "core/planner/planner.hpp"
#include "tests/unit/planner/drilled_block.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

struct TwiceValued : Policy {
  TwiceValued(std::vector<double> coarse, std::vector<double> fine)
      : coarse_(std::move(coarse)), fine_(std::move(fine)) {}
  Valuation values(const PlanningState&, std::span<const std::size_t> available, std::stop_token) const override {
    return {of(coarse_, available)};
  }
  std::vector<double> finer_values(const PlanningState&, std::span<const std::size_t> candidates,
                                   std::stop_token) const override {
    again.emplace_back(candidates.begin(), candidates.end());
    return fine_.empty() ? fine_ : of(fine_, candidates);
  }
  mutable std::vector<std::vector<std::size_t>> again;

 private:
  static std::vector<double> of(const std::vector<double>& all, std::span<const std::size_t> some) {
    std::vector<double> values;
    for (const std::size_t v : some) values.push_back(all[v]);
    return values;
  }
  std::vector<double> coarse_, fine_;
};

struct Planned {
  Plan plan;
  std::vector<std::vector<std::size_t>> again;
};

Planned planned(std::vector<double> coarse, std::vector<double> fine, const std::vector<std::size_t>& taken = {}) {
  PlannerConfig config;
  config.weights = {1.0, 0.0};
  const RayBundle bundle;
  std::vector<Candidate> candidates(coarse.size());
  for (const std::size_t v : taken) candidates[v].available = false;
  const std::vector<View> views(coarse.size());
  auto policy = std::make_unique<TwiceValued>(std::move(coarse), std::move(fine));
  const TwiceValued& asked = *policy;
  const OneStepPlanner planner(std::move(policy));
  Plan plan = planner.plan({config, 1, 60.0, 4.0, bundle, nullptr}, {}, views, std::move(candidates), {});
  return {std::move(plan), asked.again};
}

std::vector<double> gains_of(const Plan& plan) {
  std::vector<double> all;
  for (const Candidate& c : plan.candidates) all.push_back(c.gain);
  return all;
}

TEST(FinerValues, AreAskedForUntilTheBestTwoStayTheBestTwo) {
  // 1 and 2 come first by chance; 3 follows, then 0; 4 never does.
  const Planned found = planned({85, 100, 95, 90, 70}, {80, 60, 50, 88, 1000});
  EXPECT_EQ(found.plan.ranking.best, 3u);
  ASSERT_EQ(found.again.size(), 2u);
  EXPECT_THAT(found.again[0], ElementsAre(1, 2));
  EXPECT_THAT(found.again[1], UnorderedElementsAre(3, 0));
  EXPECT_THAT(gains_of(found.plan), ElementsAre(80, 60, 50, 88, 70));
  EXPECT_EQ(found.plan.ranking.reason.substr(0, 12), "Candidate 3:");
}

TEST(FinerValues, OfTheBestTwoAreEnoughWhereTheyConfirmThem) {
  const Planned found = planned({10, 100, 95, 20}, {99, 97, 96, 99});
  EXPECT_EQ(found.plan.ranking.best, 1u);
  EXPECT_THAT(found.again, ElementsAre(ElementsAre(1, 2)));
  EXPECT_THAT(gains_of(found.plan), ElementsAre(10, 97, 96, 20));
}

TEST(FinerValues, OfViewsThatWereTakenAreNotAskedFor) {
  const Planned found = planned({10, 100, 95, 20}, {9, 97, 96, 19}, {1, 2, 0});
  EXPECT_THAT(found.again, ElementsAre(ElementsAre(3)));
  EXPECT_EQ(found.plan.ranking.best, 3u);
  EXPECT_TRUE(planned({1, 2}, {1, 2}, {0, 1}).again.empty()) << "none is left";
}

TEST(FinerValues, LeaveTheValuesAsTheyAreWhereThereAreNone) {
  const Planned found = planned({10, 100, 95, 20}, {});
  EXPECT_THAT(gains_of(found.plan), ElementsAre(10, 100, 95, 20));
  EXPECT_EQ(found.again.size(), 1u);
}

TEST(FinerValues, OfNewSurfaceAreNearerToWhatVeryManyRaysSay) {
  const auto made = drilled_block::block({{Vector3::UnitX(), 0.03, 0.1}, {Vector3::UnitZ(), 0.02, 0.2}});
  Knowledge known;
  known.map = made.map;
  const PlannerConfig config;
  const MapRays rays(known.map.grid(), known.map.voxels(), 0.5, config.ray_length);
  const PinholeCamera camera = PinholeCamera::from_field_of_view(160, 120, 1.0);
  std::vector<View> views;
  for (int i = 0; i < 12; ++i)
    views.push_back({look_at(Vector3(0.8 * std::cos(i), 0.8 * std::sin(i), 0.1 * i - 0.3), Vector3::Zero())});
  std::vector<std::size_t> all(views.size());
  std::iota(all.begin(), all.end(), 0);
  const NewSurfacePolicy policy(config.new_surface);
  const RayBundle coarse = RayBundle::regular(camera, 20, 15);
  const auto by = [&](int times) {
    const RayBundle fine = RayBundle::regular(camera, 20 * times, 15 * times);
    PlanningState state{config, 1, 60.0, known, rays, coarse, nullptr, views, {}};
    EXPECT_TRUE(policy.finer_values(state, all, {}).empty()) << "no finer rays";
    state.fine_bundle = &fine;
    const auto values = policy.finer_values(state, all, {});
    EXPECT_EQ(policy.finer_values(state, std::vector<std::size_t>{7}, {}), std::vector<double>{values.at(7)});
    return values;
  };
  const auto few = by(1), more = by(4), very_many = by(24);
  double off_few = 0.0, off_more = 0.0;
  for (std::size_t v = 0; v < all.size(); ++v) {
    EXPECT_GT(very_many[v], 0.0);
    off_few += std::abs(few[v] - very_many[v]);
    off_more += std::abs(more[v] - very_many[v]);
  }
  EXPECT_LT(off_more, 0.5 * off_few);
}

}  // namespace
}  // namespace nextview
