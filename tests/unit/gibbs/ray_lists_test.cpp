// Which rays go through which voxels, and what chains do with them at their start.
#include "core/gibbs/ray_lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>

#include "core/gibbs/sites.hpp"
#include "tests/unit/gibbs/plain_model.hpp"
#include "tests/unit/gibbs/random_problems.hpp"

namespace nextview {
namespace {

using random_problems::Problem;

/// With rays that stand for several, and one that goes nowhere near the grid.
Problem room_missed_by_a_ray() {
  Problem problem = random_problems::make({"room", {8, 7, 5}, 4, 400, 0.4, true}, 7);
  const Vector3 away = 2.0 * problem.measurements.origins[0] - 0.5 * (problem.grid.lower() + problem.grid.upper());
  problem.measurements.rays.push_back({away.cast<float>(), 0, 1, false});
  return problem;
}

ForwardSensorModel dependent_model(const Problem& problem, ForwardModel kind) {
  ForwardSensorModel model;
  model.kind = kind;
  model.sigma = problem.sigma;
  model.independence = 0.5;
  return model;
}

RayLists lists_for(const Problem& problem, ForwardModel kind) {
  return {problem.grid, problem.measurements, dependent_model(problem, kind)};
}

/// From the definition: the voxels on a ray's line up to 4 sigma behind its range are near it from 4 sigma before on.
struct Expected {
  std::vector<int> front, near;  ///< rays of each voxel
  double chords = 0.0;           ///< of all in front [voxel edges]

  explicit Expected(const Problem& problem) : front(problem.grid.voxel_count()), near(front) {
    const RangeMeasurements& measurements = problem.measurements;
    for (const RangeMeasurement& ray : measurements.rays) {
      const double z = measurements.range(ray), slack = ray.beyond_range ? 0.0 : 4.0 * problem.sigma;
      for (const plain::Step& step : plain::voxels_on_line(problem.grid, measurements.origins[ray.origin],
                                                           measurements.direction(ray), z + slack)) {
        const bool is_near = !ray.beyond_range && step.exit >= z - slack;
        ++(is_near ? near : front)[step.voxel];
        if (!is_near) chords += (step.exit - step.enter) / problem.grid.resolution;
      }
    }
  }
};

TEST(RayLists, HoldTheVoxelsInFrontOfRangesAndNearThem) {
  const Problem problem = room_missed_by_a_ray();
  const RayLists lists = lists_for(problem, ForwardModel::beam);
  const Expected expected(problem);
  int listed = 0, differing = 0;
  double chords = 0.0;
  for (std::uint32_t v = 0; v < problem.grid.voxel_count(); ++v) {
    const int front = int(lists.front(v).size()), near = int(lists.near(v).size());
    differing += std::abs(front - expected.front[v]) + std::abs(near - expected.near[v]);
    listed += front + near;
    for (const RayLists::FrontEntry entry : lists.front(v)) chords += RayLists::chord(entry.chord());
    EXPECT_EQ(lists.is_near(v), near > 0);
    EXPECT_EQ(lists.observed(v), near + front > 0);
  }
  EXPECT_EQ(std::size_t(listed), lists.incidence_count());
  EXPECT_GT(listed, 1500);
  EXPECT_LE(differing, 2) << "corners that rounding decides";
  EXPECT_NEAR(chords, expected.chords, 1e-3 * expected.chords) << "each is rounded to a thousandth of the longest";
}

TEST(RayLists, AllVoxelsAreNearWhereTheFirstOneCounts) {
  const Problem problem = room_missed_by_a_ray();
  const Expected expected(problem);
  for (const ForwardModel kind : {ForwardModel::paper, ForwardModel::cone}) {
    const RayLists lists = lists_for(problem, kind);
    int differing = 0;
    for (std::uint32_t v = 0; v < problem.grid.voxel_count(); ++v) {
      EXPECT_TRUE(lists.front(v).empty());
      differing += std::abs(int(lists.near(v).size()) - expected.front[v] - expected.near[v]);
    }
    EXPECT_LE(differing, 2);
  }
}

TEST(RayLists, HaveTheRaysInTheirOrderAndNoneThatMissesTheGrid) {
  const Problem problem = room_missed_by_a_ray();
  const RayLists lists = lists_for(problem, ForwardModel::beam);
  std::vector<std::uint32_t> weights;  // of those that enter: some outliers end before the grid
  for (const RangeMeasurement& ray : problem.measurements.rays) {
    const double end = list_end(problem.measurements, ray, dependent_model(problem, ForwardModel::beam));
    const Vector3& origin = problem.measurements.origins[ray.origin];
    if (plain::voxels_on_line(problem.grid, origin, problem.measurements.direction(ray), end).empty()) continue;
    weights.push_back(ray.weight);
  }
  ASSERT_EQ(lists.rays(), weights.size());
  EXPECT_GT(lists.rays(), 350u);
  EXPECT_LT(lists.rays(), problem.measurements.rays.size());
  for (std::uint32_t ray = 0; ray < lists.rays(); ++ray) {
    EXPECT_EQ(lists.weight(ray), weights[ray]);
    EXPECT_EQ(lists.evidence(ray), 0.5 * lists.weight(ray));
  }
}

TEST(RayLists, OfARayAndOfAVoxelTellTheSame) {
  const Problem problem = room_missed_by_a_ray();
  const RayLists lists = lists_for(problem, ForwardModel::attenuation);
  std::vector<std::map<std::uint32_t, std::uint32_t>> front(lists.rays());  // of each ray: voxel and chord
  std::vector<std::size_t> near(lists.rays());
  for (std::uint32_t v = 0; v < problem.grid.voxel_count(); ++v) {
    for (const RayLists::FrontEntry entry : lists.front(v)) front[entry.ray()][v] = entry.chord();
    for (const RayLists::NearEntry entry : lists.near(v)) {
      EXPECT_EQ(lists.incidence(entry.incidence).voxel, v);
      EXPECT_GE(entry.incidence, lists.incidences_begin(entry.ray));
      EXPECT_LT(entry.incidence, lists.incidences_end(entry.ray));
      ++near[entry.ray];
    }
  }
  std::vector<RayLists::FrontVoxel> cast(3);  // is overwritten
  for (std::uint32_t ray = 0; ray < lists.rays(); ++ray) {
    lists.cast_front(ray, cast);
    EXPECT_EQ(cast.size(), front[ray].size());
    for (const RayLists::FrontVoxel& voxel : cast) EXPECT_EQ(front[ray].at(voxel.voxel), voxel.chord);
    const auto incidences = lists.incidences(ray);
    EXPECT_EQ(incidences.size(), near[ray]);
    for (std::size_t i = 1; i < incidences.size(); ++i) {
      const Eigen::Vector3i step = problem.grid.cell(incidences[i].voxel) - problem.grid.cell(incidences[i - 1].voxel);
      EXPECT_EQ(step.cwiseAbs().sum(), 1) << "through a face of the one before";
      EXPECT_LE(incidences[i - 1].place, incidences[i].place);
    }
  }
}

TEST(RayLists, KnowHowMuchLikelierBeyondRangeIsWhereNothingIsInTheWay) {
  const Problem problem = room_missed_by_a_ray();
  ForwardSensorModel model = dependent_model(problem, ForwardModel::beam);
  model.random_weight = 0.1, model.max_weight = 0.2;
  const RayLists lists(problem.grid, problem.measurements, model);
  std::size_t open = 0, expected = 0;
  for (const RangeMeasurement& ray : problem.measurements.rays) expected += ray.beyond_range;
  for (std::uint32_t ray = 0; ray < lists.rays(); ++ray) {
    if (lists.open_value(ray) == 0.0f) continue;
    EXPECT_NEAR(lists.open_value(ray), 0.9 / 0.2 - 1.0, 1e-5);
    ++open;
  }
  EXPECT_EQ(open, expected);
  EXPECT_GT(open, 20u);
}

TEST(RayLists, ChordsGoUpToTheDiagonal) {
  EXPECT_EQ(RayLists::chord(0), 0.0);
  EXPECT_NEAR(RayLists::chord(RayLists::chord_codes - 1), std::sqrt(3.0), 1e-12);
}

/// Those of some origins, first come those of the first.
RangeMeasurements of_origins(const RangeMeasurements& all, std::uint32_t first, std::uint32_t last) {
  RangeMeasurements some{all.max_range, {all.origins.begin() + first, all.origins.begin() + last}, {}};
  for (std::uint32_t origin = first; origin < last; ++origin)
    for (RangeMeasurement ray : all.rays)
      if (ray.origin == origin) {
        ray.origin -= first;
        some.rays.push_back(ray);
      }
  return some;
}

void expect_same(const RayLists& a, const RayLists& b) {
  ASSERT_EQ(a.rays(), b.rays());
  EXPECT_EQ(a.incidence_count(), b.incidence_count());
  EXPECT_EQ(a.bytes(), b.bytes());
  const auto bytes = [](const auto& entries) { return std::as_bytes(entries); };
  for (std::uint32_t v = 0; v < a.grid().voxel_count(); ++v) {
    ASSERT_TRUE(std::ranges::equal(bytes(a.front(v)), bytes(b.front(v)))) << v;
    ASSERT_TRUE(std::ranges::equal(bytes(a.near(v)), bytes(b.near(v)))) << v;
  }
  for (std::uint32_t ray = 0; ray < a.rays(); ++ray) {
    ASSERT_EQ(a.incidences_begin(ray), b.incidences_begin(ray));
    ASSERT_TRUE(std::ranges::equal(bytes(a.incidences(ray)), bytes(b.incidences(ray)))) << ray;
    EXPECT_EQ(a.weight(ray), b.weight(ray));
    EXPECT_EQ(a.evidence(ray), b.evidence(ray));
    EXPECT_EQ(a.open_value(ray), b.open_value(ray));
    EXPECT_EQ(a.direction(ray), b.direction(ray));
  }
}

TEST(RayLists, GrowViewByViewToWhatTheyAreOfAllViews) {
  const Problem problem = room_missed_by_a_ray();
  for (const ForwardModel kind :
       {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam, ForwardModel::attenuation}) {
    const ForwardSensorModel model = dependent_model(problem, kind);
    RayLists grown(problem.grid, of_origins(problem.measurements, 0, 0), model);
    EXPECT_EQ(grown.rays(), 0u);
    for (std::uint32_t origin = 0; origin < 4; ++origin) {
      EXPECT_EQ(grown.first_ray_of(origin), grown.rays());
      grown.append(of_origins(problem.measurements, origin, origin + 1));
      const RayLists at_once(problem.grid, of_origins(problem.measurements, 0, origin + 1), model);
      expect_same(grown, at_once);
    }
    EXPECT_GT(grown.first_ray_of(1), 50u);
    grown.set_independence(0.25);
    ForwardSensorModel less = model;
    less.independence = 0.25;
    expect_same(grown, RayLists(problem.grid, of_origins(problem.measurements, 0, 4), less));
  }
}

TEST(Sites, AreWhatRaysObserve) {
  const Problem problem = room_missed_by_a_ray();
  const RayLists lists = lists_for(problem, ForwardModel::beam);
  std::vector<float> start(problem.grid.voxel_count());
  for (std::size_t v = 0; v < start.size(); ++v) start[v] = v % 3 == 0 ? 0.5f : v % 3 == 1 ? 0.4999f : 0.9f;
  for (const UpdatedVoxels updated : {UpdatedVoxels::occupied_and_free, UpdatedVoxels::occupied}) {
    PosteriorSamplerConfig config;
    config.updated = updated;
    Sites sites = find_sites(lists, config, start);
    const auto bricks = [&](std::uint32_t v) {
      const Eigen::Vector3i brick = lists.grid().cell(v) / 8;
      return std::array{brick.z(), brick.y(), brick.x()};
    };
    EXPECT_TRUE(std::ranges::is_sorted(sites.near_voxels, {}, bricks));
    EXPECT_TRUE(std::ranges::is_sorted(sites.front_voxels, {}, bricks));
    std::ranges::sort(sites.near_voxels);
    std::ranges::sort(sites.front_voxels);
    EXPECT_EQ(sites.count(), sites.near_voxels.size() + sites.front_voxels.size());
    for (std::uint32_t v = 0; v < start.size(); ++v) {
      const bool is_site = lists.observed(v) && (updated == UpdatedVoxels::occupied_and_free || start[v] >= 0.5f);
      EXPECT_EQ(sites.kind[v], !is_site ? Sites::none : lists.is_near(v) ? Sites::near : Sites::front) << v;
      EXPECT_EQ(std::ranges::binary_search(sites.near_voxels, v), sites.kind[v] == Sites::near);
      EXPECT_EQ(std::ranges::binary_search(sites.front_voxels, v), sites.kind[v] == Sites::front);
    }
  }
  PosteriorSamplerConfig occupied_only;
  occupied_only.updated = UpdatedVoxels::occupied;
  EXPECT_EQ(find_sites(lists, occupied_only, {}).count(), 0u) << "nothing is occupied yet";
}

TEST(Sites, AreNearARangeOrPassedByALaterRay) {
  const Problem problem = random_problems::make({"large room", {12, 11, 10}, 3, 60, 0.2}, 7);
  const RangeMeasurements by_origin = of_origins(problem.measurements, 0, 3);
  const RayLists lists(problem.grid, by_origin, dependent_model(problem, ForwardModel::beam));
  const std::uint32_t first = lists.first_ray_of(2);
  ASSERT_TRUE(first > 0 && first < lists.rays());
  const Sites sites = find_sites(lists, {}, {}, first);
  std::size_t left_out = 0;
  for (std::uint32_t v = 0; v < problem.grid.voxel_count(); ++v) {
    const bool passed = std::ranges::any_of(
        lists.front(v), [&](const RayLists::FrontEntry& entry) { return lists.measurement(entry.ray()).origin == 2; });
    EXPECT_EQ(sites.kind[v] != Sites::none, lists.is_near(v) || passed) << v;
    left_out += lists.observed(v) && sites.kind[v] == Sites::none;
  }
  EXPECT_GT(left_out, 50u);
}

TEST(Sites, StartAsTheyAreTold) {
  const Problem problem = random_problems::make({"large room", {12, 11, 10}, 2, 300, 0.4}, 7);
  const RayLists lists = lists_for(problem, ForwardModel::attenuation);
  PosteriorSamplerConfig config;  // of three levels
  std::vector<float> map(problem.grid.voxel_count(), 0.49f);
  for (std::size_t v = 0; v < map.size(); v += 2) map[v] = 0.5f;
  const auto levels = [&](StartMap start, int chain) {
    config.start = start;
    return start_levels(lists, config, map, chain);
  };
  const auto free = levels(StartMap::free, 0), occupied = levels(StartMap::occupied, 0),
             octree = levels(StartMap::octree, 0), drawn_levels = levels(StartMap::random, 0);
  std::size_t unobserved = 0;
  std::array<int, 3> random{};
  for (std::uint32_t v = 0; v < map.size(); ++v) {
    const bool observed = lists.observed(v);
    unobserved += !observed;
    EXPECT_EQ(free[v], 0);
    EXPECT_EQ(occupied[v], observed ? 2 : 0);
    EXPECT_EQ(octree[v], observed && v % 2 == 0 ? 2 : 0);
    const std::uint8_t drawn = drawn_levels[v];
    EXPECT_TRUE(observed || drawn == 0) << v;
    random.at(drawn) += observed;
  }
  EXPECT_GT(unobserved, 10u);
  const double third = double(map.size() - unobserved) / 3.0;
  for (const int count : random) EXPECT_NEAR(count, third, 5.0 * std::sqrt(third)) << "5 sigma";
  EXPECT_EQ(levels(StartMap::random, 1), levels(StartMap::random, 1));
  EXPECT_NE(levels(StartMap::random, 1), levels(StartMap::random, 0)) << "each chain from elsewhere";
}

}  // namespace
}  // namespace nextview
