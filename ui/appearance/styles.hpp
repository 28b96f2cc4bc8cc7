#pragma once

namespace nextview {

// How layers look. Without VTK, so that what chooses them needs none.

enum class MeshStyle {
  solid,
  wire,
  ghost  ///< clear where it faces the viewer, denser towards its outline
};

enum class VoxelColouring {
  by_class,
  by_probability,
  by_entropy,     ///< [nats], 0 to ln 2
  by_difference,  ///< a value per voxel: the Gibbs map's probability minus the conventional one's, -1 to 1
  by_error        ///< a value per voxel: |probability - truth|, 0 to 1
};

enum class CloudColouring {
  single,
  by_view,     ///< from the first view to the last
  by_height,   ///< z in the world [m]
  by_distance  ///< to the true surface [mm]
};

}  // namespace nextview
