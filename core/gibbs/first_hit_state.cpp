#include "core/gibbs/first_hit_state.hpp"

namespace nextview {

FirstHitState::FirstHitState(const RayLists& lists, const ForwardSensorModel&) : lists_(lists) {}

std::size_t FirstHitState::bytes() const { return map_.size() + first_.size() * sizeof(first_[0]); }

void FirstHitState::reset(std::vector<std::uint8_t> map) {
  map_ = std::move(map);
  first_.resize(lists_.rays());
  for (std::uint32_t ray = 0; ray < lists_.rays(); ++ray)
    first_[ray] = first_occupied(ray, lists_.incidences_begin(ray));
}

std::uint32_t FirstHitState::first_occupied(std::uint32_t ray, std::uint32_t from) const {
  const std::uint32_t end = lists_.incidences_end(ray);
  while (from < end && map_[lists_.incidence(from).voxel] == 0) ++from;
  return from;
}

/// log p(z | f): `first` is an incidence, or the ray's end.
float FirstHitState::value(std::uint32_t ray, std::uint32_t first) const {
  return first < lists_.incidences_end(ray) ? lists_.incidence(first).value : lists_.open_value(ray);
}

double FirstHitState::change(std::uint32_t voxel, std::uint8_t level) {
  if (map_[voxel] == level) return 0.0;
  map_[voxel] = level;
  double change = 0.0;
  for (const RayLists::NearEntry entry : lists_.near(voxel)) {
    std::uint32_t& first = first_[entry.ray];
    const std::uint32_t now = level > 0                  ? std::min(first, entry.incidence)
                              : first == entry.incidence ? first_occupied(entry.ray, entry.incidence + 1)
                                                         : first;
    if (now == first) continue;
    change += lists_.evidence(entry.ray) * (double(value(entry.ray, now)) - value(entry.ray, first));
    first = now;
  }
  return change;
}

bool FirstHitState::conditional(std::uint32_t voxel, double, std::span<double> log_weights) const {
  for (const RayLists::NearEntry entry : lists_.near(voxel)) {
    const std::uint32_t first = first_[entry.ray];
    if (first < entry.incidence) continue;  // hidden: the ray does not care
    const std::uint32_t next = first == entry.incidence ? first_occupied(entry.ray, entry.incidence + 1) : first;
    // A term of the sum in Eq. 8.
    log_weights[0] +=
        lists_.evidence(entry.ray) * (double(lists_.incidence(entry.incidence).value) - value(entry.ray, next));
  }
  return false;
}

double FirstHitState::log_likelihood() const {
  double sum = 0.0;
  for (std::uint32_t ray = 0; ray < lists_.rays(); ++ray) sum += lists_.evidence(ray) * double(value(ray, first_[ray]));
  return sum;
}

void FirstHitState::add_reach(std::vector<float>& reach, float) const {
  for (std::uint32_t ray = 0; ray < lists_.rays(); ++ray)
    for (std::uint32_t incidence = lists_.incidences_begin(ray);
         incidence < lists_.incidences_end(ray) && incidence <= first_[ray]; ++incidence)
      reach[lists_.incidence(incidence).voxel] += lists_.weight(ray);
}

}  // namespace nextview
