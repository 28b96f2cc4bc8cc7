#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace nextview {

/// A text that a PNG picture carries beside its pixels.
struct PngText {
  std::string keyword, text;
};

/// What a PNG picture says of itself, without its pixels.
struct PngInfo {
  unsigned int width = 0, height = 0;  ///< [px]
  std::vector<PngText> texts;          ///< uncompressed ones (tEXt)
};

/// @throws std::runtime_error naming the file and the reason: missing, no PNG, cut off
PngInfo read_png_info(const std::filesystem::path& file);

/// The keyword of the configuration that a picture was drawn with.
inline constexpr const char* png_configuration_keyword = "nextview configuration";
/// Its text, as config.toml has it; empty if the picture carries none. @throws as read_png_info
std::string png_configuration(const std::filesystem::path& file);

}  // namespace nextview
