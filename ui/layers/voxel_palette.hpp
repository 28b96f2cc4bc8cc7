#pragma once
#include <optional>
#include <vector>

#include "ui/appearance/legend.hpp"
#include "ui/appearance/styles.hpp"
#include "ui/appearance/voxel_filter.hpp"

namespace nextview {

/// The colours of voxels, quickly, and what they mean.
class VoxelPalette {
 public:
  explicit VoxelPalette(VoxelColouring colouring);

  /// Of a voxel with this value; none if it has none (not a number) and is coloured by it.
  std::optional<Colour> colour(const Voxel& voxel, float value) const;
  /// `valueless`: some voxels have no value.
  Legend legend(const VoxelFilter& filter, bool valueless) const;

 private:
  Legend class_legend(const VoxelFilter& filter) const;

  VoxelColouring colouring_;
  std::optional<Legend::Range> range_;
  std::vector<Colour> colours_;  ///< along the range, or by class
};

/// Voxels without a value are striped with these.
extern const Colour valueless_voxel, valueless_voxel_stripes;

}  // namespace nextview
