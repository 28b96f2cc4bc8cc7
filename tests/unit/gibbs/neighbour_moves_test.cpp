#include "core/gibbs/neighbour_moves.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "core/gibbs/first_hit_state.hpp"
#include "core/gibbs/survival_state.hpp"
#include "tests/unit/gibbs/plain_model.hpp"
#include "tests/unit/gibbs/random_problems.hpp"

namespace nextview {
namespace {

using plain::Levels;
using random_problems::Problem;

/// A state over the rays of a problem, and the moves on it.
template <class State>
struct Moved {
  Moved(const Problem& problem, ForwardModel kind)
      : config(config_for(problem, kind)),
        lists(problem.grid, problem.measurements, config.model),
        sites(find_sites(lists, config, {})),
        state(lists, config.model),
        moves(problem.grid, sites, state) {}
  static PosteriorSamplerConfig config_for(const Problem& problem, ForwardModel kind) {
    PosteriorSamplerConfig config;
    config.model.kind = kind;
    config.model.sigma = problem.sigma;
    config.model.attenuations = {0.3, 2.0};
    return config;
  }
  Levels levels() const { return {state.map().begin(), state.map().end()}; }

  PosteriorSamplerConfig config;
  RayLists lists;
  Sites sites;
  State state;
  NeighbourMoves<State> moves;
};
template <class Use>
void for_each_state(const Problem& problem, Use use) {
  for (const ForwardModel kind : {ForwardModel::paper, ForwardModel::cone}) use(Moved<FirstHitState>(problem, kind));
  for (const ForwardModel kind : {ForwardModel::beam, ForwardModel::attenuation})
    use(Moved<SurvivalState>(problem, kind));
}

/// log p(z | m) of all rays, from its definition.
double log_likelihood_of(const Problem& problem, const ForwardSensorModel& model, const Levels& levels) {
  double sum = 0.0;
  for (const RangeMeasurement& ray : problem.measurements.rays)
    sum += ray.weight * log_likelihood(problem.grid, model, problem.measurements, ray, levels);
  return sum;
}

Problem small_room() { return random_problems::make({"room", {7, 6, 5}, 4, 300, 0.4}, 11); }

CounterRandom draws(std::uint32_t sweep) { return {5, random_stream::gibbs, sweep}; }

std::size_t differing(const Levels& a, const Levels& b) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < a.size(); ++v) count += a[v] != b[v];
  return count;
}

TEST(NeighbourMoves, WhereAllVoxelsAreAlikeNothingChanges) {
  const Problem problem = small_room();
  for_each_state(problem, [&](auto moved) {
    for (const std::uint8_t level : {0, 1}) {
      const Levels alike(problem.grid.voxel_count(), level);
      moved.state.reset(alike);
      EXPECT_EQ(moved.moves.swap(draws(level)), 0u);
      EXPECT_EQ(moved.moves.redraw_plaquettes(draws(level)), 0u);
      EXPECT_EQ(moved.levels(), alike);
    }
  });
}

TEST(NeighbourMoves, ExchangeLevelsNearRangesAndKeepTheirNumber) {
  const Problem problem = small_room();
  for_each_state(problem, [&](auto moved) {
    std::mt19937 random(3);
    Levels before(problem.grid.voxel_count());
    for (std::uint8_t& level : before) level = random() % moved.state.levels();
    moved.state.reset(before);
    const auto off = [&] {  // by what does not depend on the map
      return moved.state.log_likelihood() - log_likelihood_of(problem, moved.config.model, moved.levels());
    };
    const double constant = off();
    std::size_t swapped = 0, redrawn = 0;
    for (std::uint32_t sweep = 0; sweep < 20; ++sweep) {
      const std::size_t by_swaps = moved.moves.swap(draws(2 * sweep));
      EXPECT_EQ(by_swaps % 2, 0u) << "two voxels a swap";
      EXPECT_GE(by_swaps, differing(before, moved.levels())) << "what differs has changed";
      const Levels between = moved.levels();
      const std::size_t by_plaquettes = moved.moves.redraw_plaquettes(draws(2 * sweep + 1));
      EXPECT_GE(by_plaquettes, differing(between, moved.levels()));
      swapped += by_swaps, redrawn += by_plaquettes;
      Levels sorted_before = before, sorted_after = moved.levels();
      for (std::size_t v = 0; v < before.size(); ++v)
        if (moved.sites.kind[v] != Sites::near) {
          EXPECT_EQ(before[v], moved.levels()[v]) << v;
        }
      std::ranges::sort(sorted_before), std::ranges::sort(sorted_after);
      EXPECT_EQ(sorted_before, sorted_after);
      before = moved.levels();
    }
    EXPECT_GT(swapped, 20u);
    EXPECT_GT(redrawn, 20u);
    EXPECT_NEAR(off(), constant, 1e-3 * std::abs(moved.state.log_likelihood())) << "the state has kept up with them";
  });
}

/// How often each map comes of one move from `start`.
template <class Move>
std::map<Levels, double> shares(const Levels& start, auto& moved, Move move) {
  constexpr std::uint32_t times = 20'000;
  std::map<Levels, double> found;
  for (std::uint32_t n = 0; n < times; ++n) {
    moved.state.reset(start);
    move(n);
    found[moved.levels()] += 1.0 / times;
  }
  return found;
}
constexpr double five_sigma = 5.0 * 0.5 / 141.0;  // of a share of 20,000, at most

// Along one axis of three there is a neighbour; of a swap that makes the ranges less likely, that share is taken.
TEST(NeighbourMoves, ASwapIsTakenAsOftenAsItMakesTheRangesLikely) {
  const Problem problem = random_problems::make({"two voxels", {2, 1, 1}, 1, 2, 1.5}, 4);
  for_each_state(problem, [&](auto moved) {
    ASSERT_EQ(moved.sites.near_voxels.size(), 2u);
    for (const Levels& start : {Levels{1, 0}, Levels{0, 1}}) {
      const Levels swapped = {start[1], start[0]};
      const double change = log_likelihood_of(problem, moved.config.model, swapped) -
                            log_likelihood_of(problem, moved.config.model, start);
      auto found = shares(start, moved, [&](std::uint32_t n) { moved.moves.swap(draws(n)); });
      EXPECT_NEAR(found[swapped], std::min(1.0, std::exp(change)) / 3.0, five_sigma) << change;
      EXPECT_NEAR(found[start] + found[swapped], 1.0, 1e-9);
    }
  });
}

// Of a layer of four, one axis of three leads to a square; it is drawn from all arrangements by their likelihood.
TEST(NeighbourMoves, ASquareIsDrawnFromItsArrangementsAsTheRangesHaveThem) {
  Problem problem{{0.1, {0, 0, 0}, {2, 2, 1}}, {}, 0.1};
  problem.measurements.max_range = 1.0;
  problem.measurements.origins = {{-0.3, 0.05, 0.05}, {-0.3, 0.15, 0.05}};  // before each row
  for (const auto& [x, row] : {std::pair(0.04f, 0), std::pair(0.14f, 0), std::pair(0.17f, 1)})
    problem.measurements.rays.push_back({{x, 0.05f + 0.1f * float(row), 0.05f}, std::uint32_t(row)});
  for_each_state(problem, [&](auto moved) {
    ASSERT_EQ(moved.sites.near_voxels.size(), 4u);
    const Levels start = {1, 0, 1, 0};
    std::map<Levels, double> expected;
    double total = 0.0;
    Levels arrangement = {0, 0, 1, 1};
    do total += expected[arrangement] = std::exp(log_likelihood_of(problem, moved.config.model, arrangement));
    while (std::ranges::next_permutation(arrangement).found);
    auto found = shares(start, moved, [&](std::uint32_t n) { moved.moves.redraw_plaquettes(draws(n)); });
    for (const auto& [map, likelihood] : expected)
      EXPECT_NEAR(found[map], likelihood / total / 3.0 + (map == start ? 2.0 / 3.0 : 0.0), five_sigma);
  });
}

}  // namespace
}  // namespace nextview
