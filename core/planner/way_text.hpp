#pragma once
#include <fmt/format.h>

#include <string>

#include "core/map/voxel_grid.hpp"

namespace nextview {

/// What a scan gives its ways in: mm where its region of interest is smaller than half a metre, else m. One unit for
/// all of them, so that those in a sentence, a table and a total can be compared.
struct WayUnit {
  const char* name;
  double per_metre;
};
inline WayUnit way_unit(const VoxelGrid& region) {
  const bool small = region.voxel_count() > 0 && region.box().sizes().maxCoeff() < 0.5;
  return small ? WayUnit{"mm", 1e3} : WayUnit{"m", 1.0};
}

/// A way [m] as people write it, without its unit: to three digits, and whole numbers in full.
inline std::string way_number(double way, const WayUnit& unit) {
  const double number = unit.per_metre * way;
  return number >= 99.95 ? fmt::format("{:.0f}", number) : fmt::format("{:.3g}", number);
}
inline std::string way_text(double way, const VoxelGrid& region) {
  const WayUnit unit = way_unit(region);
  return way_number(way, unit) + " " + unit.name;
}

}  // namespace nextview
