#include "ui/layers/voxel_palette.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nextview {
namespace {

constexpr int shades = 512;  // along a colour map: more than the eye tells apart

std::optional<Legend::Range> range_of(VoxelColouring colouring) {
  switch (colouring) {
    case VoxelColouring::by_class:
      return {};
    case VoxelColouring::by_probability:
      return Legend::Range{ColourMap::probability(), 0.0, 1.0, ""};
    case VoxelColouring::by_entropy:
      return Legend::Range{ColourMap::uncertainty(), 0.0, std::numbers::ln2, "nats", "", "undecided"};
    case VoxelColouring::by_difference:
      return Legend::Range{ColourMap::deviation(), -1.0, 1.0, "", "freer", "fuller"};
    case VoxelColouring::by_error:
      return Legend::Range{ColourMap::error(), 0.0, 1.0, "", "right", "wrong"};
  }
  return {};
}

std::string title_of(VoxelColouring colouring) {
  switch (colouring) {
    case VoxelColouring::by_class:
      return "voxels";
    case VoxelColouring::by_probability:
      return "occupancy probability";
    case VoxelColouring::by_entropy:
      return "entropy of a voxel";
    case VoxelColouring::by_difference:
      return "p, Gibbs − conventional";
    case VoxelColouring::by_error:
      return "error |p − truth|";
  }
  return "";
}

}  // namespace

const Colour valueless_voxel = mix(theme::object, theme::paper, 0.25);
const Colour valueless_voxel_stripes = mix(theme::object, theme::ink, 0.4);

VoxelPalette::VoxelPalette(VoxelColouring colouring) : colouring_(colouring), range_(range_of(colouring)) {
  if (range_) {
    for (int i = 0; i < shades; ++i) colours_.push_back(range_->map.at(i / double(shades - 1)));
  } else {
    colours_ = {theme::unknown, theme::free, theme::occupied};  // in the order of VoxelClass
  }
}

std::optional<Colour> VoxelPalette::colour(const Voxel& voxel, float value) const {
  if (!range_) return colours_[std::size_t(voxel.voxel_class)];
  const double shown = colouring_ == VoxelColouring::by_probability ? voxel.probability
                       : colouring_ == VoxelColouring::by_entropy   ? voxel.entropy
                                                                    : value;
  if (std::isnan(shown)) return {};
  const double place = std::clamp((shown - range_->low) / (range_->high - range_->low), 0.0, 1.0);
  return colours_[std::size_t(std::lround(place * (shades - 1)))];
}

Legend VoxelPalette::legend(const VoxelFilter& filter, bool valueless) const {
  if (!range_) return class_legend(filter);
  Legend legend{title_of(colouring_), {}, range_};
  if (valueless) {
    const char* name = colouring_ == VoxelColouring::by_error ? "no truth" : "no value";
    legend.swatches.push_back({name, valueless_voxel, valueless_voxel_stripes});
  }
  return legend;
}

Legend VoxelPalette::class_legend(const VoxelFilter& filter) const {
  Legend legend{title_of(colouring_), {}, {}};
  if (filter.uncertain) legend.title = fmt::format("voxels of {:.2g} nats and more", filter.entropy_from);
  if (filter.occupied || filter.uncertain) legend.swatches.push_back({"occupied", theme::occupied});
  if (filter.unknown || filter.uncertain) {
    const bool bounded = filter.unknown_from > 0 && !filter.uncertain;
    const std::string bound = bounded ? fmt::format(", p ≥ {:g}", filter.unknown_from) : "";
    legend.swatches.push_back({"measured but unknown" + bound, theme::unknown});
  }
  if (filter.free || filter.uncertain) legend.swatches.push_back({"free", theme::free});
  return legend;
}

}  // namespace nextview
