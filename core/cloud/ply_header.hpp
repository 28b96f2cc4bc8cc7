#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nextview {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

struct PlyType {
  std::string_view name, other_name;
  std::size_t size;  ///< [bytes]
  enum Kind { is_signed, is_unsigned, is_float } kind;
};

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> list_size;  ///< of lists: the type of their length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// What a PLY file says of itself.
struct PlyHeader {
  PlyFormat format;
  std::vector<PlyElement> elements;
  std::size_t size;                        ///< of the header; the data begin there [bytes]
  std::vector<std::string> unknown_lines;  ///< that were read on over; Stanford's scans have such
};

/// @throws std::runtime_error with one line that says what is wrong with the header; the file's name is for the caller
/// to add.
PlyHeader parse_ply_header(std::string_view data);

}  // namespace nextview
