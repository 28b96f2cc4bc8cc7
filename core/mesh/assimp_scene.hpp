#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/served_files.hpp"
#include "core/view/length_unit.hpp"

namespace nextview {

/// The triangles of a file in the file's own unit and place, not yet checked for anything but their indices.
struct ImportedTriangles {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  LengthUnit unit = LengthUnit::automatic;  ///< that the file declares, beyond what its type says
};

/// No file of 1 GiB that anybody has seen holds more.
inline constexpr std::uint64_t max_vertices = std::uint64_t{1} << 27, max_triangles = std::uint64_t{1} << 26;

/// Reads a scene: all meshes of all nodes, each moved by its nodes' transforms; polygons become triangles; points and
/// lines are left out. Assimp's reader of the name's ending reads it, whatever the content looks like. A damaged file
/// may end the process: see import_scene.
/// @throws std::runtime_error with the reason alone: what Assimp says, a file that it names and does not get, an index
///         beyond the vertices, too many vertices or triangles.
ImportedTriangles read_scene(ServedFiles& files);

}  // namespace nextview
