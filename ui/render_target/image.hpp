#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nextview {

/// An RGBA picture, 8 bits a channel, rows from top to bottom.
struct Image {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  std::vector<std::uint8_t> rgba;

  bool operator==(const Image&) const = default;
};

/// One picture with the other to its right. @pre both are of a height
Image side_by_side(const Image& left, const Image& right);

/// The bytes of a PNG file, with alpha (4 channels) or without (3).
std::string png_bytes(const Image& image, const std::string& configuration = {}, int channels = 4);

/// Atomic (AtomicFile). The same picture gives the same bytes. It carries the text of a configuration file, if one is
/// given (png_configuration finds it again), and how large it is meant to be, if `dpi` is over 0.
/// @throws std::runtime_error naming the file and the reason.
void write_png(const Image& image, const std::filesystem::path& file, const std::string& configuration = {},
               double dpi = 0.0);

/// @throws std::runtime_error naming the file and the reason: missing, not a PNG picture, truncated.
Image read_png(const std::filesystem::path& file);

}  // namespace nextview
