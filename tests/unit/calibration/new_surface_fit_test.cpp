#include "core/calibration/new_surface_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/random/counter_random.hpp"
#include "tests/unit/gain/evidence_maps.hpp"

namespace nextview {
namespace {

using Eigen::Vector3i;
using Kind = SurfaceEvidence::Kind;

NewSurfaceModel planted() {
  NewSurfaceModel model;
  model.unmeasured = {0.6, -0.5, 0.6, 0.2, -0.3, -0.2, -1.5, -1.0, 2.0};
  model.free = {-3.0, 0.5, 0.4, 0.6, 0.05, 0.4};
  model.occupied = {-0.5, -0.6, 0.2, 0.3, -0.04, 0.8};
  model.mean_slant = 1.6;
  return model;
}

/// Balls of different sizes, of which some of the surface is known, some is free in front, and some is hidden.
std::vector<SurfaceEvidence> made_up_maps() {
  std::vector<SurfaceEvidence> maps;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> log_odds(0.01, 1.9), uniform(0.0, 1.0);
  for (const int radius : {6, 9, 12}) {
    const Vector3i size = Vector3i::Constant(4 * radius);
    evidence_maps::MadeMap made(size);
    VoxelBricks occlusions(size);
    evidence_maps::MadeMap::for_each(Vector3i::Zero(), size - Vector3i::Ones(), [&](const Vector3i& cell) {
      const Vector3i from = cell - size / 2;
      const double outside = from.cast<double>().norm() - radius;
      if (from.x() + from.y() > radius / 2) return;  // not looked at
      if (outside < -1.0) {
        const std::size_t place = occlusions.place(cell.x(), cell.y(), cell.z());
        occlusions.change_brick_of(place).set_occlusion_distance(place % VoxelBricks::brick_voxels,
                                                                 static_cast<std::uint16_t>(std::lround(-outside)));
        return;
      }
      if (uniform(random) < 0.2) return;
      made.set(cell, (outside < 0.5 ? 1.0 : -1.0) * log_odds(random));
    });
    // The border of what is known, with gaps.
    OpenBorder border{{}, 0.5 * made.map.grid().resolution};
    for (int i = 0; i < 40; ++i)
      border.beyond.push_back(
          (made.map.grid().resolution * radius * Vector3(uniform(random) - 0.5, 0.5, uniform(random))).cast<float>());
    maps.emplace_back(made.map.grid(), made.map.voxels(), occlusions, 0.5, border);
  }
  return maps;
}

struct Observation {
  const SurfaceEvidence* evidence;
  Eigen::Vector3i voxel;
  double weight;
  bool found;
};

/// What rays find if the model is right, `draws` of them in each voxel.
std::vector<Observation> drawn(const std::vector<SurfaceEvidence>& maps, const NewSurfaceModel& model, int draws) {
  std::vector<Observation> all;
  for (std::size_t m = 0; m < maps.size(); ++m)
    for (const Eigen::Vector3i& v : evidence_maps::cells(maps[m])) {
      if (!maps[m].may_hold_surface(v)) continue;
      const double chance = std::abs(model.chance(maps[m], v));
      for (int draw = 0; draw < draws; ++draw) {
        const auto number = CounterRandom(7, std::uint32_t(m), std::uint32_t(draw)).uniform(maps[m].grid().index(v));
        all.push_back({&maps[m], v, 0.5 + number[1], number[0] < chance});
      }
    }
  return all;
}

NewSurfaceObservations added(std::span<const Observation> all, double unit = 1.0) {
  NewSurfaceObservations observations;
  for (const Observation& one : all) {
    observations.add(*one.evidence, one.voxel, unit * one.weight, one.found);
    if (one.found) observations.add_slant(unit * one.weight, 2.0 - 0.4 * (one.voxel.x() % 3));
  }
  return observations;
}

std::vector<double> coefficients(const NewSurfaceModel& model) {
  std::vector<double> all(model.unmeasured.begin(), model.unmeasured.end());
  all.insert(all.end(), model.free.begin(), model.free.end());
  all.insert(all.end(), model.occupied.begin(), model.occupied.end());
  all.push_back(model.mean_slant);
  return all;
}

void expect_near(const NewSurfaceModel& a, const NewSurfaceModel& b, double tolerance) {
  const auto all_a = coefficients(a), all_b = coefficients(b);
  for (std::size_t k = 0; k < all_a.size(); ++k) EXPECT_NEAR(all_a[k], all_b[k], tolerance) << k;
}

TEST(NewSurfaceFit, GivesTheChancesBackThatWerePlanted) {
  const auto maps = made_up_maps();
  const NewSurfaceModel model = planted(), fitted = added(drawn(maps, model, 12)).fit();
  std::array<double, 3> count{}, error{}, sum{}, fitted_sum{};
  for (const SurfaceEvidence& evidence : maps)
    for (const Eigen::Vector3i& v : evidence_maps::cells(evidence)) {
      if (!evidence.may_hold_surface(v)) continue;
      const double chance = std::abs(model.chance(evidence, v)), again = std::abs(fitted.chance(evidence, v));
      const auto kind = std::size_t(evidence.kind(v));
      ++count[kind], error[kind] += std::abs(again / chance - 1.0), sum[kind] += chance, fitted_sum[kind] += again;
    }
  for (std::size_t kind = 0; kind < 3; ++kind) {
    EXPECT_GT(count[kind], 500.0) << kind;
    EXPECT_LT(error[kind] / count[kind], 0.05) << kind;
    EXPECT_NEAR(fitted_sum[kind] / sum[kind], 1.0, 0.03) << kind;
  }
  EXPECT_NEAR(fitted.mean_slant, 1.6, 0.02);
}

TEST(NewSurfaceFit, DoesNotDependOnTheOrderOfTheRays) {
  const auto maps = made_up_maps();
  std::vector<Observation> all = drawn(maps, planted(), 2);
  const NewSurfaceObservations forwards = added(all);
  const std::size_t half = all.size() / 3;
  NewSurfaceObservations parts = added(std::span(all).subspan(half));
  parts.add(added(std::span(all).first(half)));
  std::ranges::reverse(all);
  const NewSurfaceObservations backwards = added(all);
  for (const NewSurfaceObservations& other : {parts, backwards}) {
    EXPECT_EQ(other.cells(), forwards.cells());
    for (const Kind kind : {Kind::unmeasured, Kind::free, Kind::occupied})
      EXPECT_NEAR(other.found(kind) / forwards.found(kind), 1.0, 1e-12);
    expect_near(other.fit(), forwards.fit(), 1e-7);
  }
  EXPECT_EQ(added(all).fit(), backwards.fit()) << "the same order, the same bytes";
}

TEST(NewSurfaceFit, WeightsHaveAnyUnit) {
  const auto maps = made_up_maps();
  const auto all = drawn(maps, planted(), 1);
  EXPECT_EQ(added(all, 1024.0).fit(), added(all).fit());  // a power of two: not even rounding differs
  expect_near(added(all, 1e-6).fit(), added(all).fit(), 1e-7);
}

TEST(NewSurfaceFit, WhatIsFoundIsCountedByKind) {
  const auto maps = made_up_maps();
  const auto all = drawn(maps, planted(), 1);
  std::array<double, 3> expected{};
  for (const Observation& one : all)
    if (one.found) expected[std::size_t(one.evidence->kind(one.voxel))] += one.weight;
  const NewSurfaceObservations observations = added(all);
  for (std::size_t kind = 0; kind < 3; ++kind)
    EXPECT_NEAR(observations.found(Kind(kind)), expected[kind], 1e-9 * expected[kind]);
  EXPECT_GT(observations.cells(), 100u);
  EXPECT_LT(observations.cells(), all.size()) << "some voxels are alike";
}

TEST(NewSurfaceFit, TheSlantIsAMeanByWeight) {
  const auto maps = made_up_maps();
  NewSurfaceObservations observations;
  for (const Observation& one : drawn(maps, planted(), 1))
    observations.add(*one.evidence, one.voxel, one.weight, one.found);
  observations.add_slant(2.0, 2.5);
  EXPECT_EQ(observations.fit().mean_slant, 2.5);
  observations.add_slant(6.0, 1.5);
  EXPECT_EQ(observations.fit().mean_slant, 1.75);
  EXPECT_EQ(observations.fit().slant, (SurfaceSlant{1.75, 1.75})) << "until views say more";
}

// A camera in the voxel has no area across its ray.
TEST(NewSurfaceFit, NoWeightIsNoObservation) {
  const auto maps = made_up_maps();
  const auto all = drawn(maps, planted(), 1);
  NewSurfaceObservations observations;
  for (const bool found : {false, true})
    for (const Eigen::Vector3i& v : evidence_maps::cells(maps[0]))
      if (maps[0].may_hold_surface(v)) observations.add(maps[0], v, 0.0, found);
  EXPECT_THROW(observations.fit(), std::invalid_argument);
  observations.add(added(std::span(all).last(all.size() / 2)));  // of another map: other cells
  EXPECT_EQ(observations.fit(), added(std::span(all).last(all.size() / 2)).fit());
}

TEST(NewSurfaceFit, NothingFoundIsRefused) {
  EXPECT_THROW(NewSurfaceObservations().fit(), std::invalid_argument);
  const auto maps = made_up_maps();
  const auto all = drawn(maps, planted(), 1);
  for (const Kind without : {Kind::unmeasured, Kind::free, Kind::occupied}) {
    std::vector<Observation> some = all;
    for (Observation& one : some) one.found &= one.evidence->kind(one.voxel) != without;
    EXPECT_THROW(added(some).fit(), std::invalid_argument);
    std::erase_if(some, [&](const Observation& one) { return one.evidence->kind(one.voxel) == without; });
    EXPECT_THROW(added(some).fit(), std::invalid_argument) << "nobody looked";
  }
}

// What is found everywhere, or as good as nowhere, has no finite likeliest chance; the pull keeps it in bounds.
TEST(NewSurfaceFit, CertaintiesStayFinite) {
  const auto maps = made_up_maps();
  std::vector<Observation> all = drawn(maps, planted(), 1);
  for (Observation& one : all) one.found = true;
  for (const double c : coefficients(added(all).fit())) EXPECT_TRUE(std::isfinite(c));
  std::array<bool, 3> found{};
  for (Observation& one : all) one.found = !std::exchange(found[std::size_t(one.evidence->kind(one.voxel))], true);
  const NewSurfaceModel rare = added(all).fit();
  for (const double c : coefficients(rare)) EXPECT_TRUE(std::isfinite(c));
  for (const Eigen::Vector3i& v : evidence_maps::cells(maps[0]))
    EXPECT_LT(std::abs(rare.chance(maps[0], v)), 0.2f) << "of thousands one was found";
}

}  // namespace
}  // namespace nextview
