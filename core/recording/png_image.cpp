#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/recording/image_values.hpp"

namespace nextview {
namespace {

// Read here and not by a library of images: a depth is used as it stands, so a file whose checksums do not fit must be
// refused, and what comes out of its compressed data is bounded by its size.

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[static_cast<std::size_t>(i)]);
  return value;
}

const Bytef* as_bytes(std::string_view text) { return reinterpret_cast<const Bytef*>(text.data()); }

struct PngHeader {
  int width = 0, height = 0, bits = 0, channels = 0;

  std::size_t row_bytes() const {
    return (static_cast<std::size_t>(width) * static_cast<std::size_t>(channels * bits) + 7) / 8;
  }
  /// From a byte to the one of the pixel before it.
  std::size_t pixel_bytes() const { return static_cast<std::size_t>(std::max(1, channels * bits / 8)); }
};

PngHeader parse_png_header(std::string_view data) {
  if (data.size() != 13) throw std::runtime_error("is a damaged PNG: its header has a wrong length");
  const std::int64_t width = big_endian(data), height = big_endian(data.substr(4));
  require_image_size(width, height);
  const int bits = static_cast<unsigned char>(data[8]), kind = static_cast<unsigned char>(data[9]);
  constexpr std::array<int, 7> channels_of_kind = {1, 0, 3, 1, 2, 0, 4};
  const int channels = kind < 7 ? channels_of_kind[static_cast<std::size_t>(kind)] : 0;
  const bool small_bits = (bits == 1 || bits == 2 || bits == 4) && channels == 1;
  if (channels == 0 || !(bits == 8 || bits == 16 || small_bits) || data[10] != 0 || data[11] != 0)
    throw std::runtime_error("is a damaged PNG: its header makes no sense");
  if (data[12] != 0) throw std::runtime_error("is an interlaced PNG, which is not read; save it without interlacing");
  return {static_cast<int>(width), static_cast<int>(height), bits, channels};
}

/// The header, and the compressed data of all chunks.
std::pair<PngHeader, std::string> parse_chunks(std::string_view rest) {
  PngHeader header;
  std::string data;
  rest.remove_prefix(signature.size());
  for (bool first = true;; first = false) {
    if (rest.size() < 12) throw std::runtime_error("is truncated");
    const std::size_t length = big_endian(rest);
    if (length > rest.size() - 12) throw std::runtime_error("is truncated");
    const std::string_view kind = rest.substr(4, 4), content = rest.substr(8, length);
    const uLong sum = crc32(crc32(0, nullptr, 0), as_bytes(kind), static_cast<uInt>(4 + length));
    if (sum != big_endian(rest.substr(8 + length))) throw std::runtime_error("is damaged: a checksum does not fit");
    if (first != (kind == "IHDR")) throw std::runtime_error("is a damaged PNG: it does not begin with its header");
    if (first) header = parse_png_header(content);
    if (kind == "IDAT") data += content;
    if (kind == "IEND") return {header, std::move(data)};
    rest.remove_prefix(12 + length);
  }
}

std::string inflate(const std::string& data, std::size_t expected) {
  constexpr std::size_t densest = 1100;  // one byte of deflate stands for at most 1032
  if (data.size() < expected / densest) throw std::runtime_error("is truncated: too little data for its size");
  std::string pixels(expected, '\0');
  uLongf size = expected;
  const int error = uncompress(reinterpret_cast<Bytef*>(pixels.data()), &size, as_bytes(data), data.size());
  if (error != Z_OK || size != expected) throw std::runtime_error("is damaged: its compressed data cannot be read");
  return pixels;
}

int paeth(int left, int above, int above_left) {
  const int estimate = left + above - above_left;
  const int to_left = std::abs(estimate - left), to_above = std::abs(estimate - above),
            to_corner = std::abs(estimate - above_left);
  if (to_left <= to_above && to_left <= to_corner) return left;
  return to_above <= to_corner ? above : above_left;
}

/// Adds to each byte of a row what is predicted of those beside and above it. `step`: from a byte to that of the pixel
/// before it; before the first pixel all are 0.
template <class Predict>
void add_predicted(std::span<unsigned char> row, const unsigned char* above, std::size_t step, Predict predict) {
  const std::size_t first = std::min(step, row.size());
  const auto add = [&](std::size_t i, int left, int above_left) {
    row[i] = static_cast<unsigned char>(row[i] + predict(left, int(above[i]), above_left));
  };
  for (std::size_t i = 0; i < first; ++i) add(i, 0, 0);
  for (std::size_t i = first; i < row.size(); ++i) add(i, row[i - step], above[i - step]);
}

void undo_filter(int filter, std::span<unsigned char> row, const unsigned char* above, std::size_t step) {
  switch (filter) {
    case 0:
      return;
    case 1:
      return add_predicted(row, above, step, [](int left, int, int) { return left; });
    case 2:
      return add_predicted(row, above, step, [](int, int up, int) { return up; });
    case 3:
      return add_predicted(row, above, step, [](int left, int up, int) { return (left + up) / 2; });
    case 4:
      return add_predicted(row, above, step, [](int left, int up, int corner) { return paeth(left, up, corner); });
    default:
      throw std::runtime_error("is damaged: a row has a filter that PNG does not have");
  }
}

/// Rows hold differences to their neighbours, by the filter that their first byte names; undone in place.
void undo_filters(std::string& pixels, const PngHeader& header) {
  const std::size_t row_bytes = header.row_bytes();
  const std::vector<unsigned char> zeros(row_bytes);
  const unsigned char* above = zeros.data();
  for (std::size_t y = 0; y < static_cast<std::size_t>(header.height); ++y) {
    auto* const row = reinterpret_cast<unsigned char*>(pixels.data()) + y * (row_bytes + 1);
    undo_filter(row[0], {row + 1, row_bytes}, above, header.pixel_bytes());
    above = row + 1;
  }
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with(signature); }

ImageValues decode_png(std::string_view bytes) {
  const auto [header, data] = parse_chunks(bytes);
  const std::size_t row_bytes = header.row_bytes();
  std::string pixels = inflate(data, (row_bytes + 1) * static_cast<std::size_t>(header.height));
  undo_filters(pixels, header);
  ImageValues image{header.width, header.height, header.channels, header.bits, {}, {}};
  const std::size_t in_a_row = static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.channels);
  image.whole.reserve(in_a_row * static_cast<std::size_t>(header.height));
  const auto bits = static_cast<std::size_t>(header.bits);
  for (std::size_t y = 0; y < static_cast<std::size_t>(header.height); ++y) {
    const auto* row = reinterpret_cast<const unsigned char*>(pixels.data()) + y * (row_bytes + 1) + 1;
    for (std::size_t i = 0; i < in_a_row; ++i) {
      if (bits == 16)
        image.whole.push_back(static_cast<std::uint16_t>(row[2 * i] << 8 | row[2 * i + 1]));
      else
        image.whole.push_back(
            static_cast<std::uint16_t>(row[i * bits / 8] >> (8 - bits - i * bits % 8) & ((1 << bits) - 1)));
    }
  }
  return image;
}

}  // namespace nextview
