#pragma once
#include "core/file/bytes.hpp"
#include "core/map/occupancy_map.hpp"

namespace nextview {

/// Writes a map's voxels as they are kept. Of bricks whose voxels are all the same one stands for all that are like it.
/// Maps of the same voxels give the same bytes, however they came about.
void write_bricks(ByteWriter& writer, const VoxelBricks& voxels);

/// Reads them into a map of the same grid. @throws std::runtime_error, std::invalid_argument if they are none
void read_bricks(ByteReader& reader, OccupancyMap& map);

}  // namespace nextview
