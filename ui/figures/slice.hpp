#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "ui/charts/page.hpp"
#include "ui/figures/grid_slice.hpp"

namespace nextview {

/// What a voxel's colour says.
enum class SliceValue {
  probability,  ///< of being occupied
  entropy,      ///< [nats]
  difference    ///< of the probability from that in another map
};

/// A word at a place, for example at an opening.
struct SliceLabel {
  Vector3 place;  ///< [m, world]; what it has of the slice's axis does not matter
  std::string text;
};

/// A slice of a map as a picture. Pointers and spans need to live while it is drawn only.
struct SliceContent {
  std::string title;
  VoxelGrid grid;
  GridSlice slice;
  SliceValue value = SliceValue::probability;
  std::span<const Voxel> voxels;  ///< one per voxel of the grid
  std::span<const Voxel> other;   ///< `difference` only: what is subtracted
  std::string value_name = "P(occupied)";
  /// Of voxels that are hatched: no measurement says anything of them. Of a difference: of either map.
  std::string unmeasured_name = "not measured";
  const TriangleMesh* object = nullptr;  ///< the true surface, drawn as a line; if known
  std::vector<SliceLabel> labels;        ///< those outside of the slice are left out
};

/// Each voxel as a square of `edge` [px], not blurred, hatched if not measured. From 8 px on a faint line parts them.
/// @throws std::invalid_argument if the slice or the numbers of voxels do not fit the grid.
Image slice_squares(const SliceContent& content, int edge);

/// A panel with the slice, the line of the true surface, the meaning of the colours, and a scale bar.
/// @throws std::invalid_argument as slice_squares, or if the panel is too small for one pixel a voxel.
void paint_slice(vtkContext2D& context, const PageArea& panel, const SliceContent& content);

}  // namespace nextview
