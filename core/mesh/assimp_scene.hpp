#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nextview {

/// The triangles of a file in the file's own unit and place, not yet checked for anything but their indices.
struct ImportedTriangles {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Whether Assimp has a reader for files that end so.
/// @param extension with the dot
bool has_reader(const std::string& extension);

/// Reads a scene: all meshes of all nodes, each moved by its nodes' transforms; polygons become triangles; points and
/// lines are left out. A damaged file may end the process: see import_scene.
/// @throws std::runtime_error with the reason alone: what Assimp says, or an index beyond the vertices.
ImportedTriangles read_scene(const std::filesystem::path& file);

}  // namespace nextview
