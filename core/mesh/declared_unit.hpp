#pragma once
#include <string_view>

#include "core/view/length_unit.hpp"

struct aiScene;

namespace nextview {

/// What a file says itself that its unit is, which Assimp reads over: 3MF and AMF in an attribute, FBX as a scale,
/// STL and PLY in a remark in their head, as those that Nextview writes have it.
/// automatic: it says nothing, or a unit that is not known.
/// @param extension with the dot, in lower case
LengthUnit declared_unit(std::string_view extension, std::string_view bytes, const aiScene& scene);

}  // namespace nextview
