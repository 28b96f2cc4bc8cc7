#include "tests/integration/tables.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace nextview {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream text(line + ",");
  for (std::string cell; std::getline(text, cell, ',');) result.push_back(cell);
  return result;
}

}  // namespace

Table read_table(const std::string& csv) {
  std::istringstream text(csv);
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> head = cells(line);
  Table table;
  while (std::getline(text, line)) {
    const std::vector<std::string> row = cells(line);
    EXPECT_EQ(row.size(), head.size()) << line;
    auto& named = table.emplace_back();
    for (std::size_t c = 0; c < std::min(row.size(), head.size()); ++c) {
      EXPECT_TRUE(row[c] != "nan" && row[c] != "-nan" && row[c] != "inf" && row[c] != "-inf") << head[c];
      named[head[c]] = row[c];
    }
  }
  return table;
}

std::string toml_value(const std::string& toml, const std::string& key) {
  std::istringstream text(toml);
  std::vector<std::string> values;
  for (std::string line; std::getline(text, line);)
    if (line.starts_with(key + " = ")) {
      const std::size_t begin = key.size() + 3;
      values.push_back(line.substr(begin, line.find_first_of(" #", begin) - begin));
    }
  return values.size() == 1 ? values.front() : "";
}

std::vector<std::string> file_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

std::string wall_scene(double resolution) {
  std::string scene = fmt::format(
      "param resolution_m {}\nparam bbox_min_x -0.3\nparam bbox_max_x 0.3\nparam bbox_min_y -0.3\n"
      "param bbox_max_y 0.3\nparam bbox_min_z 0.4\nparam bbox_max_z 1.0\nscan 0 0 0 0 0 0 1 1600\n",
      resolution);
  for (int i = 0; i < 1600; ++i) scene += fmt::format("{} {} 0.7\n", -0.2 + 0.01 * (i % 40), -0.2 + 0.01 * (i / 40));
  return scene + "view 0 0 0 0 0 0 1\nview 0.1 0 0 0 0 0 1\n";
}

}  // namespace nextview
