#pragma once
#include <filesystem>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

struct MeshFileOptions {
  /// Longest side of the bounding box after scaling [m]; 0 keeps the file's own size.
  double longest_side = 0.5;
  std::uintmax_t largest_file = 1u << 30;  ///< files beyond this are refused [bytes]
};

/// Reads PLY, OBJ, STL, OFF, 3MF, glTF and whatever else Assimp reads; all of a scene's meshes become one. The result
/// is centred: its bounding box has its centre in the origin. Degenerate triangles are dropped.
/// @throws std::runtime_error with one line that names the file and the reason: missing, empty, unreadable, truncated,
///         without faces, not finite, absurdly large coordinates, over the size limit.
TriangleMesh load_mesh(const std::filesystem::path& file, const MeshFileOptions& options = {});

}  // namespace nextview
