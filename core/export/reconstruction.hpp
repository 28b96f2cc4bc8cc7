#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/evaluation/surface_error.hpp"
#include "core/export/export_kind.hpp"
#include "core/map/voxel_bricks.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/mesh/boundary_loops.hpp"
#include "core/progress/progress.hpp"
#include "core/surface/cloud_surface.hpp"
#include "core/surface/surface.hpp"

namespace nextview {

/// A surface that a scan found, and what is known of it.
struct ScanSurface {
  std::string name;     ///< of its files: "surface_map", "surface_posterior" or "surface_cloud"
  std::string source;   ///< for people: "the occupancy map", …
  std::string caption;  ///< one sentence: how it was made
  Surface surface;
  std::vector<BoundaryLoop> openings;
  std::optional<SurfaceError> surface_error;  ///< if the true surface is known and something of it was seen
  bool truth_is_open = false;                 ///< its mesh has borders: what lies inside of it is a guess
};

/// What surfaces are made of, and compared with.
struct ReconstructionInput {
  const VoxelGrid& grid;
  VoxelBricks voxels;                          ///< of the grid
  std::optional<double> prior = {};            ///< if the voxels are a Gibbs map's: of a voxel being occupied
  std::vector<const Scan*> scans = {};         ///< none null
  const TriangleMesh* true_mesh = nullptr;     ///< null: not known; nor are the samples then
  const SurfaceSamples* samples = nullptr;     ///< of the true surface
  std::span<const std::uint8_t> visible = {};  ///< one per sample, 1: some candidate sees it
  bool on_ground = false;                      ///< the true mesh stands on a plane that was scanned with it
};

/// The map's surface and the cloud's, in this order, compared with the truth if that is known. Either may be empty and
/// then says why. A requested stop leaves out what was not made yet.
std::vector<ScanSurface> scan_surfaces(const ReconstructionInput& input, const Progress& progress = {},
                                       std::stop_token stop = {});
/// One of the two, compared with the truth if that is known. @throws Stopped
ScanSurface scan_surface(const ReconstructionInput& input, SurfaceSource source, const Progress& progress = {},
                         const std::stop_token& stop = {});

/// For people, how far it is closed, and how much of it was seen: "watertight, all of it seen: 0.785 m²"; "closed, but
/// only 21 % of it was seen: 0.061 m² seen, 0.226 m² is the hull of what no ray met"; "3 openings, the longest …". A
/// surface is called watertight only if all of it was seen.
std::string closedness(const Surface& surface, std::span<const BoundaryLoop> openings);
/// For people: "of the point cloud: 728818 triangles, 12 openings, …", with the distance to the truth if it is known.
std::string summary(const ScanSurface& surface);

}  // namespace nextview
