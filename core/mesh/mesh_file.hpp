#pragma once
#include <filesystem>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

struct MeshFileOptions {
  /// Longest side of the bounding box after scaling [m]; 0 keeps the file's own size.
  double longest_side = 0.5;
  std::uintmax_t largest_file = 1u << 30;  ///< files beyond this are refused [bytes]
};

/// How load_mesh moves and scales a file's coordinates: what else is known in them, such as openings, goes the same
/// way.
struct MeshPlacement {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the file's bounding box, becomes the origin [file's units]
  double scale = 1.0;                                ///< over 0 [m per file's unit]

  Eigen::Vector3d operator()(const Eigen::Vector3d& point) const { return (point - centre) * scale; }
};

struct PlacedMesh {
  TriangleMesh mesh;
  MeshPlacement placement;
};

/// Reads PLY, OBJ, STL, OFF, 3MF, glTF and whatever else Assimp reads; all of a scene's meshes become one. The result
/// is centred: its bounding box has its centre in the origin. Degenerate triangles are dropped.
/// @throws std::runtime_error with one line that names the file and the reason: missing, empty, unreadable, truncated,
///         without faces, not finite, absurdly large coordinates, over the size limit.
TriangleMesh load_mesh(const std::filesystem::path& file, const MeshFileOptions& options = {});
/// The same, and how its coordinates came out of the file's.
PlacedMesh load_placed_mesh(const std::filesystem::path& file, const MeshFileOptions& options = {});

}  // namespace nextview
