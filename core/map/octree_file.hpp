#pragma once
#include <filesystem>

#include "core/map/occupancy_map.hpp"

namespace nextview {

/// Writes OctoMap's .ot (full: log-odds) or .bt (binary: the maximum-likelihood map), pruned, by the file's extension.
/// Atomic (AtomicFile).
/// @throws std::runtime_error naming the file and the reason.
void write_octree(const OccupancyMap& map, const std::filesystem::path& file);

/// Reads .ot or .bt; of coloured trees (ColorOcTree) all but the colours. The grid is the smallest box that holds the
/// tree's leaves. The model's hit, miss and clamps are taken as given: the formats do not keep them.
/// @throws std::runtime_error naming the file and the reason: missing, not an octree, truncated, too large to hold
/// densely.
OccupancyMap read_octree(const std::filesystem::path& file, const InverseSensorModel& model = {});

}  // namespace nextview
