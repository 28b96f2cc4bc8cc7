// Rays in lanes against rays one by one, on each instruction set that this processor has.
#include "core/gain/ray_lanes.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/gain/map_rays.hpp"
#include "core/gain/new_surface.hpp"
#include "core/gain/view_score.hpp"
#include "core/map/traversal.hpp"
#include "tests/unit/gain/evidence_maps.hpp"
#include "tests/unit/map/instruction_sets.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

using Eigen::Vector3i;
using evidence_maps::MadeMap;

/// The same rays, never in lanes.
class OneByOne : public RayCaster {
 public:
  explicit OneByOne(const MapRays& rays) : rays_(rays) {}
  void cast(const Vector3& origin, const Vector3& direction, std::vector<RayVoxel>& visited) const override {
    rays_.cast(origin, direction, visited);
  }

 private:
  const MapRays& rays_;
};

/// From outside, from inside, looking away, and along axes, on faces and edges between voxels.
std::vector<Pose> some_views(std::mt19937& random) {
  std::vector<Pose> views;
  for (int n = 0; n < 14; ++n) {
    const Vector3 position = (n % 4 == 3 ? 0.05 : 0.9) * random_scans::direction(random);
    views.push_back(look_at(position, n % 7 == 6 ? Vector3(2 * position) : random_scans::point_in_box(random, 0.2)));
  }
  for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, -1, 0), Vector3(1, 1, 0), Vector3(-1, 1, 1)})
    views.push_back(look_at(0.7 * axis, Vector3::Zero()));
  return views;
}

RayBundle bundle(int columns, int rows) {
  return RayBundle::regular(PinholeCamera::from_field_of_view(110, 80, 0.8), columns, rows);
}

/// Few different log-odds, as repeated scans leave them.
MadeMap scanned_map(std::mt19937& random, const Vector3i& size, double resolution) {
  MadeMap made(size, resolution);
  MadeMap::for_each(Vector3i::Zero(), size - Vector3i::Ones(), [&](const Vector3i& cell) {
    const auto kind = random() % 40;
    if (kind < 12) made.set(cell, -0.4 * double(1 + random() % 5));
    if (kind == 12) made.set(cell, 0.85 * double(1 + random() % 4));
  });
  for (const Vector3& from : random_scans::origins())
    made.map.mark_occlusions(random_scans::scan(random, from, resolution, 300), 0.3);
  return made;
}

class RayLanesOn : public OnInstructionSet {};
INSTANTIATE_TEST_SUITE_P(InstructionSets, RayLanesOn, instruction_sets(), instruction_set_name);

TEST_P(RayLanesOn, GainsAreThoseOfRaysOneByOneToTheLastBit) {
  std::mt19937 random(3);
  int compared = 0;
  for (const Vector3i& size : {Vector3i(40, 40, 40), Vector3i(33, 12, 21), Vector3i(1, 30, 9)}) {
    const MadeMap made = scanned_map(random, size, 0.02);
    for (const double max_range : {1.5, 0.8}) {
      const MapRays rays(made.map.grid(), made.map.voxels(), 0.5, max_range);
      const std::vector<Pose> views = some_views(random);
      for (const Gain& g : gains()) {
        const Gain* const one = &g;
        ASSERT_EQ(rays.worth_of_map(g, 60.0).has_value(), g.worth != nullptr) << g.name;
        const auto in_lanes = score_views(rays, views, bundle(13, 9), {&one, 1});
        const auto one_by_one = score_views(OneByOne(rays), views, bundle(13, 9), {&one, 1});
        for (std::size_t v = 0; v < views.size(); ++v) {
          EXPECT_EQ(in_lanes[v].gains, one_by_one[v].gains) << g.name << " of view " << v;
          EXPECT_EQ(in_lanes[v].rays, one_by_one[v].rays);
          EXPECT_LE(in_lanes[v].voxels, one_by_one[v].voxels);
          if (!g.weighs_visibility) {
            EXPECT_EQ(in_lanes[v].voxels, one_by_one[v].voxels) << g.name;
          }
          compared += g.worth && in_lanes[v].gains[0] != 0.0;
        }
      }
    }
  }
  EXPECT_GT(compared, 200);
}

// Where much is unknown, sums are full long before rays end: what is left out changes no bit.
TEST_P(RayLanesOn, RaysEndEarlyWhereNothingCanChangeTheirSum) {
  std::mt19937 random(4);
  const MadeMap made(Vector3i(150, 20, 20), 0.01);
  const MapRays rays(made.map.grid(), made.map.voxels(), 0.5, 3.0);
  const Pose view = look_at(Vector3(-1.2, 0.003, 0.004), Vector3::Zero());
  const Gain* const one = &gain("occlusion-aware");
  const auto in_lanes = score_views(rays, {&view, 1}, bundle(20, 20), {&one, 1});
  const auto one_by_one = score_views(OneByOne(rays), {&view, 1}, bundle(20, 20), {&one, 1});
  EXPECT_EQ(in_lanes[0].gains, one_by_one[0].gains);
  EXPECT_LT(in_lanes[0].voxels, one_by_one[0].voxels);
}

TEST_P(RayLanesOn, AnyNumberOfRays) {
  std::mt19937 random(5);
  const MadeMap made = scanned_map(random, {20, 25, 30}, 0.03);
  const MapRays rays(made.map.grid(), made.map.voxels(), 0.5, 1.5);
  const Gain* const one = &gain("unobserved-voxel");
  const Pose view = look_at(Vector3(0.8, 0.3, -0.4), Vector3::Zero());
  for (int count = 1; count < 80; ++count)
    EXPECT_EQ(score_views(rays, {&view, 1}, bundle(count, 1), {&one, 1})[0].gains,
              score_views(OneByOne(rays), {&view, 1}, bundle(count, 1), {&one, 1})[0].gains)
        << count;
}

// The sum of an explanation is made by the plain walk, in the same order.
TEST_P(RayLanesOn, NewSurfaceIsThatOfRaysOneByOneToTheLastBit) {
  std::mt19937 random(6);
  int compared = 0;
  for (const double unmeasured : {0.1, 0.6}) {
    const MadeMap made = evidence_maps::random_map(random, {37, 28, 31}, 0.05, unmeasured);
    const NewSurfaceField field(made.evidence(), NewSurfaceModel::fitted());
    const std::vector<Pose> views = some_views(random);
    for (const double length : {1.5, 0.75}) {
      const NewSurfaceOptions options{length, {2.5, 1.2}};
      const RayBundle rays = bundle(13, 9);
      const auto areas = expected_new_surface(field, views, rays, options);
      const auto forecast = forecast_new_surface(field, views, rays, options);
      for (std::size_t v = 0; v < views.size(); ++v) {
        const auto why = explain_new_surface(field, made.map.grid(), made.map.voxels(), views[v], rays, options);
        EXPECT_EQ(areas[v], why.value) << v;
        EXPECT_EQ(forecast.areas[v], why.value) << v;
        const auto voxels = new_surface_in_voxels(field, views[v], rays, options);
        std::size_t seen = 0;
        // Part by part, in the order of rays and voxels: single precision tells if it is another.
        std::vector<float> parts(forecast.most.size(), 0.0f);
        const Vector3i count = (field.grid().size + Vector3i::Constant(7)) / 8;
        for (std::size_t r = 0; r < why.rays.size(); ++r)
          for (const auto& voxel : why.rays[r].voxels) {
            const Vector3i cell = Vector3i(voxel.lattice[0], voxel.lattice[1], voxel.lattice[2]) - field.grid().first;
            ASSERT_LT(seen, voxels.size());
            EXPECT_TRUE(field.grid().cell_at(voxels[seen].middle) == cell);
            EXPECT_EQ(voxels[seen++].area, voxel.contribution);
            const Vector3i p = cell / 8;
            parts[std::size_t((p.z() * count.y() + p.y()) * count.x() + p.x())] += float(voxel.contribution);
          }
        EXPECT_EQ(seen, voxels.size());
        for (std::size_t p = 0; p < parts.size(); ++p)
          EXPECT_NEAR(forecast.parts[v][p], parts[p], 1e-5f * (1 + parts[p])) << v << ", " << p;
        compared += areas[v] != 0.0;
      }
    }
  }
  EXPECT_GT(compared, 40);
}

// States are numbered by whichever thread meets them first.
TEST(RayLanes, AreTheSameOnAnyNumberOfThreads) {
  std::mt19937 random(7);
  const MadeMap made = scanned_map(random, {40, 40, 40}, 0.02);
  const std::vector<Pose> views = some_views(random);
  const Gain* const one = &gain("proximity-count");
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const MapRays rays(made.map.grid(), made.map.voxels(), 0.5, 1.5);
    std::vector<std::vector<double>> values;
    for (const ViewScore& score : score_views(rays, views, bundle(20, 15), {&one, 1})) values.push_back(score.gains);
    return values;
  };
  const auto expected = run(1);
  for (const std::size_t threads : {2, 5}) EXPECT_EQ(run(threads), expected) << threads;
}

/// That a map's voxels are in as many states as `kept` says, and are scored as rays one by one score them.
void expect_same_scores(const VoxelGrid& grid, const VoxelBricks& voxels,
                        decltype(StateField::bytes) StateField::*bytes,
                        decltype(StateField::shorts) StateField::*shorts, std::mt19937& random) {
  const MapRays rays(grid, voxels, 0.5, 1.5);
  const std::vector<Pose> views = some_views(random);
  for (const Gain& g : gains()) {
    if (!g.worth) continue;
    const StateField field = rays.worth_of_map(g, 60.0)->field;
    EXPECT_EQ((field.*(bytes ? bytes : &StateField::bytes)).empty(), bytes == nullptr) << g.name;
    EXPECT_EQ((field.*(shorts ? shorts : &StateField::shorts)).empty(), shorts == nullptr) << g.name;
    const Gain* const one = &g;
    const auto in_lanes = score_views(rays, views, bundle(13, 9), {&one, 1});
    const auto one_by_one = score_views(OneByOne(rays), views, bundle(13, 9), {&one, 1});
    for (std::size_t v = 0; v < views.size(); ++v) EXPECT_EQ(in_lanes[v].gains, one_by_one[v].gains) << g.name << v;
    EXPECT_GT(in_lanes[0].gains[0], 0.0) << g.name;
  }
}

/// Measured voxels in `count` states, and unmeasured ones.
MadeMap map_in_states(std::mt19937& random, const Vector3i& size, int count) {
  MadeMap made(size);
  MadeMap::for_each(Vector3i::Zero(), size - Vector3i::Ones(), [&](const Vector3i& cell) {
    const int state = int(random() % std::uint32_t(count));
    if (random() % 5 != 0) made.set(cell, state < count / 10 ? 0.01 * (state + 1) : -3.0 * (state + 1) / count);
  });
  for (const Vector3& from : random_scans::origins())
    made.map.mark_occlusions(random_scans::scan(random, from, 0.02, 300), 0.3);
  return made;
}

// A byte a voxel, two, or a place of its own: a map that was seen often is in more states than a new one.
TEST_P(RayLanesOn, HoweverManyStatesVoxelsAreIn) {
  std::mt19937 random(8);
  const MadeMap few = map_in_states(random, {20, 20, 20}, 80), many = map_in_states(random, {20, 20, 20}, 1000),
                most = map_in_states(random, {48, 48, 48}, 100'000);
  expect_same_scores(few.map.grid(), few.map.voxels(), &StateField::bytes, nullptr, random);
  expect_same_scores(many.map.grid(), many.map.voxels(), nullptr, &StateField::shorts, random);
  expect_same_scores(most.map.grid(), most.map.voxels(), nullptr, nullptr, random);
}

// Places share the brick of what nobody has seen, and at the grid's edges only a part of it is in the grid.
TEST_P(RayLanesOn, BricksThatPlacesShare) {
  std::mt19937 random(10);
  MadeMap made({44, 20, 21});
  MadeMap::for_each(Vector3i(33, 0, 0), Vector3i(36, 19, 20), [&](const Vector3i& cell) { made.set(cell, -2.0); });
  made.map.mark_occlusions(random_scans::scan(random, random_scans::origins().front(), 0.02, 20), 0.1);
  expect_same_scores(made.map.grid(), made.map.voxels(), &StateField::bytes, nullptr, random);
}

// As of a Gibbs map, whose probabilities and entropies follow from nothing.
TEST_P(RayLanesOn, VoxelsThatAreToldAsTheyAre) {
  std::mt19937 random(9);
  const MadeMap made = map_in_states(random, {20, 25, 30}, 50);
  std::vector<Voxel> voxels = made.map.voxels().dense();
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  for (Voxel& voxel : voxels) {
    if (!voxel.measured) continue;
    voxel.probability = random() % 9 == 0 ? 1.0f : 0.6f * uniform(random);
    voxel.entropy = uniform(random);
  }
  expect_same_scores(made.map.grid(), {made.map.grid().size, voxels}, nullptr, nullptr, random);
}

}  // namespace
}  // namespace nextview
