#pragma once
#include <string>

#include "core/mesh/mesh_file.hpp"

namespace nextview {

/// Whether a file holds points alone: PCD, or PLY without faces, plain or compressed with gzip (.gz).
bool is_cloud(const std::filesystem::path& file);

/// The object of a file: a mesh as load_placed_mesh reads it, plain or compressed with gzip (.gz), or of a cloud (PLY
/// without faces, PCD) the program's own surface, placed in the same way; `cloud_points` says so.
/// @throws std::runtime_error with one line that names the file and the reason: as load_placed_mesh and
/// read_cloud_file,
///         or why the points make no surface; Stopped
PlacedMesh load_object_mesh(const std::filesystem::path& file, const MeshFileOptions& options = {},
                            const std::stop_token& stop = {});

/// For people, that an object is a cloud; empty if it is not.
std::string cloud_note(const PlacedMesh& object);

}  // namespace nextview
