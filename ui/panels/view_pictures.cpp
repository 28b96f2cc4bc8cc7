#include "ui/panels/view_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "core/session/session_parts.hpp"
#include "ui/appearance/colour_map.hpp"

namespace nextview {
namespace {

void set_pixel(Image& image, std::size_t i, const Colour& colour) {
  for (std::size_t c = 0; c < 3; ++c) image.rgba[4 * i + c] = static_cast<std::uint8_t>(std::lround(255 * colour[c]));
  image.rgba[4 * i + 3] = 255;
}

Image blank(int columns, int rows) {
  return {columns, rows, std::vector<std::uint8_t>(std::size_t(columns) * rows * 4, 255)};
}

constexpr int stripe_spacing = 4;  // [cells]

}  // namespace

Image depth_picture(std::span<const float> depth, std::span<const std::uint8_t> unknown, int columns, int rows,
                    double near, double far) {
  Image image = blank(columns, rows);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const int column = int(i) % columns, row = int(i) / columns;
    const bool stripe = !unknown.empty() && unknown[i] && (column + row) % stripe_spacing == 0;
    const double place = far > near ? (depth[i] - near) / (far - near) : 0.5;
    const Colour colour =
        depth[i] < 0 ? theme::paper : mix(theme::cloud, theme::sky, 0.1 + 0.8 * std::clamp(place, 0.0, 1.0));
    set_pixel(image, i, stripe ? mix(colour, theme::unknown, 0.8) : colour);
  }
  return image;
}

std::pair<double, double> depth_range(std::span<const float> a, std::span<const float> b) {
  double near = 1e9, far = 0;
  for (const auto depths : {a, b})
    for (const float depth : depths) {
      if (depth < 0) continue;
      near = std::min(near, double(depth));
      far = std::max(far, double(depth));
    }
  return far > 0 ? std::pair(near, far) : std::pair(0.0, 1.0);
}

double largest_contribution(const ScoreExplanation& explanation) {
  double largest = 1e-12;
  for (const auto& ray : explanation.rays) largest = std::max(largest, ray.contribution);
  return largest;
}

RayGrid::RayGrid(const PlannerConfig& planner, const PinholeCamera& camera, std::size_t rays)
    : columns(planner.ray_columns), rows(planner.ray_rows) {
  if (planner.semantics != Semantics::reference) {
    const int times = int(std::lround(std::sqrt(double(rays) / double(cells()))));
    columns *= times, rows *= times;
    return;
  }
  column_by_column = true;
  Configuration configuration;
  configuration.planner = planner;
  const RayBundle bundle = scoring_rays(configuration, camera);
  const auto same_column = [&](const Vector3& a) {
    return std::abs(a.x() / a.z() - bundle.directions[0].x() / bundle.directions[0].z()) < 1e-9;
  };
  rows = int(std::count_if(bundle.directions.begin(), bundle.directions.end(), same_column));
  columns = int(bundle.directions.size()) / std::max(rows, 1);
}

Image contribution_picture(const ScoreExplanation& explanation, const RayGrid& grid) {
  const double largest = largest_contribution(explanation);
  const ColourMap map = ColourMap::contribution();
  Image image = blank(grid.columns, grid.rows);
  for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
    const int column = int(cell) % grid.columns, row = int(cell) / grid.columns;
    const double value = explanation.rays[grid.ray(column, row)].contribution;
    set_pixel(image, cell, value > 0 ? map.at(value, 0, largest) : theme::paper);
  }
  return image;
}

}  // namespace nextview
