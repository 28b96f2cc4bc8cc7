#pragma once
#include <span>
#include <vector>

#include "ui/workbench/layer_choice.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// The voxels that the user has chosen to see: the conventional map's, or the Gibbs map's if there is one.
std::span<const Voxel> chosen_voxels(const SessionSnapshot& snapshot, MapChoice map);
/// As that map keeps them.
VoxelBricks chosen_bricks(const SessionSnapshot& snapshot, MapChoice map);

/// What their colours say: without a Gibbs map there is no difference to it, and they are coloured by probability;
/// without a truth no error, and they are coloured by class.
VoxelColouring chosen_colouring(const SessionSnapshot& snapshot, const LayerChoice& choice);
/// Likewise of the points, and of the surface: what needs a truth is left out where there is none.
CloudColouring chosen_cloud_colouring(const SessionSnapshot& snapshot, const LayerChoice& choice);
SurfaceColouring chosen_surface_colouring(const SessionSnapshot& snapshot, const LayerChoice& choice);

/// One per voxel, for the colourings that need values: Gibbs minus conventional probability, or the chosen map's error.
/// Not a number where one of both says nothing; empty for other colourings, and without a truth.
std::vector<float> chosen_values(const SessionSnapshot& snapshot, const LayerChoice& choice);

}  // namespace nextview
