#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/surface_error.hpp"
#include "core/export/export_kind.hpp"
#include "core/mesh/boundary_loops.hpp"
#include "core/offline/refinement.hpp"
#include "core/results/output_folder.hpp"
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
  std::optional<SurfaceError> surface_error;  ///< if the true surface is known and something of it was seen
};

/// The surface of the map that views are planned on and that of the cloud, in this order. Either may be empty and then
/// says why. A requested stop leaves out what was not made yet.
std::vector<ScanSurface> scan_surfaces(const Session& session, const Progress& progress = {},
                                       std::stop_token stop = {});
/// The surface of the Gibbs map and that of the cloud.
std::vector<ScanSurface> scan_surfaces(const RefinementJob& job, const Refinement& refinement,
                                       const Progress& progress = {}, std::stop_token stop = {});

/// One of the two of a session, without comparing it with the truth. @throws Stopped
ScanSurface scan_surface(const Session& session, SurfaceSource source, const Progress& progress = {},
                         std::stop_token stop = {});

/// For people, how far it is closed, and how much of it was seen: "watertight, all of it seen: 0.785 m²"; "closed, but
/// only 21 % of it was seen: 0.061 m² seen, 0.226 m² is the hull of what no view saw"; "3 openings, the longest …". A
/// surface is called watertight only if all of it was seen.
std::string closedness(const Surface& surface, std::span<const BoundaryLoop> openings);
/// For people: "of the point cloud: 728818 triangles, 12 openings, …", with the distance to the truth if it is known.
std::string summary(const ScanSurface& surface);

/// Writes of each surface that is not empty NAME.ply (the whole; metres, coloured by uncertainty), NAME.stl (what was
/// seen of it; millimetres) and, if something was not, NAME_unseen.stl (the rest, which closes it); and surfaces.json:
/// sizes, how much was seen, openings, distances to the true surface; "watertight" there is said of the whole. Without
/// surfaces nothing. Returns the names of what it wrote. @pre out.begin() was called. @throws std::runtime_error naming
/// the file and the reason.
std::vector<std::string> write_surfaces(std::span<const ScanSurface> surfaces, OutputFolder& out);

}  // namespace nextview
