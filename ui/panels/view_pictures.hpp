#pragma once
#include <span>

#include "core/gain/expected_view.hpp"
#include "core/gain/view_score.hpp"
#include "ui/surface/image.hpp"

namespace nextview {

/// Near is dark, far is pale; nothing is white, and where a ray crosses what is not known it is striped.
/// `depth` [m] of columns x rows cells, negative: nothing. `unknown` may be empty.
Image depth_picture(std::span<const float> depth, std::span<const std::uint8_t> unknown, int columns, int rows,
                    double near, double far);

/// The nearest and the farthest depth of both [m].
std::pair<double, double> depth_range(std::span<const float> a, std::span<const float> b);

/// A pixel a ray, coloured by what it contributes; `columns` rays a row.
Image contribution_picture(const ScoreExplanation& explanation, int columns);

/// The most that a ray contributes; at least a little over 0.
double largest_contribution(const ScoreExplanation& explanation);

}  // namespace nextview
