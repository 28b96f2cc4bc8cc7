#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/inspection.hpp"
#include "core/mesh/boundary_loops.hpp"
#include "core/session/refinement.hpp"
#include "core/session/session.hpp"
#include "core/surface/surface.hpp"

namespace nextview {

/// A surface that a scan found, and what is known of it.
struct ScanSurface {
  std::string name;     ///< of its files: "surface_map", "surface_posterior" or "surface_cloud"
  std::string source;   ///< for people: "the occupancy map", …
  std::string caption;  ///< one sentence: how it was made
  Surface surface;
  std::vector<BoundaryLoop> openings;
  std::optional<SurfaceInspection> inspection;  ///< if the true surface is known and something of it was seen
};

/// The surface of the map that views are planned on and that of the cloud, in this order. Either may be empty and then
/// says why. A requested stop leaves out what was not made yet.
std::vector<ScanSurface> scan_surfaces(const Session& session, const Progress& progress = {},
                                       std::stop_token stop = {});
/// The surface of the Gibbs map and that of the cloud.
std::vector<ScanSurface> scan_surfaces(const RefinementJob& job, const Refinement& refinement,
                                       const Progress& progress = {}, std::stop_token stop = {});

/// For people: "of the point cloud: 728818 triangles, 12 openings, …", with the distance to the truth if it is known.
std::string summary(const ScanSurface& surface);

/// Removes what write_surfaces, and the pictures of it, have left in a folder: they would not belong to what is written
/// there next.
void remove_surfaces(const std::filesystem::path& folder);

/// Removes those of an earlier scan, then writes NAME.ply (metres, coloured by uncertainty) and NAME.stl (millimetres)
/// of each surface that is not empty, and surfaces.json: sizes, openings, distances to the true surface. Without
/// surfaces nothing. @throws std::runtime_error naming the file and the reason.
void write_surfaces(std::span<const ScanSurface> surfaces, const std::filesystem::path& folder);

}  // namespace nextview
