#include "core/cloud/ply_header.hpp"

#include <fmt/format.h>

#include <charconv>
#include <sstream>
#include <stdexcept>

namespace nextview {
namespace {

constexpr std::array types = {
    PlyType{"char", "int8", 1, PlyType::is_signed},    PlyType{"uchar", "uint8", 1, PlyType::is_unsigned},
    PlyType{"short", "int16", 2, PlyType::is_signed},  PlyType{"ushort", "uint16", 2, PlyType::is_unsigned},
    PlyType{"int", "int32", 4, PlyType::is_signed},    PlyType{"uint", "uint32", 4, PlyType::is_unsigned},
    PlyType{"float", "float32", 4, PlyType::is_float}, PlyType{"double", "float64", 8, PlyType::is_float}};

constexpr std::size_t longest_header = std::size_t{1} << 20;  // [bytes]

[[noreturn]] void fail(const std::string& reason) { throw std::runtime_error(reason); }

PlyType type_named(std::string_view name) {
  for (const PlyType& type : types)
    if (name == type.name || name == type.other_name) return type;
  fail(fmt::format("a property has the unknown type '{:.60}'", name));
}

PlyFormat read_format(std::istringstream& words) {
  std::string name;
  words >> name;
  if (name == "ascii") return PlyFormat::ascii;
  if (name == "binary_little_endian") return PlyFormat::binary_little_endian;
  if (name == "binary_big_endian") return PlyFormat::binary_big_endian;
  fail(fmt::format("its format '{:.60}' is unknown", name));
}

PlyElement read_element(std::istringstream& words) {
  PlyElement element;
  std::string count;
  words >> element.name >> count;
  const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (error != std::errc() || end != count.data() + count.size())
    fail(fmt::format("element '{:.60}' has no valid count ('{:.60}')", element.name, count));
  return element;
}

PlyProperty read_property(std::istringstream& words) {
  PlyProperty property;
  std::string type;
  words >> type;
  if (type == "list") {
    words >> type;
    property.list_size = type_named(type);
    words >> type;
  }
  property.type = type_named(type);
  words >> property.name;
  return property;
}

/// Takes the next line off the front of `rest`.
std::string_view next_line(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  if (end == std::string_view::npos) fail("its header has no end_header");
  std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace

PlyHeader parse_ply_header(std::string_view data) {
  if (!data.starts_with("ply\n") && !data.starts_with("ply\r\n"))
    fail("it is no PLY file (it does not begin with 'ply')");
  PlyHeader header;
  std::optional<PlyFormat> format;
  std::string_view rest = data;
  next_line(rest);
  for (std::string_view line = next_line(rest); line != "end_header"; line = next_line(rest)) {
    std::istringstream words{std::string(line)};
    std::string key;
    words >> key;
    if (key == "format") {
      format = read_format(words);
    } else if (key == "element") {
      header.elements.push_back(read_element(words));
    } else if (key == "property") {
      if (header.elements.empty()) fail("a property stands before the first element");
      header.elements.back().properties.push_back(read_property(words));
    } else if (key != "comment" && key != "obj_info") {
      header.unknown_lines.emplace_back(line);
    }
    if (data.size() - rest.size() > longest_header) fail(fmt::format("its header exceeds {} bytes", longest_header));
  }
  if (!format) fail("its header names no format");
  header.format = *format;
  header.size = data.size() - rest.size();
  return header;
}

}  // namespace nextview
