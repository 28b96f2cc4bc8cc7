#include "ui/appearance/picture_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace nextview {

PictureSize picture_size(const std::string& text, const std::string& name) {
  PictureSize size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool has_height = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = has_height ? std::from_chars(width.ptr + 1, end, size.height) : width;
  const auto within = [](int side) { return side >= smallest_picture && side <= largest_picture; };
  if (!has_height || height.ec != std::errc() || height.ptr != end || !within(size.width) || !within(size.height))
    throw std::invalid_argument(fmt::format("{}: takes WIDTHxHEIGHT in pixels, each from {} to {}, not '{}'", name,
                                            smallest_picture, largest_picture, text));
  return size;
}

double picture_scale(const PictureSize& size) {
  constexpr PictureSize usual;
  return std::max(1.0, std::min(double(size.width) / usual.width, double(size.height) / usual.height));
}

}  // namespace nextview
