#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/gibbs/sampler_diagnostics.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/mesh/parts.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "ui/figures/grid_slice.hpp"
#include "ui/render_target/render_target.hpp"

namespace nextview {

/// A number before and after the refinement, as it is to be read: "0.321", "23 of 45".
struct RefinementNumber {
  std::string label;
  std::string before, after;
  std::string unit;  ///< may be empty
};

/// All that one picture of a refinement shows. Pointers and spans need to live while it is drawn only.
struct RefinementPicture {
  std::string title;
  std::string remark;   ///< beside the title: how the maps came about
  std::string caption;  ///< one sentence: what is to be seen
  VoxelGrid grid;
  std::span<const Voxel> conventional;   ///< one per voxel of the grid
  std::span<const Voxel> gibbs;          ///< likewise: GibbsPosterior::voxels, where measured means informed
  SamplerDiagnostics diagnostics;        ///< of the chains
  const TriangleMesh* object = nullptr;  ///< the true object, if known
  std::vector<Opening> openings;         ///< of the true object, if it has any; where the maps are looked at
  std::optional<GridSlice> slice;        ///< otherwise default_slice
  std::vector<RefinementNumber> numbers;
  std::string numbers_note;  ///< beneath them: what they are
};

/// Across the first opening; without one, the layer in which the maps differ most.
GridSlice default_slice(const RefinementPicture& picture);

/// The map refined by the Gibbs sampler beside the conventional one, as for a paper: three slices (both maps and their
/// difference), what stays uncertain, the chains, and numbers. Drawn in the target, whatever its size.
/// @throws std::invalid_argument if the numbers of voxels are not the grid's, or the slice is not within it.
Image draw_refinement_figure(RenderTarget& target, const RefinementPicture& picture);

}  // namespace nextview
