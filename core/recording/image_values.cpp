#include "core/recording/image_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <string>

namespace nextview {

static_assert(std::endian::native == std::endian::little, "values are copied as they stand in files");

namespace {

constexpr std::string_view npy_signature = "\x93NUMPY";

std::size_t count(int width, int height) { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

template <class Value>
std::vector<Value> copied(std::string_view bytes) {
  std::vector<Value> values(bytes.size() / sizeof(Value));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
  return values;
}

/// The next whole number of a PGM's header; comments are passed over.
std::int64_t pgm_number(std::string_view& rest) {
  while (!rest.empty() && (std::isspace(static_cast<unsigned char>(rest.front())) || rest.front() == '#')) {
    const bool comment = rest.front() == '#';
    rest.remove_prefix(comment ? std::min(rest.find('\n'), rest.size()) : 1);
  }
  int value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc() || value <= 0) throw std::runtime_error("is a damaged PGM: its header makes no sense");
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return value;
}

/// The text behind a key of the dictionary in a .npy header.
std::string_view npy_entry(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) throw std::runtime_error(fmt::format("is no .npy file: it has no entry {}", key));
  std::string_view rest = header.substr(at + key.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(" :"), rest.size()));
  return rest;
}

/// Rows and columns, out of "(480, 640), …".
std::pair<int, int> npy_shape(std::string_view text) {
  int shape[2] = {0, 0};
  for (int i = 0; i < 2; ++i) {
    text.remove_prefix(std::min(text.find_first_not_of(i == 0 ? "( " : ", "), text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), shape[i]);
    if (error != std::errc()) throw std::runtime_error("must hold a two-dimensional array");
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  text.remove_prefix(std::min(text.find_first_not_of(", "), text.size()));
  if (!text.starts_with(')')) throw std::runtime_error("must hold a two-dimensional array");
  return {shape[0], shape[1]};
}

}  // namespace

void require_image_size(std::int64_t width, std::int64_t height) {
  if (width >= 1 && height >= 1 && width <= largest_image_side && height <= largest_image_side &&
      width * height <= most_image_pixels)
    return;
  throw std::runtime_error(fmt::format("claims {} x {} pixels; at most {} a side and {} in all are read", width, height,
                                       largest_image_side, most_image_pixels));
}

bool is_pgm(std::string_view bytes) { return bytes.starts_with("P5"); }
bool is_npy(std::string_view bytes) { return bytes.starts_with(npy_signature); }

ImageValues decode_pgm(std::string_view bytes) {
  std::string_view rest = bytes.substr(2);
  const std::int64_t width = pgm_number(rest), height = pgm_number(rest), greatest = pgm_number(rest);
  require_image_size(width, height);
  if (greatest > 65535) throw std::runtime_error("is a damaged PGM: its greatest value is over 65535");
  if (!rest.empty()) rest.remove_prefix(1);  // a single blank ends the header
  const std::size_t pixels = count(static_cast<int>(width), static_cast<int>(height)), size = greatest > 255 ? 2 : 1;
  if (rest.size() < pixels * size)
    throw std::runtime_error(fmt::format("is truncated: {} of {} bytes of pixels", rest.size(), pixels * size));
  ImageValues image{static_cast<int>(width), static_cast<int>(height), 1, size == 2 ? 16 : 8, {}, {}};
  image.whole.reserve(pixels);
  const auto* value = reinterpret_cast<const unsigned char*>(rest.data());
  for (std::size_t i = 0; i < pixels; ++i)
    image.whole.push_back(size == 2 ? static_cast<std::uint16_t>(value[2 * i] << 8 | value[2 * i + 1]) : value[i]);
  return image;
}

ImageValues decode_npy(std::string_view bytes) {
  const std::size_t length_size = bytes.size() > 6 && bytes[6] >= 2 ? 4 : 2;
  if (bytes.size() < 8 + length_size) throw std::runtime_error("is truncated");
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_size; ++i)
    length |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[8 + i])) << 8 * i;
  if (length > bytes.size() - 8 - length_size) throw std::runtime_error("is truncated");
  const std::string_view header = bytes.substr(8 + length_size, length);
  const std::string_view kind = npy_entry(header, "'descr'").substr(0, 5);
  constexpr std::string_view kinds[] = {"'<u2'", "'<f4'", "'<f8'"};  // in the order of RawType
  const auto known = std::ranges::find(kinds, kind);
  if (known == std::end(kinds))
    throw std::runtime_error("must hold little-endian uint16, float32 or float64 ('<u2', '<f4' or '<f8')");
  if (!npy_entry(header, "'fortran_order'").starts_with("False"))
    throw std::runtime_error("must hold its array row by row (fortran_order False)");
  const auto [height, width] = npy_shape(npy_entry(header, "'shape'"));
  return decode_raw(bytes, width, height, static_cast<RawType>(known - kinds), 8 + length_size + length);
}

ImageValues decode_raw(std::string_view bytes, int width, int height, RawType type, std::size_t offset) {
  require_image_size(width, height);
  const std::size_t size = type == RawType::uint16    ? 2
                           : type == RawType::float32 ? 4
                                                      : 8,
                    expected = offset + count(width, height) * size;
  if (bytes.size() != expected)
    throw std::runtime_error(fmt::format("has {} bytes where {} x {} pixels of {} bytes and {} before them take {}",
                                         bytes.size(), width, height, size, offset, expected));
  ImageValues image{width, height, 1, static_cast<int>(8 * size), {}, {}};
  bytes.remove_prefix(offset);
  if (type == RawType::uint16) image.whole = copied<std::uint16_t>(bytes);
  if (type == RawType::float32) image.real = copied<float>(bytes);
  if (type == RawType::float64)
    for (const double value : copied<double>(bytes)) image.real.push_back(static_cast<float>(value));
  return image;
}

}  // namespace nextview
