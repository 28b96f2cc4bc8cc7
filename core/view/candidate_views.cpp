#include "core/view/candidate_views.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/file/read_file.hpp"
#include "core/view/projection_matrix.hpp"

namespace nextview {
namespace {

constexpr double pi = std::numbers::pi;

Vector3 on_sphere(double elevation, double azimuth) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

/// Shares `count` views among rings in proportion to `weights`; the largest remainders get the views left over.
std::vector<int> share_out(int count, const std::vector<double>& weights) {
  double total = 0.0;
  for (double w : weights) total += w;
  std::vector<int> shares;
  double cumulated = 0.0;
  int given = 0;
  for (double w : weights) {
    cumulated += w;
    const int upto = static_cast<int>(std::lround(count * cumulated / total));
    shares.push_back(upto - given);
    given = upto;
  }
  return shares;
}

/// Rings at the given elevations [rad], each with its share of the views; every other ring is turned by half a step.
std::vector<Vector3> on_rings(const std::vector<double>& elevations, const std::vector<int>& shares) {
  std::vector<Vector3> directions;
  for (std::size_t ring = 0; ring < elevations.size(); ++ring)
    for (int i = 0; i < shares[ring]; ++i)
      directions.push_back(on_sphere(elevations[ring], 2.0 * pi * (i + 0.5 * (ring % 2)) / shares[ring]));
  return directions;
}

/// Latitude rings as far apart as neighbours on a ring, from `lowest` [rad] to the pole.
std::vector<Vector3> latitude_rings(int count, double lowest) {
  const double area = 2.0 * pi * (1.0 - std::sin(lowest)) / count;
  const int rings = std::max(1, static_cast<int>(std::lround((pi / 2 - lowest) / std::sqrt(area))));
  std::vector<double> elevations, weights;
  for (int r = 0; r < rings; ++r) {
    elevations.push_back(lowest + (pi / 2 - lowest) * (r + 0.5) / rings);
    weights.push_back(std::cos(elevations.back()));
  }
  return on_rings(elevations, share_out(count, weights));
}

std::vector<Vector3> fibonacci(int count) {
  const double golden_angle = pi * (3.0 - std::sqrt(5.0));
  std::vector<Vector3> directions;
  directions.reserve(std::size_t(count));
  for (int i = 0; i < count; ++i)
    directions.push_back(on_sphere(std::asin(1.0 - (2.0 * i + 1.0) / count), golden_angle * i));
  return directions;
}

std::vector<Vector3> equal_rings(int count, int rings) {
  std::vector<double> elevations;
  elevations.reserve(std::size_t(rings));
  for (int r = 0; r < rings; ++r) elevations.push_back(rings == 1 ? 0.0 : (pi / 3) * (2.0 * r / (rings - 1) - 1.0));
  return on_rings(elevations, share_out(count, std::vector<double>(rings, 1.0)));
}

/// The cameras of projection matrices where the object was put.
std::vector<Pose> placed_projections(const CandidateViewsConfig& config,
                                     const std::function<void(const std::string&)>& notice) {
  constexpr double farthest = 1000.0;  // [m]
  ProjectionPlacement placement = config.projections;
  if (!(placement.scale > 0.0)) {
    if (config.unit == LengthUnit::automatic)
      throw std::invalid_argument(fmt::format(
          "views.unit must be set for the projection matrices of {}: there is no object whose unit they share",
          config.file));
    placement = {Vector3::Zero(), metres_per(config.unit)};
  }
  std::vector<Pose> views = read_projections(config.file, notice);
  for (Pose& view : views) {
    view.translation() = with_z_up(placement.up, placement.scale * (view.translation() - placement.centre));
    for (int axis = 0; axis < 3; ++axis) view.linear().col(axis) = with_z_up(placement.up, view.linear().col(axis));
    if (!(view.translation().norm() <= farthest))
      throw std::runtime_error(
          fmt::format("{}: a camera lies {:.3g} m off, more than {:g} m; views.unit sets the unit of its projection "
                      "matrices",
                      config.file, view.translation().norm(), farthest));
  }
  return views;
}

std::vector<Pose> views_of_file(const CandidateViewsConfig& config,
                                const std::function<void(const std::string&)>& notice) {
  std::error_code ignored;
  if (std::filesystem::is_directory(config.file, ignored)) return placed_projections(config, notice);
  constexpr std::uintmax_t largest = std::uintmax_t{1} << 25;
  return has_projections(read_file(config.file, largest)) ? placed_projections(config, notice)
                                                          : read_views(config.file);
}

}  // namespace

std::vector<Setting> settings(CandidateViewsConfig& c) {
  return {
      {"views.layout", "", "how candidate views are laid out",
       choice(c.layout, {"hemisphere", "sphere", "rings", "fibonacci", "file", "adaptive"})},
      {"views.count", "", "number of candidate views", &c.count, from_to(1, 10000)},
      {"views.radius", "m", "their distance from the object's centre", &c.radius, from_to(1e-3, 100)},
      {"views.rings", "", "number of rings (layout rings)", &c.rings, from_to(1, 10000)},
      {"views.file", "",
       "views file (layout file): x y z qx qy qz qw a line, as export writes it; or a file or folder of 3 x 4 "
       "projection matrices",
       &c.file},
      {"views.unit", "", "of projection matrices; auto: that of the object's file",
       choice(c.unit, {"auto", "m", "mm", "cm", "inch"})},
      {"views.adaptive", "", "views made from the map at each step, beside those of a sphere (layout adaptive)",
       &c.adaptive, from_to(1, 1000)},
  };
}

void CandidateViewsConfig::validate() const {
  require_in_bounds(*this);
  if (layout == ViewLayout::file && file.empty())
    throw std::invalid_argument("views.file must name a views file where views.layout is file");
  if (layout == ViewLayout::rings && rings > count)
    throw std::invalid_argument(fmt::format("views.rings, {}, must be at most views.count, {}", rings, count));
}

std::vector<Pose> candidate_views(const CandidateViewsConfig& config, const Vector3& target,
                                  const std::function<void(const std::string&)>& notice) {
  config.validate();
  if (config.layout == ViewLayout::file) return views_of_file(config, notice);
  const auto directions = config.layout == ViewLayout::hemisphere  ? latitude_rings(config.count, 0.0)
                          : config.layout == ViewLayout::rings     ? equal_rings(config.count, config.rings)
                          : config.layout == ViewLayout::fibonacci ? fibonacci(config.count)
                                                                   : latitude_rings(config.count, -pi / 2);
  std::vector<Pose> views;
  views.reserve(directions.size());
  for (const Vector3& direction : directions) views.push_back(look_at(target + config.radius * direction, target));
  return views;
}

}  // namespace nextview
