#pragma once
#include <filesystem>
#include <stop_token>
#include <string>

#include "core/mesh/assimp_scene.hpp"
#include "core/mesh/confinement.hpp"

namespace nextview {

/// A file that has been read, to be understood.
struct MeshBytes {
  std::string extension;  ///< lower case, with the dot
  std::string bytes;
  std::filesystem::path folder;  ///< where the other files of a mesh in several lie
};

/// As read_scene, in a process of its own: on damaged files some of Assimp's readers crash, ask for gigabytes or never
/// end, and its assertions abort (Debian builds them in). That process gets the bytes and the folder, `limits`, and
/// nothing else (confine): it writes no file, has no network, and what it prints goes nowhere. What it sends back is
/// checked like any input, and takes no more memory here than has really come.
/// @throws std::runtime_error with the reason alone: what Assimp says; a crash; which limit was reached.
/// @throws Stopped within a fraction of a second of a requested stop
ImportedTriangles import_scene(MeshBytes file, const ReadingLimits& limits, std::stop_token stop = {});

}  // namespace nextview
