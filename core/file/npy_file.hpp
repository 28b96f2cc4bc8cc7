#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace nextview {

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
