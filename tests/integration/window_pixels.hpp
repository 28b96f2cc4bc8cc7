#pragma once
#include <cmath>
#include <functional>
#include <set>

#include "ui/appearance/theme.hpp"
#include "ui/panels/layout.hpp"
#include "ui/render_target/image.hpp"

namespace nextview {

// Where things are in the window, and what is counted of its picture.

struct Point {
  double x, y;
};

inline Point step_button(const Layout& layout) { return {50, layout.control_bar.y + layout.control_bar.height / 2}; }
inline Point table_row(const Layout& layout, int row) {
  return {layout.right.x + 100, layout.right.y + 172 + 21 * row};
}
inline Point take_button(const Layout& layout) {
  return {layout.right.x + 80, layout.right.y + layout.right.height - 24};
}
inline Point middle(const Rectangle& r) { return {r.x + r.width / 2, r.y + r.height / 2}; }

inline int count(const Image& image, const Rectangle& r, const std::function<bool(const std::uint8_t*)>& matches) {
  int result = 0;
  for (int y = int(r.y); y < int(r.y + r.height); ++y) {
    for (int x = int(r.x); x < int(r.x + r.width); ++x)
      result += matches(&image.rgba[(std::size_t(y) * image.width + x) * 4]);
  }
  return result;
}

/// Pixels of exactly this colour.
inline int count(const Image& image, const Rectangle& r, const Colour& colour) {
  return count(image, r, [&](const std::uint8_t* pixel) {
    for (int i = 0; i < 3; ++i) {
      if (std::abs(pixel[i] - colour[i] * 255) > 1.0) return false;
    }
    return true;
  });
}

/// Shades of blue as occupied voxels have them in the scene's light.
inline int count_blue(const Image& image, const Rectangle& r) {
  return count(image, r, [](const std::uint8_t* p) { return p[2] > p[0] + 40 && p[2] > p[1] + 15; });
}

/// Shades of amber as undecided voxels have them.
inline int count_amber(const Image& image, const Rectangle& r) {
  return count(image, r, [](const std::uint8_t* p) { return p[0] > p[2] + 70 && p[1] > p[2] + 35; });
}

/// How many pixels of a part differ.
inline int differences(const Image& a, const Image& b, const Rectangle& r) {
  int result = 0;
  for (int y = int(r.y); y < int(r.y + r.height); ++y)
    for (int x = int(r.x); x < int(r.x + r.width); ++x)
      for (int c = 0; c < 3; ++c) {
        const std::size_t at = (std::size_t(y) * a.width + x) * 4 + c;
        if (a.rgba[at] == b.rgba[at]) continue;
        ++result;
        break;
      }
  return result;
}

inline std::size_t colours(const Image& image, const Rectangle& r) {
  std::set<std::uint32_t> seen;
  count(image, r, [&](const std::uint8_t* p) { return seen.insert(p[0] << 16 | p[1] << 8 | p[2]).second; });
  return seen.size();
}

}  // namespace nextview
