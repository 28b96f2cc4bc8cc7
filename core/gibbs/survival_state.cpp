#include "core/gibbs/survival_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/gibbs/log_product.hpp"

namespace nextview {
namespace {

/// What rays' log-likelihoods are multiplied by, asked in ascending order of rays.
class EvidenceCursor {
 public:
  explicit EvidenceCursor(std::span<const RayLists::WeightRun> runs) : runs_(runs) { step(0); }
  double evidence(std::uint32_t ray) {
    while (ray >= end_) step(run_ + 1);
    return evidence_;
  }
  std::uint32_t end() const { return end_; }  ///< the first ray of another evidence

 private:
  void step(std::size_t run) {
    run_ = run;
    evidence_ = run < runs_.size() ? runs_[run].evidence : 1.0;
    end_ = run + 1 < runs_.size() ? runs_[run + 1].first : 0xffffffffu;
  }

  std::span<const RayLists::WeightRun> runs_;
  std::size_t run_ = 0;
  std::uint32_t end_ = 0;
  double evidence_ = 1.0;
};

/// log of the sum of what these are the logarithms of.
double log_sum(std::span<const double> logs) {
  const double largest = *std::max_element(logs.begin(), logs.end());
  // Before a ray has spoken all are the prior's; most voxels are asked about only then.
  static const std::array<double, 6> log_of = {0.0, 0.0, std::log(2.0), std::log(3.0), std::log(4.0), std::log(5.0)};
  if (std::ranges::all_of(logs, [&](double log) { return log == largest; })) return largest + log_of[logs.size()];
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - largest);
  return largest + std::log(sum);
}

}  // namespace

SurvivalState::SurvivalState(const RayLists& lists, const ForwardSensorModel& model)
    : lists_(lists), levels_(model.levels()) {
  for (int level = 0; level < levels_; ++level)
    for (std::uint32_t code = 0; code < RayLists::chord_codes; ++code) {
      const double passing = model.transmission(level, RayLists::chord(code));
      depth_[level][code] =
          passing > 0.0 ? static_cast<std::int32_t>(std::lround(-std::log(passing) * depth_unit)) : opaque;
      passing_[level][code] = SurvivalState::passing(depth_[level][code]);
    }
  reset(std::vector<std::uint8_t>(lists.grid().voxel_count(), 0));
}

std::size_t SurvivalState::bytes() const {
  return map_.size() + hot_.size() * sizeof(Hot) + cold_.size() * sizeof(Cold);
}

float SurvivalState::passing(std::int32_t depth) {
  return depth == 0 ? 1.0f : depth >= opaque ? 0.0f : std::exp(-static_cast<float>(depth) / depth_unit);
}

void SurvivalState::reset(std::vector<std::uint8_t> map) {
  map_ = std::move(map);
  cold_.assign(lists_.rays(), {});
  hot_.resize(lists_.rays());
  for (std::uint32_t voxel = 0; voxel < map_.size(); ++voxel)
    if (const std::uint8_t level = map_[voxel])
      for (const RayLists::FrontEntry entry : lists_.front(voxel))
        cold_[entry.ray()].depth += depth_[level][entry.chord()];
  for (std::uint32_t ray = 0; ray < lists_.rays(); ++ray) {
    cold_[ray].near_sum = near_sum(ray);
    hot_[ray] = hot(cold_[ray].near_sum * passing(cold_[ray].depth));
  }
}

/// S of a ray, from scratch.
float SurvivalState::near_sum(std::uint32_t ray) const {
  float pass = 1.0f, sum = lists_.open_value(ray);  // 0 for a hit
  for (const RayLists::Incidence& incidence : lists_.incidences(ray))
    if (const std::uint8_t level = map_[incidence.voxel]) {
      const float passed = pass * passing_[level][incidence.chord];
      sum += (pass - passed) * incidence.value;
      pass = passed;
    }
  return sum;
}

template <class Heard>
void SurvivalState::change_voxel(std::uint32_t voxel, std::uint8_t level, Heard heard) {
  const std::uint8_t old = map_[voxel];
  if (old == level) return;
  map_[voxel] = level;
  const auto refresh = [&](std::uint32_t ray) {
    const Hot now = hot(cold_[ray].near_sum * passing(cold_[ray].depth));
    heard(ray, hot_[ray], now);
    hot_[ray] = now;
  };
  for (const RayLists::NearEntry entry : lists_.near(voxel)) {
    cold_[entry.ray].near_sum = near_sum(entry.ray);
    refresh(entry.ray);
  }
  for (const RayLists::FrontEntry entry : lists_.front(voxel)) {
    cold_[entry.ray()].depth += depth_[level][entry.chord()] - depth_[old][entry.chord()];
    refresh(entry.ray());
  }
}

double SurvivalState::change(std::uint32_t voxel, std::uint8_t level) {
  LogProduct change;
  change_voxel(voxel, level, [&](std::uint32_t ray, const Hot& before, const Hot& now) {
    change.multiply((1.0 + now.s) / (1.0 + before.s), lists_.evidence(ray));
  });
  return change.sum();
}

void SurvivalState::set(std::uint32_t voxel, std::uint8_t level) {
  change_voxel(voxel, level, [](std::uint32_t, const Hot&, const Hot&) {});
}

bool SurvivalState::conditional(std::uint32_t voxel, double log_negligible, bool bounds,
                                std::span<double> log_weights) const {
  if (lists_.is_near(voxel)) near_terms(voxel, log_weights);
  switch (levels_) {
    case 2:
      return front_terms<2>(voxel, log_negligible, bounds, log_weights);
    case 3:
      return front_terms<3>(voxel, log_negligible, bounds, log_weights);
    case 4:
      return front_terms<4>(voxel, log_negligible, bounds, log_weights);
    case 5:
      return front_terms<5>(voxel, log_negligible, bounds, log_weights);
    default:
      return front_terms<6>(voxel, log_negligible, bounds, log_weights);
  }
}

/// The terms of Eq. 8 of the rays that may have ended in the voxel.
void SurvivalState::near_terms(std::uint32_t voxel, std::span<double> log_weights) const {
  std::array<LogProduct, max_levels> products;
  for (const RayLists::NearEntry entry : lists_.near(voxel)) {
    const float pass_front = passing(cold_[entry.ray].depth);
    if (pass_front == 0.0f) continue;
    // before: what ends in front of the voxel; after: what ends behind it, were it free
    float pass = 1.0f, before = 0.0f, after = 0.0f, reaching = 1.0f;
    const RayLists::Incidence& own = lists_.incidence(entry.incidence);
    for (const RayLists::Incidence& incidence : lists_.incidences(entry.ray)) {
      if (&incidence == &own) {
        reaching = pass;
        before = after;
        after = 0.0f;
      } else if (const std::uint8_t level = map_[incidence.voxel]) {
        const float passed = pass * passing_[level][incidence.chord];
        after += (pass - passed) * incidence.value;
        pass = passed;
      }
    }
    const float here = reaching * own.value;
    const float if_free = 1.0f + pass_front * (before + after);
    const double evidence = lists_.evidence(entry.ray);
    for (int q = 1; q < levels_; ++q) {
      const float passed = passing_[q][own.chord];
      const float s = pass_front * (before + (1.0f - passed) * here + passed * after);
      products[q].multiply((1.0f + s) / if_free, evidence);
    }
  }
  for (int q = 1; q < levels_; ++q) log_weights[q - 1] += products[q].sum();
}

/// The ray's state if a voxel in front of it were free.
SurvivalState::Hot SurvivalState::without(RayLists::FrontEntry entry, std::uint8_t level) const {
  const Cold& ray = cold_[entry.ray()];
  return hot(ray.near_sum * passing(ray.depth - depth_[level][entry.chord()]));
}

/// The terms of Eq. 8 of the rays whose range lies behind the voxel.
template <int Levels>
bool SurvivalState::front_terms(std::uint32_t voxel, double log_negligible, bool bounds,
                                std::span<double> log_weights) const {
  constexpr double least_product = 1e-200;  // far enough from where numbers end for a part's factors more
  const auto entries = lists_.front(voxel);
  const std::uint8_t level = map_[voxel];
  EvidenceCursor cursor(lists_.weight_runs());
  std::size_t part = 1;  // one ray often settles it; if not, look at more before asking again
  for (std::size_t k = 0; k < entries.size();) {
    // Factors of rays of one evidence are multiplied before their logarithm is taken. All are at most 1, as a voxel in
    // front can only block: once every level's product is below `enough`, the weights are sure to be negligible.
    const double evidence = cursor.evidence(entries[k].ray());
    const double enough = std::exp((log_negligible - log_sum(log_weights)) / evidence);
    std::array<double, Levels> products;
    products.fill(1.0);
    double largest = 1.0, least = 1.0;
    while (k < entries.size() && entries[k].ray() < cursor.end() && largest >= enough && least > least_product) {
      for (const std::size_t end = std::min(k + part, entries.size()); k < end && entries[k].ray() < cursor.end();
           ++k) {
        const RayLists::FrontEntry entry = entries[k];
        const Hot ray = level == 0 ? hot_[entry.ray()] : without(entry, level);
        for (int q = 1; q < Levels; ++q) products[q] *= (1.0f + ray.s * passing_[q][entry.chord()]) * ray.inverse;
      }
      part = std::min<std::size_t>(2 * part, 8);
      largest = *std::max_element(products.begin() + 1, products.end());
      least = *std::min_element(products.begin() + 1, products.end());
    }
    const bool settled = largest < enough;
    if (settled && !bounds) return true;
    for (int q = 1; q < Levels; ++q) log_weights[q - 1] += evidence * std::log(products[q]);
    if (settled) return true;
  }
  return false;
}

double SurvivalState::log_likelihood() const {
  LogProduct product;
  for (std::uint32_t ray = 0; ray < lists_.rays(); ++ray) product.multiply(1.0 + hot_[ray].s, lists_.evidence(ray));
  return product.sum();
}

void SurvivalState::add_reach(std::vector<float>& reach, float enough) const {
  std::vector<float> behind_front(lists_.rays());  // of the measured rays that each ray stands for, how many get so far
  for (std::uint32_t ray = 0; ray < lists_.rays(); ++ray) {
    float pass = behind_front[ray] = static_cast<float>(lists_.weight(ray)) * passing(cold_[ray].depth);
    for (const RayLists::Incidence& incidence : lists_.incidences(ray)) {
      reach[incidence.voxel] += pass;
      pass *= passing_[map_[incidence.voxel]][incidence.chord];
    }
  }
  // What passes all of a ray's front reaches each voxel there: where that is enough already, which is nearly
  // everywhere, no ray needs to be cast. Elsewhere, unblocked rays count as they are, and blocked ones are cast.
  std::vector<std::uint8_t> wanted(lists_.rays(), 0);
  for (std::uint32_t voxel = 0; voxel < map_.size(); ++voxel) {
    if (reach[voxel] >= enough) continue;
    const auto entries = lists_.front(voxel);
    float least = reach[voxel];
    for (std::size_t k = 0; k < entries.size() && least < enough; ++k) least += behind_front[entries[k].ray()];
    if (least >= enough) {
      reach[voxel] = least;
      continue;
    }
    for (const RayLists::FrontEntry entry : entries) {
      const bool blocked = cold_[entry.ray()].depth > 0;
      if (!blocked) reach[voxel] += behind_front[entry.ray()];
      wanted[entry.ray()] |= blocked;
    }
  }
  std::vector<RayLists::FrontVoxel> voxels;
  for (std::uint32_t ray = 0; ray < lists_.rays(); ++ray) {
    if (!wanted[ray]) continue;
    lists_.cast_front(ray, voxels);
    float pass = lists_.weight(ray);
    for (const auto& [voxel, chord] : voxels) {
      reach[voxel] += pass;
      pass *= passing_[map_[voxel]][chord];
    }
  }
}

}  // namespace nextview
