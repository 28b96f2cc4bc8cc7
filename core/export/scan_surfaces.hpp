#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/export/reconstruction.hpp"
#include "core/offline/refinement.hpp"
#include "core/results/output_folder.hpp"
#include "core/session/session.hpp"

namespace nextview {

/// The surface of the map that views are planned on and that of the cloud, in this order. Either may be empty and then
/// says why. A requested stop leaves out what was not made yet.
std::vector<ScanSurface> scan_surfaces(const Session& session, const Progress& progress = {},
                                       std::stop_token stop = {});
/// The surface of the Gibbs map and that of the cloud.
std::vector<ScanSurface> scan_surfaces(const RefinementJob& job, const Refinement& refinement,
                                       const Progress& progress = {}, std::stop_token stop = {});

/// A map of a session's views, conventional or Gibbs.
struct MapOfViews {
  OccupancyMap map;
  std::optional<double> prior = {};  ///< of a Gibbs map: of a voxel being occupied
};
/// One of the two of a session, without comparing it with the truth. `wanted`: takes the place of the map that views
/// are planned on. @throws Stopped
ScanSurface scan_surface(const Session& session, SurfaceSource source, const MapOfViews* wanted = nullptr,
                         const Progress& progress = {}, const std::stop_token& stop = {});

/// Writes of each surface that is not empty NAME.ply (the whole; metres, coloured by uncertainty), NAME.stl (what was
/// seen of it; millimetres) and, if something was not, NAME_unseen.stl (the rest, which closes it); and surfaces.json:
/// sizes, how much was seen, openings, distances to the true surface; "watertight" there is said of the whole. Without
/// surfaces nothing. Returns the names of what it wrote. @pre out.begin() was called. @throws std::runtime_error naming
/// the file and the reason.
std::vector<std::string> write_surfaces(std::span<const ScanSurface> surfaces, OutputFolder& out);

}  // namespace nextview
