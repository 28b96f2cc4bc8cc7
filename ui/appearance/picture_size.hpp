#pragma once
#include <string>

namespace nextview {

/// Of a picture [px].
struct PictureSize {
  int width = 1280, height = 800;

  bool operator==(const PictureSize&) const = default;
};
inline constexpr int smallest_picture = 16, largest_picture = 8192;  // a side [px]

/// "1920x1080". @throws std::invalid_argument in one line that begins with `name` if it is none, or beyond the limits
PictureSize picture_size(const std::string& text, const std::string& name);

/// Pixels per pixel of the design: what is drawn larger has its lines and letters larger, too.
double picture_scale(const PictureSize& size);

}  // namespace nextview
