#include "core/mesh/mesh_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace nextview {
namespace {

constexpr std::array<std::string_view, 12> read_types = {".ply", ".obj",  ".stl", ".off", ".3mf", ".amf",
                                                         ".glb", ".gltf", ".dae", ".fbx", ".3ds", ".x3d"};

/// What CAD programs save is exact; triangles come out of an export.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> exact_types = {{{".step", "STEP"},
                                                                                       {".stp", "STEP"},
                                                                                       {".stpz", "STEP"},
                                                                                       {".p21", "STEP"},
                                                                                       {".iges", "IGES"},
                                                                                       {".igs", "IGES"},
                                                                                       {".brep", "BREP"}}};

}  // namespace

std::string not_a_mesh_type(std::string_view extension) {
  if (std::find(read_types.begin(), read_types.end(), extension) != read_types.end()) return "";
  for (const auto& [ending, name] : exact_types)
    if (extension == ending)
      return fmt::format("{} is not a mesh: it holds exact surfaces; export it as STL, OBJ or 3MF", name);
  const std::string reason = extension.empty() ? "has no ending that says its type"
                                               : fmt::format("'{}' is no known mesh file type", extension);
  return reason + "; use ply, obj, stl, off, 3mf, amf, gltf, glb, dae, fbx, 3ds or x3d";
}

bool has_companions(std::string_view extension) { return extension == ".gltf" || extension == ".glb"; }

}  // namespace nextview
