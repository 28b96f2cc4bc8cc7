#pragma once
#include <string>
#include <string_view>

namespace nextview {

/// Mesh readers allocate what a header announces before they read it, so a few bytes can ask for gigabytes, and some
/// take what is missing for zeros. Compares the counts announced by a PLY, STL, OFF or GLB file with its content; other
/// types announce none.
/// @param extension lower case, with the dot
/// @return what is wrong, in one line, or an empty string
std::string false_claim(std::string_view extension, std::string_view bytes);

std::string false_ply_claim(std::string_view bytes);

}  // namespace nextview
