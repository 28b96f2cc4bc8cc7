#include "core/gain/map_rays.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "core/gain/view_score.hpp"
#include "tests/unit/gain/scripted_rays.hpp"
#include "tests/unit/map/random_scans.hpp"
#include "tests/unit/map/slab_test.hpp"

namespace nextview {
namespace {

const VoxelGrid grid{0.05, {-6, -5, -7}, {12, 11, 13}};
constexpr double threshold = 0.5;

/// `surfaces`: the share of voxels that may stop a ray.
std::vector<Voxel> random_voxels(std::mt19937& random, double surfaces) {
  std::vector<Voxel> voxels(grid.voxel_count());
  std::bernoulli_distribution stops(surfaces);
  for (Voxel& v : voxels) {
    do v = random_voxel(random);
    while (v.measured && v.probability >= threshold && !stops(random));
    if (v.measured) v.occlusion_distance = 0;  // as maps have it
  }
  return voxels;
}

/// Which voxels a ray visits, by the slab test of each voxel of the grid.
gain_twins::VoxelsOfRay visited_by(const std::vector<Voxel>& voxels, const Vector3& origin, const Vector3& direction,
                                   double max_range) {
  std::vector<std::pair<double, std::uint32_t>> on_ray;
  for (std::uint32_t v = 0; v < voxels.size(); ++v) {
    const auto at = slab_test::overlap(grid, v, 0.0, origin, direction, max_range);
    if (at.length() > 1e-12) on_ray.push_back({at.enter, v});
  }
  std::sort(on_ray.begin(), on_ray.end());
  gain_twins::VoxelsOfRay ray;
  for (const auto& [enter, v] : on_ray) {
    RayVoxel& next = ray.emplace_back();
    static_cast<Voxel&>(next) = voxels[v];
    for (int k = 0; k < 3; ++k) next.lattice[k] = std::int16_t(grid.first[k] + grid.cell(v)[k]);
    if (next.measured && next.probability >= threshold) break;
  }
  return ray;
}

std::vector<Pose> random_views(std::mt19937& random, int count) {
  std::vector<Pose> views;  // outside, inside and looking away
  for (int n = 0; n < count; ++n) {
    const Vector3 position =
        n % 3 == 2 ? random_scans::point_in_box(random, 0.25) : Vector3(0.9 * random_scans::direction(random));
    const Vector3 target = n % 7 == 6 ? Vector3(2.0 * position) : random_scans::point_in_box(random, 0.2);
    views.push_back(look_at(position, target));
  }
  return views;
}

std::vector<const Gain*> all_gains() {
  std::vector<const Gain*> all;
  for (const Gain& g : gains()) all.push_back(&g);
  return all;
}

RayBundle bundle() { return RayBundle::regular(PinholeCamera::from_field_of_view(80, 60, 1.0), 9, 7); }

TEST(MapRays, VisitWhatTheSlabTestOfAllVoxelsFinds) {
  std::mt19937 random(1);
  const std::vector<Voxel> voxels = random_voxels(random, 0.2);
  std::size_t visits = 0, stopped = 0;
  for (const double max_range : {1.5, 0.8, 0.3}) {
    const MapRays rays(grid, {grid.size, voxels}, threshold, max_range);
    for (int n = 0; n < 500; ++n) {
      const Vector3 origin = random_scans::point_in_box(random, n % 2 ? 0.9 : 0.25);
      const Vector3 direction = (random_scans::point_in_box(random, 0.3) - origin).normalized();
      std::vector<RayVoxel> found(3);  // is overwritten
      rays.cast(origin, direction, found);
      const gain_twins::VoxelsOfRay expected = visited_by(voxels, origin, direction, max_range);
      ASSERT_EQ(found.size(), expected.size()) << n;
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].lattice, expected[i].lattice);
        ASSERT_EQ(found[i].probability, expected[i].probability);
        ASSERT_EQ(found[i].measured, expected[i].measured);
        ASSERT_EQ(found[i].occlusion_distance, expected[i].occlusion_distance);
        ASSERT_EQ(found[i].voxel_class, expected[i].voxel_class);
      }
      visits += found.size();
      stopped += !found.empty() && found.back().measured && found.back().probability >= threshold;
    }
  }
  EXPECT_GT(visits, 3000u);
  EXPECT_GT(stopped, 200u);
}

TEST(MapRays, UnmeasuredVoxelsStopNoRay) {
  const std::vector<Voxel> voxels(grid.voxel_count());  // all at 0.5, the threshold
  std::vector<RayVoxel> visited;
  MapRays(grid, {grid.size, voxels}, threshold, 3.0).cast(Vector3(-1, 0.01, 0.01), Vector3::UnitX(), visited);
  EXPECT_EQ(visited.size(), 12u);
}

TEST(MapRays, TheFirstMeasuredVoxelAtTheThresholdStops) {
  std::vector<Voxel> voxels(grid.voxel_count());
  const auto visits = [&] {
    std::vector<RayVoxel> visited;
    MapRays(grid, {grid.size, voxels}, threshold, 3.0).cast(Vector3(-1, 0.01, 0.01), Vector3::UnitX(), visited);
    return visited.size();
  };
  voxels[grid.index({8, 5, 7})] = voxel(0.5, true);
  EXPECT_EQ(visits(), 9u);
  voxels[grid.index({4, 5, 7})] = voxel(0.49, true);
  EXPECT_EQ(visits(), 9u);
  voxels[grid.index({4, 5, 7})] = voxel(0.97, true);
  EXPECT_EQ(visits(), 5u);
}

// The whole way: random maps, views and rays; the twin shares no traversal and no gain with the code.
TEST(ScoreViews, EveryGainAgreesWithTheTable) {
  std::mt19937 random(2);
  for (const double surfaces : {0.0, 0.05, 0.5}) {
    const std::vector<Voxel> voxels = random_voxels(random, surfaces);
    const std::vector<Pose> views = random_views(random, 14);
    const std::vector<const Gain*> asked = all_gains();
    for (const double max_range : {1.5, 0.7}) {
      const auto scores =
          score_views(MapRays(grid, {grid.size, voxels}, threshold, max_range), views, bundle(), asked, {});
      ASSERT_EQ(scores.size(), views.size());
      for (std::size_t v = 0; v < views.size(); ++v) {
        std::vector<gain_twins::VoxelsOfRay> rays;
        std::size_t visits = 0;
        for (const Vector3& d : bundle().directions) {
          rays.push_back(visited_by(voxels, views[v].translation(), views[v].linear() * d, max_range));
          visits += rays.back().size();
        }
        const auto expected = gain_twins::values(rays, Semantics::published, 60);
        ASSERT_EQ(scores[v].rays, 63u);
        ASSERT_EQ(scores[v].voxels, visits);
        for (std::size_t g = 0; g < asked.size(); ++g) {
          const double wanted = expected.at(std::string(asked[g]->name));
          ASSERT_NEAR(scores[v].gains[g], wanted, 1e-5 * (1 + std::abs(wanted))) << asked[g]->name << " of view " << v;
        }
      }
    }
  }
}

TEST(ScoreViews, ExplanationsNameTheVoxelsAndSumToTheScore) {
  std::mt19937 random(3);
  const std::vector<Voxel> voxels = random_voxels(random, 0.1);
  const MapRays caster(grid, {grid.size, voxels}, threshold, 1.5);
  for (const Pose& view : random_views(random, 6))
    for (const Gain* g : all_gains()) {
      const ScoreExplanation why = explain_score(caster, view, bundle(), *g);
      EXPECT_EQ(why.value, score_views(caster, {&view, 1}, bundle(), {&g, 1})[0].gains[0]);
      double sum = 0.0;
      for (const auto& ray : why.rays) {
        const auto expected = visited_by(voxels, view.translation(), ray.direction, 1.5);
        ASSERT_EQ(ray.voxels.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
          EXPECT_EQ(ray.voxels[i].lattice, expected[i].lattice);
          EXPECT_EQ(ray.voxels[i].measured, expected[i].measured);
          EXPECT_NEAR(ray.voxels[i].probability, expected[i].probability, 1e-7);
          sum += ray.voxels[i].contribution;
        }
      }
      EXPECT_NEAR(sum, why.value, 1e-9 * (1 + std::abs(why.value))) << g->name;
    }
}

TEST(ScoreViews, TheSameBytesOnOneThreadAndTwo) {
  std::mt19937 random(4);
  const std::vector<Voxel> voxels = random_voxels(random, 0.1);
  const std::vector<Pose> views = random_views(random, 40);
  const MapRays caster(grid, {grid.size, voxels}, threshold, 1.5);
  const auto scores = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return score_views(caster, views, bundle(), all_gains());
  };
  const auto one = scores(1), two = scores(2);
  for (std::size_t v = 0; v < views.size(); ++v) {
    EXPECT_EQ(one[v].gains, two[v].gains);
    EXPECT_EQ(one[v].voxels, two[v].voxels);
    const Pose& view = views[v];
    EXPECT_EQ(one[v].gains, score_views(caster, {&view, 1}, bundle(), all_gains())[0].gains);  // alone as in company
  }
}

TEST(ScoreViews, AStopLeavesScoresEmpty) {
  const std::vector<Voxel> voxels(grid.voxel_count());
  const std::vector<Pose> views(50, look_at(Vector3(1, 0, 0), Vector3::Zero()));
  std::stop_source stop;
  stop.request_stop();
  const auto scores = score_views(MapRays(grid, {grid.size, voxels}, threshold, 1.5), views, bundle(), all_gains(), {},
                                  stop.get_token());
  ASSERT_EQ(scores.size(), views.size());
  for (const ViewScore& s : scores) EXPECT_TRUE(s.gains.empty());
}

}  // namespace
}  // namespace nextview
