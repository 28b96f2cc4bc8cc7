#include "core/planner/policy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace nextview {
namespace {

using testing::HasSubstr;

Pose at(double x, double y, double z) { return look_at(Vector3(x, y, z), Vector3::Zero()); }

/// Every ray meets one unmeasured voxel behind a surface, then an occupied one.
struct TwoVoxels : RayCaster {
  void cast(const Vector3&, const Vector3&, std::vector<RayVoxel>& visited) const override {
    RayVoxel hidden, wall;
    hidden.occlusion_distance = 3;
    wall.measured = true;
    wall.probability = 0.9f;
    wall.entropy = static_cast<float>(entropy(0.9));
    wall.voxel_class = VoxelClass::occupied;
    visited = {hidden, wall};
  }
};

struct KnownSurface : TrueSurface {
  std::size_t new_samples(std::size_t candidate) const override { return 10 * candidate; }
  std::vector<std::uint32_t> unseen_samples(std::size_t candidate) const override {
    std::vector<std::vector<std::uint32_t>> all = {{}, {0, 1, 2, 3}, {0, 1, 4}, {2, 3, 5}};
    return all[candidate];
  }
  std::size_t visible_samples() const override { return 50; }
  std::vector<std::size_t> covering_order(std::uint64_t) const override { return {2, 0, 3, 1}; }
};

struct Policies : ::testing::Test {
  std::vector<double> values(const Policy& policy) const { return policy.values(state(), available, {}).gains; }
  PlanningState state() const { return {config, seed, 60.0, known, rays, bundle, &surface, candidates, taken}; }
  std::unique_ptr<Policy> made(const std::string& name) {
    config.gain = name;
    return make_policy(config);
  }

  PlannerConfig config;
  std::uint64_t seed = 1;
  Knowledge known;
  TwoVoxels rays;
  RayBundle bundle{{Vector3::UnitZ(), Vector3(0, 0.6, 0.8)}, {0.01, 0.01}};
  KnownSurface surface;
  std::vector<View> candidates = {{at(1, 0, 0)}, {at(0, 1, 0)}, {at(0, 0, 1)}, {at(-1, 0, 0)}};
  std::vector<TakenView> taken = {{{}, at(1, 0, 0.1)}};
  std::vector<std::size_t> available = {1, 2, 3};
};

TEST_F(Policies, HaveNamesOfTheirOwnAndSayWhatTheyAre) {
  std::set<std::string> names;
  for (const PolicyEntry& entry : policies()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_FALSE(entry.summary.empty()) << entry.name;
    const auto policy = made(entry.name);
    EXPECT_TRUE(!policy->gain() || policy->no_explanation().empty()) << entry.name;
    EXPECT_EQ(policy->explain(state(), candidates[1].T_world_camera).has_value(), policy->no_explanation().empty())
        << entry.name;
    EXPECT_EQ(policy->ignores_cost(), entry.baseline) << entry.name << ": the way has no say in a baseline";
    EXPECT_FALSE(entry.baseline && policy->needs().posterior) << entry.name;
  }
  EXPECT_EQ(names.size(), gains().size() + 10);
}

// It remembers what the last map said: not of another, nor of the same after a scan.
TEST_F(Policies, NewSurfaceIsOfTheMapThatIsAskedAbout) {
  const auto scanned_from = [](double x) {
    Scan scan{{x, 0.3, 0.2}, {}, {}, 3.0};
    for (int i = 0; i < 40; ++i) scan.hits.emplace_back(0.01f * float(i % 8), 0.01f * float(i / 8), 0.0f);
    return scan;
  };
  const auto with = [&](std::initializer_list<double> scans) {
    Knowledge some;
    some.map = OccupancyMap(region_of_interest(Vector3::Zero(), 0.4, 0.02));
    for (const double x : scans) some.map.insert(scanned_from(x));
    return some;
  };
  const auto remembering = made("new-surface");
  const Knowledge one = with({0.5}), two = with({0.5, -0.5});
  std::set<std::vector<double>> different;
  for (const Knowledge& next : {one, two, one, one, with({}), two}) {
    known = next;
    const std::vector<double> fresh = values(*made("new-surface"));
    EXPECT_EQ(values(*remembering), fresh);
    EXPECT_EQ(remembering->explain(state(), candidates[1].T_world_camera)->value, fresh[0]);
    different.insert(fresh);
  }
  known.map.insert(scanned_from(0.1));
  EXPECT_EQ(values(*remembering), values(*made("new-surface")));
  const std::vector<double> without_border = values(*remembering);
  auto scanned = std::make_shared<ScannedSurface>(0.01);
  scanned->add(scanned_from(0.5), Vector3::UnitZ(), 1e-6);
  known.scanned = std::move(scanned);
  EXPECT_EQ(values(*remembering), values(*made("new-surface")));
  EXPECT_NE(values(*remembering), without_border) << "the surface goes on at its border";
  EXPECT_EQ(different.size(), 3u) << "they tell nothing apart";
}

TEST_F(Policies, UnknownOnesAreRefusedWithTheNamesThereAre) {
  for (const char* bad : {"", "oracel", "Random"}) try {
      made(bad);
      ADD_FAILURE() << bad;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr("covering-order"));
    }
}

TEST_F(Policies, SayWhatTheyNeed) {
  EXPECT_TRUE(made("proximity-count")->needs().occlusions);
  EXPECT_FALSE(made("occlusion-aware")->needs().occlusions);
  EXPECT_TRUE(made("gibbs")->needs().posterior && made("new-surface-gibbs")->needs().posterior);
  EXPECT_FALSE(made("new-surface")->needs().posterior);
  EXPECT_TRUE(made("oracle")->needs().true_surface && made("covering-order")->needs().true_surface);
  config.combined_weights = "area-factor=1";
  EXPECT_TRUE(made("combined")->needs().occlusions);
  config.combined_weights = "average-entropy=1";
  EXPECT_FALSE(made("combined")->needs().occlusions || made("combined")->needs().posterior);
  config.combined_weights = "average-entropy=1,gibbs=1";
  EXPECT_TRUE(made("combined")->needs().posterior);
}

TEST_F(Policies, BaselinesByHand) {
  EXPECT_EQ(values(*made("fixed-order")), (std::vector<double>{3, 2, 1}));
  EXPECT_EQ(values(*made("oracle")), (std::vector<double>{10, 20, 30}));
  EXPECT_EQ(values(*made("covering-order")), (std::vector<double>{1, 4, 2}));
  // Views 2 and 3 see all six samples; view 1 sees most, and is not needed.
  EXPECT_EQ(values(*made("set-cover")), (std::vector<double>{4, 53, 53}));
  const auto far = values(*made("farthest"));
  ASSERT_EQ(far.size(), 3u);
  EXPECT_NEAR(far[0], std::sqrt(2.01), 1e-12);
  EXPECT_NEAR(far[1], std::sqrt(1.0 + 0.81), 1e-12);
  EXPECT_NEAR(far[2], std::sqrt(4.01), 1e-12);
  taken.clear();
  EXPECT_EQ(values(*made("farthest")), (std::vector<double>{0, 0, 0}));
}

TEST_F(Policies, RandomDrawsByTheSeedAndAnewAtEachStep) {
  const auto random = made("random");
  const auto first = values(*random);
  EXPECT_EQ(values(*random), first);
  taken.push_back({{}, at(0, -1, 0)});
  const auto next = values(*random);
  EXPECT_NE(next, first);
  seed = 2;
  EXPECT_NE(values(*random), next);
  available = {3};
  EXPECT_NE(values(*random).front(), first.front()) << "a number of each candidate's own";
}

TEST_F(Policies, AGainIsItsVolumetricInformationAndExplained) {
  const double of_unmeasured = entropy(0.5), of_wall = entropy(static_cast<double>(0.9f));
  const auto policy = made("occlusion-aware");
  const auto found = values(*policy);
  for (const double value : found) EXPECT_NEAR(value, 2.0 * (of_unmeasured + 0.5 * of_wall), 1e-6);
  const auto why = policy->explain(state(), candidates[1].T_world_camera);
  ASSERT_TRUE(why);
  EXPECT_DOUBLE_EQ(why->value, found[0]);
  EXPECT_EQ(values(*made("proximity-count")), (std::vector<double>{114, 114, 114}));  // 60 - 3 on each of two rays
  for (const char* without : {"combined", "random"})
    EXPECT_FALSE(made(without)->explain(state(), candidates[1].T_world_camera));
}

TEST_F(Policies, CombinedWeighsSharesOfEachGain) {
  config.combined_weights = "proximity-count=2,rear-side-voxel=3";
  for (const double value : values(*made("combined"))) EXPECT_NEAR(value, (2.0 + 3.0) / 3.0, 1e-12);
}

/// As an exercise: a policy of one's own is a class, and ranks like any other.
struct Highest : Policy {
  Valuation values(const PlanningState& s, std::span<const std::size_t> left, std::stop_token) const override {
    std::vector<double> heights;
    for (const std::size_t v : left) heights.push_back(s.candidates[v].T_world_camera.translation().z());
    return heights;
  }
  std::string unit() const override { return "m"; }
};

TEST_F(Policies, OneOfOnesOwnRanksLikeAnyOther) { EXPECT_EQ(values(Highest()), (std::vector<double>{0, 1, 0})); }

}  // namespace
}  // namespace nextview
