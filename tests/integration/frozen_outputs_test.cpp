// What scans of some configurations gave when they were frozen, they give now: the same maps, clouds and views, and the
// same numbers but for the order of sums. Who means to change one runs tests/update-frozen and says why in the commit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/file/atomic_file.hpp"
#include "core/file/file_hash.hpp"
#include "core/file/read_file.hpp"
#include "tests/integration/program.hpp"
#include "tests/integration/tables.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

const fs::path frozen = fs::path(NEXTVIEW_SOURCE_DIR) / "tests" / "data" / "frozen";
constexpr std::array same_bytes = {"map.ot", "map.bt", "cloud.ply"};
constexpr std::array same_numbers = {"steps.csv", "views.csv", "scores.csv"};
constexpr double tolerance = 1e-9;  // relative: sums may be added in another order

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(frozen))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Columns and keys have moved on: a line `old new` for each.
std::string now_called(const std::string& column) {
  std::istringstream lines(read_file(frozen / "renamed_columns.txt"));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(column + " ")) return line.substr(column.size() + 1);
  return column;
}

/// The same of the path of a value in JSON, "/diagnostics/sweeps".
std::string path_now_called(const std::string& path) {
  std::string now;
  std::istringstream keys(path.substr(1));
  for (std::string key; std::getline(keys, key, '/');) now += "/" + now_called(key);
  return now;
}

std::optional<double> number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return text.empty() || *end != '\0' ? std::nullopt : std::optional(value);
}

bool same(const std::string& before, const std::string& now) {
  const auto a = number(before), b = number(now);
  return a && b ? std::abs(*a - *b) <= tolerance * std::max(std::abs(*a), std::abs(*b)) : before == now;
}

void expect_same_table(const std::string& before, const std::string& now, const std::string& what) {
  const Table old_rows = read_table(before), new_rows = read_table(now);
  ASSERT_EQ(old_rows.size(), new_rows.size()) << what;
  for (std::size_t row = 0; row < old_rows.size(); ++row)
    for (const auto& [column, cell] : old_rows[row]) {
      const auto found = new_rows[row].find(now_called(column));
      ASSERT_NE(found, new_rows[row].end()) << what << ": column " << column;
      EXPECT_TRUE(same(cell, found->second))
          << what << ", row " << row + 1 << ", " << column << ": " << cell << " became " << found->second;
    }
}

void expect_same_json(const std::string& before, const std::string& now, const std::string& what) {
  const OrderedJson old_values = OrderedJson::parse(before).flatten(), new_values = OrderedJson::parse(now).flatten();
  for (const auto& [path, value] : old_values.items()) {
    const std::string key = path_now_called(path);
    ASSERT_TRUE(new_values.contains(key)) << what << ": " << key;
    EXPECT_TRUE(same(value.is_string() ? value.get<std::string>() : value.dump(),
                     new_values[key].is_string() ? new_values[key].get<std::string>() : new_values[key].dump()))
        << what << ": " << key << ": " << value << " became " << new_values[key];
  }
}

OrderedJson hashes_of(const fs::path& folder) {
  OrderedJson hashes;
  for (const char* name : same_bytes) {
    const FileHash hash = file_hash(folder / name);
    hashes[name] = {{"bytes", hash.bytes}, {"crc32", hash.crc32}};
  }
  return hashes;
}

class FrozenOutputs : public ::testing::TestWithParam<std::string> {
 protected:
  fs::path scanned(const std::string& name) const {
    const fs::path out = folder_.path() / name;
    const Result run = nextview("scan --config '" + (frozen / (name + ".toml")).string() +
                                "' --no-pictures --no-surfaces --overwrite --out '" + out.string() + "'");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return out;
  }
  const TemporaryFolder folder_;
};

TEST_P(FrozenOutputs, AreWhatTheyWere) {
  const fs::path now = scanned(GetParam()), before = frozen / GetParam();
  if (std::getenv("NEXTVIEW_UPDATE_FROZEN")) {
    fs::create_directories(before);
    write_file(before / "hashes.json", hashes_of(now).dump(2) + "\n");
    for (const char* name : same_numbers) write_file(before / name, read_file(now / name));
    write_file(before / "metrics.json", read_file(now / "metrics.json"));
    return;
  }
  // Processors round rays differently in the last bit. `as_sensed` is what one view sees, before anything is made of
  // it.
  if (hashes_of(scanned("as_sensed")) != OrderedJson::parse(read_file(frozen / "as_sensed" / "hashes.json")))
    GTEST_SKIP() << "this processor rounds rays otherwise than the one that the outputs were frozen on; to compare two "
                    "versions here, freeze the earlier one with tests/update-frozen";
  for (const char* name : same_numbers)
    expect_same_table(read_file(before / name), read_file(now / name), GetParam() + "/" + name);
  expect_same_json(read_file(before / "metrics.json"), read_file(now / "metrics.json"), GetParam() + "/metrics.json");
  EXPECT_EQ(hashes_of(now), OrderedJson::parse(read_file(before / "hashes.json"))) << "a map or a cloud has changed";
}

INSTANTIATE_TEST_SUITE_P(Configurations, FrozenOutputs, ::testing::ValuesIn(names()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace nextview
