#pragma once
#include "core/export/export_kind.hpp"
#include "ui/appearance/styles.hpp"
#include "ui/appearance/voxel_filter.hpp"

namespace nextview {

enum class MapChoice { conventional, gibbs };

/// What the reconstructed surface's colours say.
enum class SurfaceColouring {
  by_deviation,    ///< how far it lies from the true one; without a truth, the next
  by_uncertainty,  ///< how far it may lie off, by those who make it
  single
};

/// What is shown in a second scene beside the first.
enum class SecondView { none, object, surface, cloud, octree, gibbs, missed };

/// What of a session the scene shows, and how.
struct LayerChoice {
  bool object = true, octree = true, views = true, rays = true;
  bool cloud = false;  ///< within the voxels it would be specks
  bool region = false, missed = false;
  bool surface = false;                             ///< reconstructed
  bool cloud_before = false, octree_before = true;  ///< what these two put aside, as it would hide them
  bool surface_aside = false;                       ///< the surface was shown before two branches were compared
  bool all_candidates = false;                      ///< not only the best ones
  bool legends = true;
  MeshStyle object_style = MeshStyle::ghost;
  CloudColouring cloud_colouring = CloudColouring::single;
  MapChoice map = MapChoice::conventional;
  VoxelColouring colouring = VoxelColouring::by_class;
  SurfaceSource surface_source = SurfaceSource::cloud;
  SurfaceColouring surface_colouring = SurfaceColouring::by_deviation;
  VoxelFilter voxels;
  std::optional<Section> section{};  ///< of all that is solid
  SecondView second = SecondView::none;
  bool ranges_locked = false;  ///< colour ranges stay as they were when this was switched on

  /// The voxels that are drawn.
  VoxelFilter shown_voxels() const {
    VoxelFilter filter = voxels;
    filter.section = section;
    return filter;
  }
  /// Shows or hides the surface or the missed one, without what would hide it.
  void show_alone(bool LayerChoice::*which, bool shown);
  /// The surface would be one branch's only: it is put aside while two are compared.
  void follow_comparison(bool compared);
  /// What the second scene shows of it.
  LayerChoice of_second() const;
};

}  // namespace nextview
