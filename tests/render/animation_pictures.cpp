#include "tests/render/animation_pictures.hpp"

#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <zlib.h>

#include <algorithm>

#include "core/file/read_file.hpp"

namespace nextview {
namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at, std::size_t count = 4) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < count; ++i) number = number << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return number;
}

void append_number(std::string& bytes, std::uint32_t number) {
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift);
}

void append_chunk(std::string& png, const std::string& name, const std::string& content) {
  append_number(png, std::uint32_t(content.size()));
  png += name + content;
  const std::string checked = name + content;
  append_number(png, std::uint32_t(::crc32(0, reinterpret_cast<const Bytef*>(checked.data()), uInt(checked.size()))));
}

/// Draws a part over what was shown.
void put(Image& shown, const std::string& control, std::string header, const std::string& pixels) {
  const int width = int(number_at(control, 4)), height = int(number_at(control, 8));
  const int left = int(number_at(control, 12)), top = int(number_at(control, 16));
  header.replace(0, 8, control.substr(4, 8));
  std::string png("\x89PNG\r\n\x1a\n", 8);
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", pixels);
  append_chunk(png, "IEND", "");
  int w = 0, h = 0, channels = 0;
  stbi_uc* part =
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()), int(png.size()), &w, &h, &channels, 4);
  ASSERT_NE(part, nullptr) << stbi_failure_reason();
  ASSERT_EQ(w, width);
  ASSERT_EQ(h, height);
  ASSERT_LE(left + width, shown.width);
  ASSERT_LE(top + height, shown.height);
  for (int y = 0; y < height; ++y)
    std::copy_n(part + std::ptrdiff_t(y) * width * 4, width * 4,
                &shown.rgba[(std::size_t(top + y) * shown.width + left) * 4]);
  stbi_image_free(part);
}

}  // namespace

std::vector<Image> animation_pictures(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  std::vector<Image> pictures;
  std::string header, control, pixels;
  Image shown;
  std::uint32_t sequence = 0, promised = 0, parts = 0;
  const auto finish = [&] {
    if (control.empty()) return;
    put(shown, control, header, pixels);
    EXPECT_EQ(control.substr(24, 2), std::string(2, '\0')) << "parts are put in place and stay";
    pictures.insert(pictures.end(), number_at(control, 20, 2), shown);
    ++parts;
    pixels.clear();
  };
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = number_at(bytes, at);
    const std::string name = bytes.substr(at + 4, 4), content = bytes.substr(at + 8, length);
    EXPECT_EQ(number_at(bytes, at + 8 + length),
              ::crc32(0, reinterpret_cast<const Bytef*>(&bytes[at + 4]), uInt(length + 4)))
        << name;
    at += length + 12;
    if (name == "IHDR") {
      header = content;
      shown = {int(number_at(content, 0)), int(number_at(content, 4)), {}};
      shown.rgba.assign(std::size_t(shown.width) * shown.height * 4, 0);
    }
    if (name == "acTL") promised = number_at(content, 0);
    if (name == "fcTL" || name == "IEND") {
      finish();
      control = content;
    }
    if (name == "fcTL" || name == "fdAT") {
      EXPECT_EQ(number_at(content, 0), sequence++) << "of " << name;
    }
    if (name == "IDAT") pixels += content;
    if (name == "fdAT") pixels += content.substr(4);
  }
  EXPECT_EQ(parts, promised);
  return pictures;
}

}  // namespace nextview
