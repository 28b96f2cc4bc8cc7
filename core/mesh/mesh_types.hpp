#pragma once
#include <string>
#include <string_view>

namespace nextview {

/// Why a file that ends so is not read as a mesh, and what to do; empty if it is read. Only what CAD programs, scanners
/// and slicers write is read, each by the reader of its ending and never by what its content looks like: of Assimp's
/// some fifty readers most are for games and films, and every one is a way in for a damaged file.
/// @param extension lower case, with the dot
std::string not_a_mesh_type(std::string_view extension);

/// Whether a mesh of this type may lie in several files: a glTF names the files of its numbers. (An OBJ names
/// materials, which are no geometry.)
bool has_companions(std::string_view extension);

}  // namespace nextview
