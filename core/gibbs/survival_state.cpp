#include "core/gibbs/survival_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/gibbs/weighted_logs.hpp"

namespace nextview {
SurvivalState::SurvivalState(const RayLists& lists, const ForwardSensorModel& model)
    : lists_(lists), levels_(model.levels()) {
  for (int level = 0; level < levels_; ++level)
    for (std::uint32_t code = 0; code < RayLists::chord_codes; ++code) {
      const double passing = model.transmission(level, RayLists::chord(code));
      depth_[level][code] = passing > 0.0
                                ? static_cast<std::int32_t>(std::lround(-std::log(passing) * optical_depth::unit))
                                : optical_depth::opaque;
      passing_[level][code] = optical_depth::passing(depth_[level][code]);
      if (level > 0) passing_pairs_[(level - 1) / 2][code][(level - 1) % 2] = passing_[level][code];
    }
}

std::size_t SurvivalState::bytes() const {
  return map_.size() + rays_.size() * sizeof(RayWitness) + survivals_.size() * sizeof(RaySurvival);
}

void SurvivalState::reset(std::vector<std::uint8_t> map) {
  map_ = std::move(map);
  survivals_.assign(lists_.rays(), {});
  rays_.resize(lists_.rays());
  for (std::uint32_t voxel = 0; voxel < map_.size(); ++voxel)
    if (const std::uint8_t level = map_[voxel])
      for (const RayLists::FrontEntry entry : lists_.front(voxel))
        survivals_[entry.ray()].depth += depth_[level][entry.chord()];
  for (std::uint32_t ray = 0; ray < lists_.rays(); ++ray) {
    survivals_[ray].near_sum = near_sum(ray);
    rays_[ray] = {survivals_[ray].near_sum * optical_depth::passing(survivals_[ray].depth),
                  static_cast<float>(lists_.evidence(ray))};
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
    const RayWitness before = rays_[ray];
    rays_[ray].s = survivals_[ray].near_sum * optical_depth::passing(survivals_[ray].depth);
    heard(before, rays_[ray]);
  };
  for (const RayLists::NearEntry entry : lists_.near(voxel)) {
    survivals_[entry.ray].near_sum = near_sum(entry.ray);
    refresh(entry.ray);
  }
  for (const RayLists::FrontEntry entry : lists_.front(voxel)) {
    survivals_[entry.ray()].depth += depth_[level][entry.chord()] - depth_[old][entry.chord()];
    refresh(entry.ray());
  }
}

double SurvivalState::change(std::uint32_t voxel, std::uint8_t level) {
  WeightedLogs change;
  change_voxel(voxel, level, [&](const RayWitness& before, const RayWitness& now) {
    change.add((1.0f + now.s) / (1.0f + before.s), now.evidence);
  });
  return change.sum();
}

void SurvivalState::set(std::uint32_t voxel, std::uint8_t level) {
  change_voxel(voxel, level, [](const RayWitness&, const RayWitness&) {});
}

bool SurvivalState::conditional(std::uint32_t voxel, double log_negligible, std::span<double> log_weights) const {
  if (lists_.is_near(voxel)) near_terms(voxel, log_weights);
  return front_terms(voxel, log_negligible, log_weights);
}

/// The terms of Eq. 8 of the rays that may have ended in the voxel.
void SurvivalState::near_terms(std::uint32_t voxel, std::span<double> log_weights) const {
  std::array<WeightedLogs, max_levels> sums;
  for (const RayLists::NearEntry entry : lists_.near(voxel)) {
    const float pass_front = optical_depth::passing(survivals_[entry.ray].depth);
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
    const float evidence = rays_[entry.ray].evidence;
    for (int q = 1; q < levels_; ++q) {
      const float passed = passing_[q][own.chord];
      const float s = pass_front * (before + (1.0f - passed) * here + passed * after);
      sums[q].add((1.0f + s) / if_free, evidence);
    }
  }
  for (int q = 1; q < levels_; ++q) log_weights[q - 1] += sums[q].sum();
}

/// The terms of Eq. 8 of the rays whose range lies behind the voxel.
bool SurvivalState::front_terms(std::uint32_t voxel, double log_negligible, std::span<double> log_weights) const {
  const std::uint8_t level = map_[voxel];
  const FrontTerms terms{lists_.front(voxel), rays_.data(), survivals_.data(), passing_pairs_,
                         level == 0 ? nullptr : &depth_[level]};
  // Once each weight is below this, all together are sure to be negligible.
  return add_front_terms(terms, log_negligible - std::log(double(log_weights.size())), log_weights);
}

double SurvivalState::log_likelihood() const {
  WeightedLogs sum;
  for (const RayWitness& ray : rays_) sum.add(1.0f + ray.s, ray.evidence);
  return sum.sum();
}

void SurvivalState::add_reach(std::vector<float>& reach, float enough) const {
  std::vector<float> behind_front(lists_.rays());  // of the measured rays that each ray stands for, how many get so far
  for (std::uint32_t ray = 0; ray < lists_.rays(); ++ray) {
    float pass = behind_front[ray] =
        static_cast<float>(lists_.weight(ray)) * optical_depth::passing(survivals_[ray].depth);
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
      const bool blocked = survivals_[entry.ray()].depth > 0;
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
