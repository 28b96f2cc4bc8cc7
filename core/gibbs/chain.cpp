#include "core/gibbs/chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/gibbs/first_hit_state.hpp"
#include "core/gibbs/neighbour_moves.hpp"
#include "core/gibbs/survival_state.hpp"
#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

/// Conditional probabilities below this are not told apart in the mean.
constexpr double negligible_in_mean = 1e-6;
/// OctoMap's terms, which Algorithm 1 puts in the place of the conditional (our reading).
constexpr double algorithm1_occupied = 0.7, algorithm1_free = 0.4;

/// What a sweep draws its numbers for.
enum class Draw : std::uint32_t { levels, looks, swaps, plaquettes };

/// The sampler over the rays' state of a family of sensor models.
template <class State>
class StateChain final : public Chain {
 public:
  StateChain(const RayLists& lists, const PosteriorSamplerConfig& config, const Sites& sites, int index)
      : lists_(lists),
        config_(config),
        sites_(sites),
        index_(index),
        state_(lists, config.model),
        moves_(lists.grid(), sites, state_) {
    const int occupied_levels = state_.levels() - 1;
    log_prior_odds_ = std::log(config.prior / occupied_levels / (1.0 - config.prior));
    // A voxel that stops some rays and passes others leaves the others room: a chain of those needs no swaps.
    swaps_ = config.swaps >= 0 ? config.swaps : config.model.kind == ForwardModel::attenuation ? 0 : 1;
  }

  void start(std::vector<std::uint8_t> map) override { state_.reset(std::move(map)); }
  std::span<const std::uint8_t> map() const override { return state_.map(); }
  std::size_t bytes() const override {
    return state_.bytes() + (2 * sizeof(double) + sizeof(float)) * state_.map().size();
  }

  /// A turn of the outer loop of Algorithm 1 (one sample j), and the moves that it lacks.
  std::size_t sweep(PosteriorSums* mean) override {
    ++sweep_;
    changed_ = 0;
    update_levels(mean);
    if (config_.sampler == Sampler::exact) {
      for (int pass = 0; pass < swaps_; ++pass) changed_ += moves_.swap(random(Draw::swaps, pass));
      for (int pass = 0; pass < config_.plaquettes; ++pass)
        changed_ += moves_.redraw_plaquettes(random(Draw::plaquettes, pass));
    }
    return changed_;
  }

  void add_reach(PosteriorSums& mean, float enough) const override {
    state_.add_reach(mean.reach, enough);
    ++mean.reach_samples;
  }

  double log_posterior() const override {
    const auto map = state_.map();
    const auto occupied = map.size() - static_cast<std::size_t>(std::count(map.begin(), map.end(), 0));
    return state_.log_likelihood() + log_prior_odds_ * static_cast<double>(occupied);
  }

 private:
  CounterRandom random(Draw what, int pass = 0) const {
    return CounterRandom(config_.seed,
                         random_stream::gibbs + static_cast<std::uint32_t>(index_) * 64 +
                             static_cast<std::uint32_t>(what) * 16 + static_cast<std::uint32_t>(pass),
                         sweep_);
  }

  /// The inner loop of Algorithm 1: single-voxel updates, those near ranges first, each kind brick after brick. While
  /// one is drawn all others stay, so p(m_-i | z, x) of Eq. 5 does, and with it the posterior.
  void update_levels(PosteriorSums* mean) {
    const bool front_too = mean && mean->near_sweeps++ % 16 == 0;
    if (front_too) ++mean->front_sweeps;
    // Algorithm 1 may occupy any voxel.
    if (front_too || config_.sampler == Sampler::algorithm1)
      update_all(mean, front_too);
    else
      update_unsettled(mean);
  }

  void update_all(PosteriorSums* mean, bool front_too) {
    const CounterRandom draws = random(Draw::levels);
    update_near(draws, mean);
    const std::vector<std::uint32_t>& voxels = sites_.front_voxels;
    for (std::size_t n = 0; n < voxels.size(); ++n) {
      if (n + 8 < voxels.size()) lists_.prefetch_front(voxels[n + 8]);
      if (n + 3 < voxels.size()) state_.prefetch_front(voxels[n + 3]);
      update(voxels[n], draws.uniform(voxels[n])[0], front_too ? mean : nullptr);
    }
  }

  void update_near(const CounterRandom& draws, PosteriorSums* mean) {
    const std::vector<std::uint32_t>& voxels = sites_.near_voxels;
    for (std::size_t n = 0; n < voxels.size(); ++n) {
      if (n + 4 < voxels.size()) lists_.prefetch_near(voxels[n + 4]);
      if (n + 2 < voxels.size()) state_.prefetch_near(voxels[n + 2]);
      update(voxels[n], draws.uniform(voxels[n])[0], mean);
    }
  }

  /// The same with far less work. A voxel in front of ranges can only get less likely to be occupied than the prior has
  /// it. So while it is free, the uniform number alone says 'still free' with the prior's probability, whatever the
  /// rays say: the gaps between those that need a look are drawn instead (geometric).
  void update_unsettled(PosteriorSums* mean) {
    const CounterRandom draws = random(Draw::levels);
    draw_looks(draws);
    update_near(draws, mean);
    for (std::size_t l = 0; l < looks_.size(); ++l) {
      if (l + 8 < looks_.size()) lists_.prefetch_front(looks_[l + 8].voxel);
      if (l + 4 < looks_.size()) state_.prefetch_front(looks_[l + 4].voxel);
      update(looks_[l].voxel, looks_[l].u, nullptr);
    }
  }

  /// The voxels in front that need a look, with their uniform numbers: those that are occupied, and free ones whose
  /// number leaves open what they become. In one order whatever their levels: were it theirs to decide which comes
  /// first, the chain would have another distribution than the posterior.
  void draw_looks(const CounterRandom& draws) {
    const CounterRandom gaps = random(Draw::looks);
    const double log_settled = std::log1p(-config_.prior);
    const auto map = state_.map();
    std::uint64_t drawn = 0;
    std::size_t next = 0;  // that is looked at though it is free
    double u = 0.0;
    const auto draw_next = [&] {
      const auto numbers = gaps.uniform(drawn / 2);
      const std::size_t half = 2 * (drawn++ % 2);
      next += static_cast<std::size_t>(std::min(std::log(numbers[half]) / log_settled, 4e9));
      u = 1.0 - config_.prior * numbers[half + 1];
    };
    looks_.clear();
    draw_next();
    for (std::size_t place = 0; place < sites_.front_voxels.size(); ++place) {
      const std::uint32_t voxel = sites_.front_voxels[place];
      if (map[voxel] != 0)
        looks_.push_back({voxel, draws.uniform(voxel)[0]});
      else if (place == next)
        looks_.push_back({voxel, u});
      if (place == next) ++next, draw_next();
    }
  }

  /// Draws the level of a voxel from its full conditional (Eqs. 8-9), given the uniform number.
  void update(std::uint32_t voxel, double u, PosteriorSums* mean) {
    // Level 0 is drawn if the weights of the others, relative to its own, come to no more than this.
    const double limit = (1.0 - u) / u;
    const bool exact = config_.sampler == Sampler::exact;
    std::array<double, ForwardSensorModel::max_attenuations> weights;
    const auto used = std::span(weights).first(state_.levels() - 1);
    std::fill(used.begin(), used.end(), log_prior_odds_);
    // Eq. 8: the prior, and of each ray what it says for the level less what it says for free.
    const bool only_drawn = exact && !mean;
    const bool settled = state_.conditional(voxel, only_drawn ? std::log(limit) : log_negligible_in_mean_, used);
    if (settled && only_drawn) {
      set(voxel, 0);
      return;
    }
    const double largest = std::max(0.0, *std::max_element(used.begin(), used.end()));
    double occupied = 0.0;
    for (double& w : used) occupied += w = std::exp(w - largest);
    const double free = std::exp(-largest);
    double p_occupied = occupied / (free + occupied);  // Eq. 9
    // Algorithm 1 puts p(occ) or p(free) in its place, and so may occupy what the rays leave no weight at all.
    if (!exact) p_occupied = p_occupied > 0.5 ? algorithm1_occupied : algorithm1_free;
    if (!exact && occupied == 0.0) occupied = used.front() = 1.0;

    if (mean) {
      mean->occupied[voxel] += p_occupied;
      mean->upper[voxel] += occupied > 0.0 ? p_occupied * used.back() / occupied : 0.0;
    }
    set(voxel, level_at((u - (1.0 - p_occupied)) / p_occupied * occupied, used));
  }

  /// The level whose stretch of the weights holds `at`; 0 below all of them.
  static std::uint8_t level_at(double at, std::span<const double> weights) {
    if (!(at > 0.0)) return 0;
    std::uint8_t level = 1;
    for (; level < weights.size() && at > weights[level - 1]; ++level) at -= weights[level - 1];
    return level;
  }

  void set(std::uint32_t voxel, std::uint8_t level) {
    if (state_.map()[voxel] == level) return;
    ++changed_;
    state_.set(voxel, level);
  }

  struct Look {
    std::uint32_t voxel;
    double u;
  };

  const RayLists& lists_;
  const PosteriorSamplerConfig& config_;
  const Sites& sites_;
  int index_;
  std::uint32_t sweep_ = 0;
  std::size_t changed_ = 0;
  double log_prior_odds_;
  int swaps_;
  const double log_negligible_in_mean_ = std::log(negligible_in_mean);
  State state_;
  NeighbourMoves<State> moves_;
  std::vector<Look> looks_;  ///< scratch of update_unsettled
};

}  // namespace

std::unique_ptr<Chain> make_chain(const RayLists& lists, const PosteriorSamplerConfig& config, const Sites& sites,
                                  int index) {
  if (config.model.is_first_hit()) return std::make_unique<StateChain<FirstHitState>>(lists, config, sites, index);
  return std::make_unique<StateChain<SurvivalState>>(lists, config, sites, index);
}

}  // namespace nextview
