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
struct HeaderText {
  std::string_view text;
  std::size_t end = 0;
};

HeaderText header_text(std::string_view bytes) {
  if (!bytes.starts_with(magic) || bytes.size() < before_length) throw std::runtime_error("is no .npy file");
  const unsigned version = static_cast<unsigned char>(bytes[6]);
  if (version < 1 || version > 3) throw std::runtime_error(fmt::format("has version {} of .npy", version));
  const std::size_t width = version == 1 ? 2 : 4;
  if (bytes.size() < before_length + width) throw std::runtime_error("ends within its header");
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + before_length, width);
  const std::size_t begin = before_length + width;
  if (bytes.size() - begin < length) throw std::runtime_error("ends within its header");
  return {bytes.substr(begin, length), begin + length};
}

// By hand: compiling regular expressions is not safe from several threads in GCC's library, and captures are read so.
constexpr std::string_view blanks = " \t\r\n", quotes = "'\"";

void skip_all(std::string_view& text, std::string_view of) {
  text.remove_prefix(std::min(text.find_first_not_of(of), text.size()));
}

/// Whether the text began with one of these, which is skipped.
bool skip_one(std::string_view& text, std::string_view of) {
  if (text.empty() || of.find(text.front()) == of.npos) return false;
  text.remove_prefix(1);
  return true;
}

/// What stands behind a key of the header, a Python dictionary, and all after it; empty if there is none.
std::string_view after_key(std::string_view header, std::string_view key) {
  if (header.size() > 4096) return {};  // no table of two dimensions says so much
  for (std::size_t at = header.find(key, 1); at < header.size(); at = header.find(key, at + 1)) {
    std::string_view rest = header.substr(at + key.size());
    if (quotes.find(header[at - 1]) == quotes.npos || !skip_one(rest, quotes)) continue;
    skip_all(rest, blanks);
    if (!skip_one(rest, ":")) continue;
    skip_all(rest, blanks);
    return rest;
  }
  return {};
}

/// A text between two of its ends, of which any of `first` begins it; empty if none does.
std::string_view between(std::string_view text, std::string_view first, std::string_view last) {
  if (!skip_one(text, first)) return {};
  const std::size_t end = text.find_first_of(last);
  return end == text.npos ? std::string_view() : text.substr(0, end);
}

/// Of at most six digits, with spaces around it.
std::optional<int> take_size(std::string_view& text) {
  skip_all(text, " ");
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + std::min<std::size_t>(text.size(), 6), number);
  if (error != std::errc()) return {};
  text.remove_prefix(std::size_t(end - text.data()));
  skip_all(text, " ");
  return int(number);
}

template <class Value>
std::vector<float> values_of(std::string_view bytes) {
  std::vector<Value> values(bytes.size() / sizeof(Value));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
  return {values.begin(), values.end()};
}

NpyTable table_of(std::string_view bytes) {
  const NpyHeader header = npy_header(bytes);
  if (header.type != "<f4" && header.type != "<f8")
    throw std::runtime_error(
        fmt::format("holds values of type '{}'; float32 ('<f4') and float64 ('<f8') are read", printable(header.type)));
  const std::size_t size = header.type == "<f4" ? sizeof(float) : sizeof(double);
  NpyTable table;
  table.rows = header.rows;
  table.columns = header.columns;
  const std::uint64_t count = std::uint64_t(table.rows) * std::uint64_t(table.columns);
  if (bytes.size() - header.end != count * size)
    throw std::runtime_error(fmt::format("has {} bytes of values; {} x {} values have {}", bytes.size() - header.end,
                                         table.rows, table.columns, count * size));
  const std::string_view values = bytes.substr(header.end);
  table.values = size == sizeof(float) ? values_of<float>(values) : values_of<double>(values);
  return table;
}

}  // namespace

NpyHeader npy_header(std::string_view bytes) {
  const HeaderText header = header_text(bytes);
  const std::string_view type = between(after_key(header.text, "descr"), quotes, quotes);
  if (type.empty()) throw std::runtime_error("does not say of what type its values are");
  if (!after_key(header.text, "fortran_order").starts_with("False"))
    throw std::runtime_error("is not row by row (C order)");
  const std::string_view shape = between(after_key(header.text, "shape"), "(", ")");
  std::string_view rest = shape;
  const std::optional<int> rows = take_size(rest);
  const bool is_two = rows && skip_one(rest, ",");
  const std::optional<int> columns = is_two ? take_size(rest) : std::nullopt;
  if (columns && skip_one(rest, ",")) skip_all(rest, " ");
  if (!columns || !rest.empty())
    throw std::runtime_error(fmt::format("has the shape ({}); two dimensions are read", printable(shape)));
  return {std::string(type), *columns, *rows, header.end};
}

NpyTable read_npy(const std::filesystem::path& file) { return npy_of(read_file(file), file); }

NpyTable npy_of(const std::string& bytes, const std::filesystem::path& file) {
  try {
    return table_of(bytes);
  } catch (const std::runtime_error& error) {
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
