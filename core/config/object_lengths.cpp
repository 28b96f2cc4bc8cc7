#include "core/config/object_lengths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/setting/length_text.hpp"
#include "core/setting/rounded.hpp"

namespace nextview {
namespace {

struct FittedLength {
  const char* key;
  double share;  ///< of the longest side
};
constexpr std::array fitted_lengths = {
    FittedLength{"map.region_edge", 2.56},  FittedLength{"planner.ray_length", 3.0},
    FittedLength{"evaluation.d_reg", 0.01}, FittedLength{"sensor.min_range", 0.4},
    FittedLength{"sensor.max_range", 3.0},  FittedLength{"sensor.range_noise", 0.004}};

/// Of 1, 2 and 5 x 10^k the one that is nearest in ratio.
double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  double best = power;
  for (const double step : {2.0, 5.0, 10.0})
    if (std::abs(std::log(length / (step * power))) < std::abs(std::log(length / best))) best = step * power;
  return best;
}

constexpr int digits = 6;  // more are made up by single precision, in which meshes are kept

bool is_given(const Configuration& c, const Setting& setting, const Setting& by_default) {
  const auto fitted = c.fitted.find(setting.key);
  if (fitted != c.fitted.end() && fitted->second == setting.text()) return false;
  const bool of_preset = setting.key.starts_with("sensor.") && c.sources.contains("sensor.preset");
  return of_preset || c.sources.contains(setting.key) || setting.text() != by_default.text();
}

}  // namespace

void fit_lengths(Configuration& configuration, double longest_side) {
  Configuration defaults;
  auto all = settings(configuration), unset = settings(defaults);
  const auto fit = [&](const std::string& key, double length) {
    Setting& setting = find_setting(all, key);
    if (is_given(configuration, setting, find_setting(unset, key))) return;
    // What nobody asked for must not be refused: an object may be very small or large.
    const Bounds& bounds = *setting.bounds;
    *std::get<double*>(setting.value) = std::clamp(rounded(length, digits), bounds.low, bounds.high);
    configuration.fitted[key] = setting.text();
  };
  const double longest = rounded(longest_side, digits);
  const double voxel = round_length(longest / 50.0);
  if (configuration.map.start.empty()) fit("map.resolution", voxel);  // else it is that map's
  fit("map.occlusion_distance", 30.0 * voxel);
  if (configuration.sensor.working_distance > 0.0)
    fit("views.radius", configuration.sensor.working_distance);
  else
    fit("views.radius", 1.8 * longest);
  for (const FittedLength& length : fitted_lengths) fit(length.key, length.share * longest);
  // From farther off, rays get as far behind the object's middle as they do from 1.8 times its size.
  if (const double distance = configuration.sensor.working_distance; distance > 1.8 * longest)
    fit("planner.ray_length", distance + 1.2 * longest);
}

void fit_region(Configuration& configuration, const Eigen::AlignedBox3d& object) {
  std::string& region = configuration.map.region;
  const auto fitted = configuration.fitted.find("map.region");
  const bool is_fitted = fitted != configuration.fitted.end() && fitted->second == region;
  if (!region.empty() && !is_fitted) return;
  if (is_fitted) configuration.fitted.erase(fitted);
  region.clear();
  if (configuration.object.centred) return;  // in the origin, around which the cube lies
  const Vector3 half = Vector3::Constant(0.5 * configuration.map.region_edge);
  const Vector3 low = object.center() - half, high = object.center() + half;
  region =
      fmt::format("{:.7g} {:.7g} {:.7g} {:.7g} {:.7g} {:.7g}", low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
  configuration.fitted["map.region"] = region;
}

std::map<std::string, std::string> lengths_as_fitted(const Configuration& configuration, double longest_side) {
  Configuration fitted, copy = configuration;  // in which nothing was given but what lengths follow from
  fitted.map.start = configuration.map.start;
  fitted.sensor.working_distance = configuration.sensor.working_distance;
  fit_lengths(fitted, longest_side);
  auto all = settings(copy);
  std::map<std::string, std::string> same;
  for (const auto& [key, text] : fitted.fitted)
    if (find_setting(all, key).text() == text) same[key] = text;
  return same;
}

bool is_given(const Configuration& configuration, const std::string& key) {
  Configuration copy = configuration, defaults;
  auto all = settings(copy), unset = settings(defaults);
  return is_given(configuration, find_setting(all, key), find_setting(unset, key));
}

void set_unless_given(Configuration& configuration, const std::string& key, const std::string& text) {
  if (is_given(configuration, key)) return;
  auto all = settings(configuration);
  Setting& setting = find_setting(all, key);
  setting.set(text);
  configuration.fitted[key] = setting.text();
}

void lengthen_rays(Configuration& configuration, std::span<const Pose> T_world_cameras) {
  const Eigen::AlignedBox3d region = configuration.map.region_box();
  double farthest = 0.0;
  for (const Pose& pose : T_world_cameras) farthest = std::max(farthest, (pose.translation() - region.center()).norm());
  const double way = farthest + 0.5 * region.diagonal().norm();
  if (configuration.planner.ray_length < way)
    set_unless_given(configuration, "planner.ray_length", fmt::format("{:.6g}", 1.01 * way));
}

void decide(Configuration& configuration, const std::string& key, const std::string& text, const std::string& owner) {
  auto all = settings(configuration);
  Setting& setting = find_setting(all, key);
  const std::string asked = setting.text();
  setting.set(text);
  const std::string own = setting.text();
  if (configuration.sources.contains(key) && asked != own) {
    setting.set(asked);  // which the message names as it was given
    throw std::invalid_argument(configuration.as_given(
        fmt::format("{}: {} has its own, {}; leave it out", key, owner, own.empty() ? "none" : own)));
  }
}

void decide_camera(Configuration& configuration, const PinholeCamera& camera, const std::string& owner) {
  decide(configuration, "sensor.width", fmt::format("{}", camera.width), owner);
  decide(configuration, "sensor.height", fmt::format("{}", camera.height), owner);
  decide(configuration, "sensor.intrinsics", fmt::format("{} {} {} {}", camera.fx, camera.fy, camera.cx, camera.cy),
         owner);
}

void forget_fitted(Configuration& configuration) {
  Configuration defaults;
  auto all = settings(configuration), unset = settings(defaults);
  for (const auto& [key, text] : configuration.fitted) {
    Setting& setting = find_setting(all, key);
    if (setting.text() != text) continue;
    setting.set(find_setting(unset, key).text());
    // A session's file names all settings: nobody gave this one, nor the sensor that has its lengths.
    configuration.sources.erase(key);
    if (key.starts_with("sensor.") && configuration.sensor_preset == defaults.sensor_preset)
      configuration.sources.erase("sensor.preset");
  }
  configuration.fitted.clear();
}

bool awaits_object(const Configuration& configuration, const std::string& key) {
  return configuration.fitted.empty() && !is_given(configuration, key);
}

double declared_longest_side(const std::filesystem::path& file) { return file == resolve_object("bunny") ? 0.5 : 0.0; }

MeshFileOptions placement(const ObjectConfig& object, const std::filesystem::path& file) {
  const bool own = object.longest_side == 0.0 && object.unit == LengthUnit::automatic;
  return {.longest_side = own ? declared_longest_side(file) : object.longest_side,
          .unit = object.unit,
          .up = object.up,
          .centred = object.centred,
          .ground = object.ground};
}

std::string size_text(const Eigen::AlignedBox3d& box) {
  const Vector3 size = box.sizes();
  const bool small = size.maxCoeff() < 1.0;
  const Vector3 shown = (small ? 1e3 : 1.0) * size;
  return fmt::format("{:.4g} x {:.4g} x {:.4g} {}", shown.x(), shown.y(), shown.z(), small ? "mm" : "m");
}

std::string lengths_text(const Configuration& c) {
  return fmt::format("voxels {}, region {}, views from {}, a camera for {} to {} with {} of noise, d_reg {}",
                     length_text(c.map.resolution),
                     c.map.region.empty() ? length_text(c.map.region_edge) : size_text(c.map.region_box()),
                     length_text(c.views.radius), length_text(c.sensor.min_range), length_text(c.sensor.max_range),
                     length_text(c.sensor.range_noise), length_text(c.evaluation.d_reg));
}

}  // namespace nextview
