#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace nextview {

/// What a .npy file says before its values.
struct NpyHeader {
  std::string type;  ///< as NumPy names it: "<f4"
  int columns = 0, rows = 0;
  std::size_t end = 0;  ///< where the values begin [bytes]
};
/// Of a file's bytes: two dimensions, row by row (C order), versions 1 to 3.
/// @throws std::runtime_error with the reason alone, for the caller to name the file
NpyHeader npy_header(std::string_view bytes);

/// A table of numbers as NumPy keeps it, row by row.
struct NpyTable {
  int columns = 0, rows = 0;
  std::vector<float> values;  ///< columns * rows
};

/// Reads a .npy file of float32 or float64 with two dimensions, little-endian, row by row (C order): versions 1 to 3.
/// @throws std::runtime_error naming the file and the reason: missing, no regular file, another type or order,
///         not as many values as its shape says
NpyTable read_npy(const std::filesystem::path& file);
/// The same of a file's bytes that are at hand. @throws likewise
NpyTable npy_of(const std::string& bytes, const std::filesystem::path& file);
/// Written beside the file, then renamed. @throws std::runtime_error naming the file and the reason
void write_npy(const NpyTable& table, const std::filesystem::path& file);

}  // namespace nextview
