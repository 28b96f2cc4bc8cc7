#pragma once
#include <filesystem>
#include <vector>

#include "ui/render_target/image.hpp"

namespace nextview {

/// What an animated PNG shows, a picture for each unit of its time: read chunk by chunk, each part as a PNG of its own.
/// Knows no other ways to lay parts on each other than to put them in place.
std::vector<Image> animation_pictures(const std::filesystem::path& file);

}  // namespace nextview
