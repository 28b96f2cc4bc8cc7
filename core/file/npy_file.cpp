#include "core/file/npy_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <regex>
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

/// What stands behind a key of the header, a Python dictionary; empty if there is none.
std::string value_of(const std::string& header, const char* key, const char* pattern) {
  if (header.size() > 4096) return {};  // std::regex recurses
  std::smatch match;
  const std::regex expression(fmt::format("['\"]{}['\"]\\s*:\\s*{}", key, pattern));
  return std::regex_search(header, match, expression) ? match[1].str() : std::string();
}

template <class Value>
std::vector<float> values_of(std::string_view bytes) {
  std::vector<Value> values(bytes.size() / sizeof(Value));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
  return {values.begin(), values.end()};
}

NpyTable table_of(const std::string& bytes) {
  const Header header = header_of(bytes);
  const std::string type = value_of(header.text, "descr", "['\"]([^'\"]*)['\"]");
  if (type != "<f4" && type != "<f8")
    throw std::invalid_argument(
        fmt::format("holds values of type '{}'; float32 ('<f4') and float64 ('<f8') are read", printable(type)));
  const std::size_t size = type == "<f4" ? sizeof(float) : sizeof(double);
  if (value_of(header.text, "fortran_order", "(True|False)") != "False")
    throw std::invalid_argument("is not row by row (C order)");
  const std::string shape = value_of(header.text, "shape", "\\(([0-9, ]*)\\)");
  NpyTable table;
  const std::regex two("\\s*([0-9]{1,6})\\s*,\\s*([0-9]{1,6})\\s*,?\\s*");
  std::smatch sizes;
  if (!std::regex_match(shape, sizes, two))
    throw std::invalid_argument(fmt::format("has the shape ({}); two dimensions are read", printable(shape)));
  table.rows = std::stoi(sizes[1]);
  table.columns = std::stoi(sizes[2]);
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
