#include "ui/workbench/chosen_voxels.hpp"

#include <limits>

#include "core/evaluation/map_quality.hpp"
#include "core/evaluation/voxel_errors.hpp"

namespace nextview {
namespace {

std::vector<float> differences(const SessionSnapshot& s) {
  std::vector<float> values(s.voxels->size(), std::numeric_limits<float>::quiet_NaN());
  const std::vector<Voxel>& gibbs = *s.gibbs->voxels;
  for (std::size_t v = 0; v < values.size(); ++v)
    if (gibbs[v].measured) values[v] = gibbs[v].probability - (*s.voxels)[v].probability;
  return values;
}

}  // namespace

namespace {

const LaidOutVoxels& chosen(const SessionSnapshot& s, MapChoice map) {
  return map == MapChoice::gibbs && s.gibbs ? s.gibbs->voxels : s.voxels;
}

}  // namespace

std::span<const Voxel> chosen_voxels(const SessionSnapshot& s, MapChoice map) { return *chosen(s, map); }

VoxelBricks chosen_bricks(const SessionSnapshot& s, MapChoice map) { return chosen(s, map).bricks(s.grid.size); }

VoxelColouring chosen_colouring(const SessionSnapshot& s, const LayerChoice& choice) {
  if (choice.colouring == VoxelColouring::by_difference && !s.gibbs) return VoxelColouring::by_probability;
  if (choice.colouring == VoxelColouring::by_error && !s.truth) return VoxelColouring::by_class;
  return choice.colouring;
}

CloudColouring chosen_cloud_colouring(const SessionSnapshot& s, const LayerChoice& choice) {
  const bool is_missing = choice.cloud_colouring == CloudColouring::by_distance && !s.truth;
  return is_missing ? CloudColouring::single : choice.cloud_colouring;
}

SurfaceColouring chosen_surface_colouring(const SessionSnapshot& s, const LayerChoice& choice) {
  const bool is_missing = choice.surface_colouring == SurfaceColouring::by_deviation && !s.truth;
  return is_missing ? SurfaceColouring::by_uncertainty : choice.surface_colouring;
}

std::vector<float> chosen_values(const SessionSnapshot& s, const LayerChoice& choice) {
  const VoxelColouring colouring = chosen_colouring(s, choice);
  if (colouring == VoxelColouring::by_difference) return differences(s);
  if (colouring != VoxelColouring::by_error) return {};
  return voxel_errors(probabilities(chosen_voxels(s, choice.map)), *s.truth, TruthConvention::touch);
}

}  // namespace nextview
