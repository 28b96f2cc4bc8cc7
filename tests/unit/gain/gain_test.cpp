#include "core/gain/gain.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/gain/view_score.hpp"
#include "tests/unit/gain/scripted_rays.hpp"

namespace nextview {
namespace {

double score(const ScriptedRays& rays, std::string_view name, Semantics semantics = Semantics::published) {
  const Gain* const one[] = {&gain(name)};
  const Pose view = Pose::Identity();
  return score_views(rays, {&view, 1}, rays.bundle(), one, {semantics, 60})[0].gains[0];
}

class BothSemantics : public testing::TestWithParam<Semantics> {};
INSTANTIATE_TEST_SUITE_P(Gains, BothSemantics, testing::Values(Semantics::published, Semantics::reference),
                         [](const auto& param) {
                           return param.param == Semantics::published ? "Published" : "Reference";
                         });

// Rays of every mixture of voxels, also such as no map gives: surfaces anywhere along a ray.
TEST_P(BothSemantics, EveryGainAgreesWithTheTable) {
  std::mt19937 random(11);
  std::map<std::string, int> not_zero;
  for (int view = 0; view < 400; ++view) {
    ScriptedRays rays;
    rays.rays.resize(1 + random() % 30);
    for (auto& ray : rays.rays)
      for (int n = random() % 12; n > 0; --n) ray.push_back(random_voxel(random));
    const auto expected = gain_twins::values(rays.rays, GetParam(), 60);
    for (const Gain& g : gains()) {
      const double found = score(rays, g.name, GetParam()), wanted = expected.at(std::string(g.name));
      ASSERT_NEAR(found, wanted, 1e-5 * (1 + std::abs(wanted))) << g.name << " of view " << view;
      not_zero[std::string(g.name)] += std::abs(wanted) > 1e-9;
    }
  }
  EXPECT_EQ(not_zero.size(), 8u);
  for (const auto& [name, count] : not_zero) EXPECT_GT(count, 100) << name;
}

TEST_P(BothSemantics, ExplanationsSumToTheScore) {
  std::mt19937 random(12);
  for (int view = 0; view < 60; ++view) {
    ScriptedRays rays;
    rays.rays.resize(1 + random() % 20);
    for (auto& ray : rays.rays)
      for (int n = random() % 12; n > 0; --n) ray.push_back(random_voxel(random));
    for (const Gain& g : gains()) {
      const ScoreExplanation why = explain_score(rays, Pose::Identity(), rays.bundle(), g, {GetParam(), 60});
      const double value = score(rays, g.name, GetParam());
      EXPECT_EQ(why.value, value) << g.name;
      ASSERT_EQ(why.rays.size(), rays.rays.size());
      double total = 0.0;
      for (std::size_t r = 0; r < why.rays.size(); ++r) {
        ASSERT_EQ(why.rays[r].voxels.size(), rays.rays[r].size());
        double part = 0.0;
        for (const auto& v : why.rays[r].voxels) part += v.contribution;
        EXPECT_NEAR(part, why.rays[r].contribution, 1e-9 * (1 + std::abs(part))) << g.name;
        total += why.rays[r].contribution;
      }
      EXPECT_NEAR(total, value, 1e-9 * (1 + std::abs(value))) << g.name;
    }
  }
}

TEST(Visibility, IsTheProductOfWhatTheSemanticsSay) {
  ScriptedRays rays;
  rays.rays = {{voxel(0.12, true), unmeasured(), voxel(0.4, true), voxel(0.97, true)}};
  const auto visibility = [&](Semantics semantics) {
    std::vector<double> found;
    const auto why = explain_score(rays, Pose::Identity(), rays.bundle(), gain("occlusion-aware"), {semantics, 60});
    for (const auto& v : why.rays[0].voxels) found.push_back(v.visibility);
    return found;
  };
  const std::vector<double> published = visibility(Semantics::published), reference = visibility(Semantics::reference);
  const std::vector<double> expected_published = {1.0, 0.88, 0.44, 0.264},
                            expected_reference = {1.0, 0.12, 0.06, 0.024};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(published[i], expected_published[i], 1e-6);
    EXPECT_NEAR(reference[i], expected_reference[i], 1e-6);
  }
}

// f is 0 at 0, 1 at alpha, and 0 at 1.
TEST(AreaFactor, IsHighestAtAFifthOccupiedAndFourFifthsOccluded) {
  const auto value = [](int occupied, int occluded, int unknown) {
    ScriptedRays rays;
    for (int n = 0; n < occupied; ++n) rays.rays.push_back({voxel(0.12, true), voxel(0.97, true)});
    for (int n = 0; n < occluded; ++n) rays.rays.push_back({voxel(0.12, true), unmeasured(3)});
    for (int n = 0; n < unknown; ++n) rays.rays.push_back({voxel(0.12, true), unmeasured()});
    return score(rays, "area-factor");
  };
  EXPECT_NEAR(value(1, 4, 0), 2.0, 1e-12);
  EXPECT_NEAR(value(1, 0, 4), 1.0, 1e-12);
  EXPECT_NEAR(value(0, 4, 1), 1.0, 1e-12);
  EXPECT_NEAR(value(5, 0, 0), 0.0, 1e-12);
  EXPECT_NEAR(value(0, 5, 0), 0.0, 1e-12);
  EXPECT_NEAR(value(0, 0, 5), 0.0, 1e-12);
  // Halfway up: f(alpha / 2) = 1/2; and f(0.6; 0.2) = [-0.432 + 1.296 - 0.72 + 0.6 - 1] / (-0.512) = 0.5.
  EXPECT_NEAR(value(1, 0, 9), 0.5, 1e-12);
  EXPECT_NEAR(value(3, 0, 2), 0.5, 1e-12);
  EXPECT_NEAR(value(0, 2, 3), 0.5, 1e-12);
  EXPECT_GT(value(1, 4, 0), value(2, 3, 0));
  EXPECT_GT(value(1, 4, 0), value(1, 3, 1));
}

TEST(AreaFactor, ReferenceForgetsNotWhatEarlierRaysHaveSeen) {
  ScriptedRays rays;  // a first voxel without a node, then a surface: counted until some ray has seen a node
  rays.rays = {{unmeasured(), voxel(0.97, true)}, {unmeasured(), voxel(0.97, true)}, {unmeasured()}};
  // The first counts as occupied, the second not at all, the third is unknown: f(1/2; 0.2).
  const double half = (-2 * 0.125 + 3 * 1.2 * 0.25 - 6 * 0.2 * 0.5 + 3 * 0.2 - 1) / (-0.8 * -0.8 * -0.8) * -1;
  EXPECT_NEAR(score(rays, "area-factor", Semantics::reference), -half, 1e-12);
}

TEST(Gains, AViewWithoutRaysOrVoxelsIsWorthNothing) {
  ScriptedRays none, empty;
  empty.rays.resize(5);
  for (const Gain& g : gains())
    for (const Semantics semantics : {Semantics::published, Semantics::reference}) {
      EXPECT_EQ(score(none, g.name, semantics), 0.0) << g.name;
      EXPECT_EQ(score(empty, g.name, semantics), 0.0) << g.name;
    }
}

TEST(Gains, AreFoundByName) {
  for (const Gain& g : gains()) {
    EXPECT_EQ(&gain(g.name), &g);
    EXPECT_FALSE(g.summary.empty());
    EXPECT_EQ(g.needs_occlusion, g.name == "proximity-count" || g.name == "area-factor");
  }
  for (const char* bad : {"", "occlusion_aware", "combined", "Occlusion-Aware"}) try {
      gain(bad);
      ADD_FAILURE() << bad;
    } catch (const std::invalid_argument& error) {
      for (const Gain& g : gains()) EXPECT_NE(std::string(error.what()).find(g.name), std::string::npos);
    }
}

TEST(Combine, PublishedNormalisesEachGain) {
  // Totals 10 and 4: 2 · (1, 3, 6) / 10 + 1 · (4, 0, 0) / 4.
  const std::vector<double> weights = {2, 1};
  const std::vector<std::vector<double>> values = {{1, 3, 6}, {4, 0, 0}};
  const std::vector<double> u = combine(weights, values, Semantics::published);
  ASSERT_EQ(u.size(), 3u);
  EXPECT_NEAR(u[0], 1.2, 1e-12);
  EXPECT_NEAR(u[1], 0.6, 1e-12);
  EXPECT_NEAR(u[2], 1.2, 1e-12);
}

TEST(Combine, ReferenceNormalisesTheSum) {
  // 2 · (1, 3, 6) + (4, 0, 0) = (6, 6, 12), of 24.
  const std::vector<double> weights = {2, 1};
  const std::vector<std::vector<double>> values = {{1, 3, 6}, {4, 0, 0}};
  const std::vector<double> u = combine(weights, values, Semantics::reference);
  ASSERT_EQ(u.size(), 3u);
  EXPECT_NEAR(u[0], 0.25, 1e-12);
  EXPECT_NEAR(u[1], 0.25, 1e-12);
  EXPECT_NEAR(u[2], 0.5, 1e-12);
}

TEST(Combine, WhatIsZeroEverywhereAddsZero) {
  const std::vector<double> weights = {30, 1};
  for (const Semantics semantics : {Semantics::published, Semantics::reference}) {
    const std::vector<std::vector<double>> one = {{0, 0}, {1, 3}}, none = {{0, 0}, {0, 0}};
    EXPECT_EQ(combine(weights, one, semantics), (std::vector<double>{0.25, 0.75}));
    EXPECT_EQ(combine(weights, none, semantics), (std::vector<double>{0, 0}));
    const std::vector<std::vector<double>> no_views = {{}, {}};
    EXPECT_TRUE(combine(weights, no_views, semantics).empty());
  }
}

TEST(Combine, ThePrereleaseWeightsAreThirtyToOne) {
  const auto weights = prerelease_weights();
  ASSERT_EQ(weights.size(), 2u);
  for (const auto& w : weights) {
    EXPECT_EQ(w.weight, w.name == "average-entropy" ? 30.0 : 1.0);
    EXPECT_NO_THROW(gain(w.name));
  }
}

}  // namespace
}  // namespace nextview
