#pragma once
#include <functional>
#include <span>
#include <stop_token>
#include <string_view>

#include "core/cloud/point_cloud.hpp"
#include "core/surface/surface.hpp"

namespace nextview {

using SurfaceProgress = std::function<void(double fraction, std::string_view what)>;

/// The surface through the hits of some scans, cleaned or not. Hits are averaged in cells, normals fitted to
/// neighbours and turned to the camera, signed distances to the points' planes averaged over a lattice, and their zero
/// is the surface (volumetric integration, Curless and Levoy 1996; VTK's). It ends where no points are: its openings
/// are where no view has looked, and all of its vertices are `seen`. Cells are `finest` [m] wide, or, if the pixels lie
/// farther apart than that, as wide as it takes for neighbouring pixels to fall into neighbouring cells.
/// Points that are not finite are left out.
/// Uncertainty: root mean square distance of the neighbouring averaged points from the surface.
/// Empty, with the reason, if there are too few points for a surface, or if stopped. The same bytes on any number of
/// threads.
/// @throws std::invalid_argument if `finest` is not over 0, or if the points are so far apart that the lattice would
/// have
///         more than 2^28 points.
Surface cloud_surface(std::span<const Scan> scans, double finest, const SurfaceProgress& progress = {},
                      std::stop_token stop = {});

/// The surface through a cloud that nobody knows the cameras of, in whatever unit its coordinates are. Cells are twice
/// as wide as points lie apart, and at least a 500th of the cloud's longest side: millions of points
/// are averaged first. Normals are turned out of each connected piece (orient_normals). Else as above.
Surface cloud_surface(const PointCloud& cloud, const SurfaceProgress& progress = {}, std::stop_token stop = {});

}  // namespace nextview
