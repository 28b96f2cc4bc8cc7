#pragma once
#include <span>

#include "core/config/configuration.hpp"
#include "core/gain/expected_view.hpp"
#include "core/gain/view_score.hpp"
#include "ui/render_target/image.hpp"

namespace nextview {

/// Near is dark, far is pale; nothing is white, and where a ray crosses what is not known it is striped.
/// `depth` [m] of columns x rows cells, negative: nothing. `unknown` may be empty.
Image depth_picture(std::span<const float> depth, std::span<const std::uint8_t> unknown, int columns, int rows,
                    double near, double far);

/// The nearest and the farthest depth of both [m].
std::pair<double, double> depth_range(std::span<const float> a, std::span<const float> b);

/// How the rays of a score lie in the image: which ray a cell has.
struct RayGrid {
  int columns = 0, rows = 0;
  bool column_by_column = false;  ///< the reference bundle's order; otherwise row by row

  /// Of so many rays: those that score a view, or so many times as many each way.
  RayGrid(const PlannerConfig& planner, const PinholeCamera& camera, std::size_t rays);
  std::size_t cells() const { return std::size_t(columns) * rows; }
  std::size_t ray(int column, int row) const {
    return column_by_column ? std::size_t(column) * rows + row : std::size_t(row) * columns + column;
  }
  int column(std::size_t ray) const { return int(column_by_column ? ray / rows : ray % columns); }
  int row(std::size_t ray) const { return int(column_by_column ? ray % rows : ray / columns); }
};

/// A pixel a ray, coloured by what it contributes. @pre there is a ray for each cell
Image contribution_picture(const ScoreExplanation& explanation, const RayGrid& grid);

/// The most that a ray contributes; at least a little over 0.
double largest_contribution(const ScoreExplanation& explanation);

}  // namespace nextview
