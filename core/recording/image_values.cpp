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

#include "core/file/npy_file.hpp"

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
  const NpyHeader header = npy_header(bytes);
  constexpr std::string_view types[] = {"<u2", "<f4", "<f8"};  // in the order of RawType
  const auto known = std::ranges::find(types, std::string_view(header.type));
  if (known == std::end(types))
    throw std::runtime_error("must hold little-endian uint16, float32 or float64 ('<u2', '<f4' or '<f8')");
  return decode_raw(bytes, header.columns, header.rows, static_cast<RawType>(known - types), header.end);
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
