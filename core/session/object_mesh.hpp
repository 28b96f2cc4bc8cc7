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

/// Refuses a file that load_object_mesh would refuse, in the same words, as far as a moment tells: it is not there, or
/// less than what it says of itself. Those over 32 MiB, and compressed ones, are left to who reads them: somebody
/// waits.
/// @throws std::runtime_error with one line that names the file and the reason
void require_whole_object(const std::filesystem::path& file);

/// For people, that an object is a cloud; empty if it is not.
std::string cloud_note(const PlacedMesh& object);

}  // namespace nextview
