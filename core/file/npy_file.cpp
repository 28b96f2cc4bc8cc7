#include "core/file/npy_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/file/atomic_file.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"

namespace nextview {
namespace {

static_assert(std::endian::native == std::endian::little, "values are copied as they are in the file");

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t alignment = 64, before_length = 8;  // of the header's end; magic and version [bytes]

/// The header's text, and where the values begin.
struct Header {
  std::string text;
  std::size_t end = 0;
};

Header header_of(const std::string& bytes) {
  if (!bytes.starts_with(magic) || bytes.size() < before_length) throw std::invalid_argument("is no .npy file");
  const unsigned version = static_cast<unsigned char>(bytes[6]);
  if (version < 1 || version > 3) throw std::invalid_argument(fmt::format("has version {} of .npy", version));
  const std::size_t width = version == 1 ? 2 : 4;
  if (bytes.size() < before_length + width) throw std::invalid_argument("ends within its header");
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + before_length, width);
  const std::size_t begin = before_length + width;
  if (bytes.size() - begin < length) throw std::invalid_argument("ends within its header");
  return {bytes.substr(begin, length), begin + length};
}

// By hand: compiling regular expressions is not safe from several threads in GCC's library, and captures are read so.
void skip_blanks(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

bool skip(std::string_view& text, char expected) {
  if (!text.starts_with(expected)) return false;
  text.remove_prefix(1);
  return true;
}

/// What stands behind a key of the header, a Python dictionary, and all after it; empty if there is none.
std::string_view after_key(std::string_view header, std::string_view key) {
  for (const char quote : {'\'', '"'}) {
    const std::string quoted = fmt::format("{0}{1}{0}", quote, key);
    const std::size_t at = header.find(quoted);
    if (at == header.npos) continue;
    std::string_view rest = header.substr(at + quoted.size());
    skip_blanks(rest);
    if (!skip(rest, ':')) continue;
    skip_blanks(rest);
    return rest;
  }
  return {};
}

/// A text between two of its ends, of which any of `first` begins it; empty if none does.
std::string_view between(std::string_view text, std::string_view first, std::string_view last) {
  if (text.empty() || first.find(text.front()) == first.npos) return {};
  const std::size_t end = text.find_first_of(last, 1);
  return end == text.npos ? std::string_view() : text.substr(1, end - 1);
}

/// A number of at most six digits, with blanks around it.
std::optional<int> take_number(std::string_view& text) {
  skip_blanks(text);
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + std::min<std::size_t>(text.size(), 6), number);
  if (error != std::errc()) return {};
  text.remove_prefix(std::size_t(end - text.data()));
  skip_blanks(text);
  return int(number);
}

template <class Value>
std::vector<float> values_of(std::string_view bytes) {
  std::vector<Value> values(bytes.size() / sizeof(Value));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
  return {values.begin(), values.end()};
}

NpyTable table_of(const std::string& bytes) {
  const Header header = header_of(bytes);
  const std::string_view type = between(after_key(header.text, "descr"), "'\"", "'\"");
  if (type != "<f4" && type != "<f8")
    throw std::invalid_argument(
        fmt::format("holds values of type '{}'; float32 ('<f4') and float64 ('<f8') are read", printable(type)));
  const std::size_t size = type == "<f4" ? sizeof(float) : sizeof(double);
  if (!after_key(header.text, "fortran_order").starts_with("False"))
    throw std::invalid_argument("is not row by row (C order)");
  const std::string_view shape = between(after_key(header.text, "shape"), "(", ")");
  std::string_view rest = shape;
  const std::optional<int> rows = take_number(rest);
  const bool is_two = rows && skip(rest, ',');
  const std::optional<int> columns = is_two ? take_number(rest) : std::nullopt;
  if (columns && skip(rest, ',')) skip_blanks(rest);
  if (!columns || !rest.empty())
    throw std::invalid_argument(fmt::format("has the shape ({}); two dimensions are read", printable(shape)));
  NpyTable table;
  table.rows = *rows;
  table.columns = *columns;
  const std::uint64_t count = std::uint64_t(table.rows) * std::uint64_t(table.columns);
  if (bytes.size() - header.end != count * size)
    throw std::invalid_argument(fmt::format("has {} bytes of values; {} x {} values have {}", bytes.size() - header.end,
                                            table.rows, table.columns, count * size));
  const std::string_view values = std::string_view(bytes).substr(header.end);
  table.values = size == sizeof(float) ? values_of<float>(values) : values_of<double>(values);
  return table;
}

}  // namespace

NpyTable read_npy(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  try {
    return table_of(bytes);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", printable(file.string()), error.what()));
  }
}

void write_npy(const NpyTable& table, const std::filesystem::path& file) {
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}", table.rows, table.columns);
  const std::size_t unpadded = before_length + 2 + header.size() + 1;
  header.append((alignment - unpadded % alignment) % alignment, ' ') += '\n';
  const auto length = static_cast<std::uint16_t>(header.size());
  AtomicFile out(file);
  out.stream().write(magic.data(), std::streamsize(magic.size())).write("\x01\x00", 2);
  out.stream().write(reinterpret_cast<const char*>(&length), 2) << header;
  out.stream().write(reinterpret_cast<const char*>(table.values.data()),
                     std::streamsize(table.values.size() * sizeof(float)));
  out.commit();
}

}  // namespace nextview
