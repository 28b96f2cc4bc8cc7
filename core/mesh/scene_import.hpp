#pragma once
#include "core/mesh/assimp_scene.hpp"

namespace nextview {

/// As read_scene, in a process of its own: on damaged files some of Assimp's readers crash, and its assertions abort
/// (Debian builds them in). Nothing that they do then, or print, reaches this process.
/// @throws std::runtime_error with the reason alone; a crash is one.
ImportedTriangles import_scene(const std::filesystem::path& file);

}  // namespace nextview
