#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ui/appearance/colour_map.hpp"

namespace nextview {

/// What the colours of a layer mean. Named colours, or a colour map with its range, or both.
struct Legend {
  struct Swatch {
    std::string name;
    Colour colour;
    std::optional<Colour> stripes = {};  ///< across it, if it is striped
  };
  struct Range {
    ColourMap map;
    double low, high;
    std::string unit;                           ///< empty: dimensionless
    std::string low_name = {}, high_name = {};  ///< what the ends mean, if it needs saying
  };
  std::string title;
  std::vector<Swatch> swatches;
  std::optional<Range> range;
  bool locked = false;  ///< the range stays from step to step; said beside the title
};

/// From where to where a colour map goes, in the unit of what it shows.
using ValueRange = std::pair<double, double>;

/// A word at a place in the scene; drawn above everything. Of several places, the lowest in the picture is taken.
struct Label {
  std::vector<Eigen::Vector3d> places;  ///< [m, world]
  std::string text;
  Colour colour;
  bool strong = false;
  double room = std::numeric_limits<double>::infinity();  ///< left away behind what is farther before its place [m]
};

}  // namespace nextview
