#include "core/gain/new_surface_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/unit/gain/evidence_maps.hpp"

namespace nextview {
namespace {

using Kind = SurfaceEvidence::Kind;

std::vector<double> values(const NewSurfaceModel& model) {
  std::vector<double> all(model.unmeasured.begin(), model.unmeasured.end());
  all.insert(all.end(), model.free.begin(), model.free.end());
  all.insert(all.end(), model.occupied.begin(), model.occupied.end());
  all.push_back(model.mean_slant);
  all.push_back(model.slant.edge_on);
  all.push_back(model.slant.face_on);
  all.push_back(model.left_at_border);
  return all;
}

TEST(NewSurfaceModel, EverySettingIsACoefficientOfItsOwn) {
  NewSurfaceModel probe;
  const std::size_t count = values(probe).size();
  std::set<std::string> keys;
  std::set<std::size_t> changed;
  for (std::size_t s = 0; s < settings(probe).size(); ++s) {
    NewSurfaceModel model = NewSurfaceModel::fitted();
    Setting setting = settings(model)[s];
    EXPECT_TRUE(setting.key.starts_with("new_surface.")) << setting.key;
    EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
    EXPECT_FALSE(setting.help.empty()) << setting.key;
    EXPECT_NO_THROW(setting.require_in_bounds()) << setting.key;
    setting.set("3.25");
    EXPECT_NE(model, NewSurfaceModel::fitted()) << setting.key;
    std::set<std::size_t> of_it;
    for (std::size_t k = 0; k < count; ++k)
      if (values(model)[k] != values(NewSurfaceModel::fitted())[k]) of_it.insert(k);
    ASSERT_EQ(of_it.size(), 1u) << setting.key;
    EXPECT_EQ(values(model)[*of_it.begin()], 3.25) << setting.key;
    changed.merge(of_it);
  }
  EXPECT_EQ(changed.size(), count) << "a coefficient has no setting";
}

TEST(NewSurfaceModel, NoSurfaceIsSmallerThanWhatLiesAcrossTheRays) {
  NewSurfaceModel model;
  auto all = settings(model);
  Setting& slant = *std::ranges::find(all, "new_surface.slant", &Setting::key);
  slant.set("1");
  EXPECT_NO_THROW(slant.require_in_bounds());
  slant.set("0.99");
  EXPECT_ANY_THROW(slant.require_in_bounds());
}

TEST(NewSurfaceModel, ComesBackFromItsSettings) {
  NewSurfaceModel fitted = NewSurfaceModel::fitted(), made;
  fitted.unmeasured[3] = 0.1 + 0.2;  // has no short text
  auto from = settings(fitted), to = settings(made);
  for (std::size_t s = 0; s < from.size(); ++s) to[s].set(from[s].text());
  EXPECT_EQ(made, fitted);
}

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

template <std::size_t n>
double score(const std::array<double, n>& coefficients, const std::array<float, n>& features) {
  double sum = 0.0;
  for (std::size_t k = 0; k < n; ++k) sum += coefficients[k] * double(features[k]);
  return sum;
}

TEST(NewSurfaceModel, ChancesAreThoseOfItsComments) {
  std::mt19937 random(1);
  const auto made = evidence_maps::random_map(random, {16, 13, 11}, 0.15, 0.5);
  const SurfaceEvidence evidence = made.evidence();
  NewSurfaceModel model = NewSurfaceModel::fitted();
  model.unmeasured[0] = 1.0;  // so that neither 0 nor 1 is all there is
  std::size_t kinds[3] = {};
  for (const Eigen::Vector3i& cell : evidence_maps::cells(evidence)) {
    const double chance = model.chance(evidence, cell);
    ++kinds[std::size_t(evidence.kind(cell))];
    if (!evidence.may_hold_surface(cell)) {
      EXPECT_EQ(chance, 0.0);
    } else if (evidence.kind(cell) == Kind::unmeasured) {
      // A rate per object size, along one voxel's edge.
      const double rate = std::exp(score(model.unmeasured, evidence.unmeasured(cell))) / evidence.size();
      EXPECT_NEAR(chance, 1.0 - std::exp(-rate), 1e-6);
    } else if (evidence.kind(cell) == Kind::free) {
      EXPECT_NEAR(chance, logistic(score(model.free, evidence.measured(cell))), 1e-6);
    } else {
      EXPECT_NEAR(chance, -logistic(score(model.occupied, evidence.measured(cell))), 1e-6);
    }
  }
  for (const std::size_t count : kinds) EXPECT_GT(count, 100u);
}

TEST(NewSurfaceModel, HoweverLargeTheCoefficientsAChanceIsOne) {
  std::mt19937 random(2);
  const auto made = evidence_maps::random_map(random, {9, 9, 9}, 0.3, 0.5);
  const SurfaceEvidence evidence = made.evidence();
  for (const double large : {1000.0, -1000.0}) {
    NewSurfaceModel model;
    model.unmeasured.fill(large), model.free.fill(large), model.occupied.fill(large);
    for (const Eigen::Vector3i& cell : evidence_maps::cells(evidence)) {
      const float chance = model.chance(evidence, cell);
      ASSERT_TRUE(chance >= -1.0f && chance <= 1.0f) << chance;
      if (evidence.kind(cell) == Kind::occupied)
        EXPECT_LT(chance, 0.0f) << "nothing goes through";
      else
        EXPECT_GE(chance, 0.0f);
    }
  }
}

TEST(NewSurfaceModel, TheFittedOneExpectsMoreWhereLessIsKnown) {
  evidence_maps::MadeMap made({30, 28, 26});
  made.set_box({0, 6, 7}, {9, 19, 18}, -1.5);
  made.set_box({10, 8, 9}, {10, 17, 16}, 1.25);
  const SurfaceEvidence evidence = made.evidence();
  const NewSurfaceModel model = NewSurfaceModel::fitted();
  const auto chance = [&](int x, int y, int z) {
    return model.chance(evidence, evidence_maps::in_evidence(evidence, made.map.grid(), {x, y, z}));
  };
  EXPECT_GT(chance(11, 12, 12), chance(13, 12, 12)) << "farther from the surface";
  EXPECT_GT(model.slant.face_on, 0.0);
  EXPECT_GT(model.slant.edge_on, model.slant.face_on) << "the flatter surface is met the more of it there is";
  EXPECT_LT(model.slant.edge_on, 3.0);
  EXPECT_GT(model.mean_slant, 1.0) << "no surface is smaller than what lies across a ray";
  EXPECT_GT(model.occupied.back(), 0.0) << "where the scanned surface goes on";
  EXPECT_GT(model.free.back(), 0.0);
}

}  // namespace
}  // namespace nextview
