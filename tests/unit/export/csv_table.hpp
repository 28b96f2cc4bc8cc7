#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace nextview {

/// Rows of a CSV without quotes, by column.
class CsvTable {
 public:
  explicit CsvTable(const std::filesystem::path& file) {
    std::ifstream text(file);
    std::string line;
    std::getline(text, line);
    columns_ = split(line);
    while (std::getline(text, line)) {
      rows_.push_back(split(line));
      EXPECT_EQ(rows_.back().size(), columns_.size()) << file << ": " << line;
    }
  }
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t size() const { return rows_.size(); }
  std::string text(std::size_t row, const std::string& column) const {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    if (found == columns_.end()) {
      ADD_FAILURE() << "there is no column " << column;
      return "";
    }
    return rows_.at(row).at(std::size_t(found - columns_.begin()));
  }
  double number(std::size_t row, const std::string& column) const {
    const std::string cell = text(row, column);
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    EXPECT_TRUE(!cell.empty() && *end == '\0') << column << ": " << cell;
    return value;
  }

 private:
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream text(line + ",");
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    return cells;
  }
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace nextview
