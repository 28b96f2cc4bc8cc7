#include "core/config/configuration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/config/object_lengths.hpp"
#include "core/planner/gain_policies.hpp"
#include "core/setting/length_text.hpp"
#include "core/setting/rounded.hpp"

namespace nextview {
namespace {

void require(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument(what);
}

/// Whether lengths can be compared with each other: the object sets those that were not given when it is opened.
bool are_settled(const Configuration& c, std::initializer_list<const char*> lengths) {
  return std::none_of(lengths.begin(), lengths.end(), [&](const char* key) { return awaits_object(c, key); });
}

/// To two digits. @pre length > 0
double rounded_up(double length) {
  const double unit = std::pow(10.0, std::floor(std::log10(length)) - 1.0);
  return std::ceil(length / unit - 1e-9) * unit;
}

void require_region_cube(const Configuration& c) {
  if (!are_settled(c, {"map.region_edge", "map.resolution"})) return;
  const double edge = c.map.region_edge, voxels = edge / c.map.resolution;
  const std::string fits = voxels < 1.0 ? length_text(edge) + " or smaller"
                                        : length_text(rounded_up(edge / most_voxels_along_side)) + " or larger";
  require(voxels >= 1.0 && voxels <= most_voxels_along_side,
          fmt::format("map.region_edge / map.resolution must be from 1 to {} voxels, not {}: make voxels {}",
                      most_voxels_along_side, rounded(voxels, 6), fits));
}

void require_region(const Configuration& c) {
  const MapConfig& map = c.map;
  if (map.region.empty()) return require_region_cube(c);
  const Eigen::AlignedBox3d box = map.region_box();
  require(box.sizes().minCoeff() > 0.0, fmt::format("map.region, {}, must be a box with a volume", map.region));
  const bool settled = are_settled(c, {"map.resolution"});
  const Vector3 voxels = box.sizes() / map.resolution;
  require(!settled || (voxels.minCoeff() >= 1.0 - 1e-6 && voxels.maxCoeff() <= most_voxels_along_side + 1e-6),
          fmt::format("map.region, {}, must be from 1 to {} voxels of {} m along each side", map.region,
                      most_voxels_along_side, map.resolution));
  const double farthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  const double limit = settled ? std::min(1000.0, 32768.0 * map.resolution) : 1000.0;
  require(farthest <= limit, fmt::format("map.region, {}, must lie within {} m of the origin", map.region, limit));
}

/// All that Configuration::validate checks, in the words of the declarations.
void require_valid(const Configuration& c) {
  require_in_bounds(c);
  c.sensor.camera();
  if (are_settled(c, {"sensor.min_range", "sensor.max_range"})) c.sensor.validate();
  c.views.validate();
  c.map.model.validate();
  c.gibbs.validate();
  c.planner.validate();
  c.driver.volume();
  c.driver.T_flange_camera();
  require_region(c);
  require(!make_policy(c.planner)->needs().true_surface || c.evaluation.enabled,
          fmt::format("planner.gain {} knows the mesh: it needs evaluation.enabled", c.planner.gain));
  require(c.termination.coverage == 0.0 || c.evaluation.enabled,
          "termination.coverage is a share of the true surface: it needs evaluation.enabled");
  require(!c.map.model.range_dependent() || c.planner.semantics == Semantics::published,
          "map.hit_decay and map.miss_decay must be 0 with planner.semantics reference, whose map knows no range");
}

}  // namespace

PosteriorSamplerConfig posterior_sampler_config(const Configuration& c) {
  return posterior_sampler_config(c.gibbs, c.sensor.range_noise, ray_pitch(c.sensor), c.map.resolution, c.seed);
}

void Configuration::validate() const {
  try {
    require_valid(*this);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(as_given(error.what()));
  }
}

std::string Configuration::as_given(const std::string& message) const {
  Configuration copy = *this;
  SettingSources still;
  for (const Setting& setting : settings(copy))
    if (const auto source = sources.find(setting.key); source != sources.end() && source->second.text == setting.text())
      still.insert(*source);
  return nextview::as_given(message, still);
}

}  // namespace nextview
