#include "core/file/png_text.hpp"

#include <stdexcept>
#include <string_view>

#include "core/file/read_file.hpp"

namespace nextview {
namespace {

constexpr std::uintmax_t largest_picture = std::uintmax_t{1} << 30;  // [bytes]
constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);

unsigned int number_at(std::string_view bytes, std::size_t at) {
  unsigned int number = 0;
  for (const char byte : bytes.substr(at, 4)) number = number << 8 | static_cast<unsigned char>(byte);
  return number;
}

/// Chunks: length, name, content, checksum. @throws std::runtime_error with the reason alone
PngInfo parse(std::string_view bytes) {
  if (!bytes.starts_with(signature)) throw std::runtime_error("is no PNG picture");
  PngInfo info;
  for (std::size_t at = signature.size();;) {
    if (bytes.size() - at < 12) throw std::runtime_error("the picture is cut off");
    const std::size_t length = number_at(bytes, at);
    const std::string_view name = bytes.substr(at + 4, 4);
    if (length > bytes.size() - at - 12) throw std::runtime_error("the picture is cut off");
    const std::string_view content = bytes.substr(at + 8, length);
    at += length + 12;
    if (name == "IEND") return info;
    if (name == "IHDR" && length >= 8) info.width = number_at(content, 0), info.height = number_at(content, 4);
    const std::size_t end = content.find('\0');
    if (name == "tEXt" && end != content.npos)
      info.texts.push_back({std::string(content.substr(0, end)), std::string(content.substr(end + 1))});
  }
}

}  // namespace

PngInfo read_png_info(const std::filesystem::path& file) {
  const std::string bytes = read_file(file, largest_picture);
  try {
    return parse(bytes);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

std::string png_configuration(const std::filesystem::path& file) {
  for (const PngText& text : read_png_info(file).texts)
    if (text.keyword == png_configuration_keyword) return text.text;
  return "";
}

}  // namespace nextview
