#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace Assimp {
class IOSystem;
}

namespace nextview {

/// What a reader of Assimp may open: the file that was given, as its bytes, by one name; and, if there is a folder, the
/// regular files in it and in its subfolders. No absolute name, no `..`, no link on the way, nothing that waits (pipes,
/// devices). For all else there is no such file: materials and pictures are not geometry.
struct ServedFiles {
  std::string name;             ///< of the file that was given
  std::string_view bytes;       ///< its content
  int folder = -1;              ///< descriptor of its folder; -1: no other file is served
  std::uint64_t max_bytes = 0;  ///< of the other files, together
  std::string refused;          ///< set: the first name that was asked for and not served
};

/// For Assimp::Importer, which takes it over. `files` must outlive it.
/// @param served told the size of each other file before it is read [bytes]
std::unique_ptr<Assimp::IOSystem> io_system(ServedFiles& files, void (*served)(std::uint64_t));

}  // namespace nextview
