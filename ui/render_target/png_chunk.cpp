#include "ui/render_target/png_chunk.hpp"

#include <zlib.h>

namespace nextview {

std::string png_number(std::uint32_t number, int count) {
  std::string bytes;
  for (int shift = 8 * (count - 1); shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 255);
  return bytes;
}

std::string png_chunk(const std::string& content) {
  const auto length = std::uint32_t(content.size() - 4);  // its name stands before it
  const auto crc = ::crc32_z(0, reinterpret_cast<const unsigned char*>(content.data()), content.size());
  return png_number(length) + content + png_number(std::uint32_t(crc));
}

}  // namespace nextview
