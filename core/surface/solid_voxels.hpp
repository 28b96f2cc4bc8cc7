#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/map/bit_mask.hpp"
#include "core/map/voxel_bricks.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// From here on a voxel is occupied, and a point inside.
inline constexpr float solid_from = 0.5f;

/// Which voxels count as measured: all that are, or those of a Gibbs map whose odds the measurements have moved by more
/// than a factor of two from those of the `prior` probability. Rays reach into walls that attenuate them weakly and say
/// nothing there; taken for free, walls would be hollow.
class DecidedVoxels {
 public:
  explicit DecidedVoxels(std::optional<double> prior = {});
  bool operator()(const Voxel& voxel) const {
    return voxel.measured && !(voxel.probability > low_ && voxel.probability < high_);
  }

 private:
  double low_ = 1.0, high_ = 0.0;  ///< between them voxels are undecided
};

/// The part of a map around what is occupied, beyond which nothing is solid: two voxels of it on each side, unless the
/// map ends there.
struct SolidPart {
  VoxelGrid grid;
  Eigen::Vector3i offset;    ///< of its first voxel in the map
  std::vector<float> solid;  ///< of each voxel how solid it is, from 0 to 1
  BitMask measured;
};

/// How solid voxels are: their probability; 1 where nothing was measured. Cleaned of what no surface of the object can
/// be, see map_surface; `decided` says which of them count as measured. None if no measured one is occupied.
std::optional<SolidPart> solid_part(const VoxelGrid& grid, const VoxelBricks& voxels, const DecidedVoxels& decided);

/// What a voxel is part of.
enum class Wall : std::uint8_t {
  none,   ///< nothing solid
  thick,  ///< among eight solid voxels around a corner: a block
  thin,   ///< in no block: a wall one voxel thin
  step,   ///< beside a thin voxel, in a block whose voxels are in no other: where a thin wall steps to the next layer
  speck   ///< in no block, one of fewer than four on something thick: where that barely touches the next voxel
};
std::vector<Wall> wall_voxels(const VoxelGrid& grid, std::span<const float> solid);

}  // namespace nextview
