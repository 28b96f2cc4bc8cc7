#include "core/study/summary_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "core/file/read_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[i];
  }
  return cells;
}

/// @throws std::invalid_argument
template <class Number>
Number number(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) throw std::invalid_argument("no number");
  return value;
}

SummaryRow row_of(const std::string& line) {
  const std::vector<std::string> c = cells_of(line);
  if (c.size() != 15) throw std::invalid_argument("no row");
  SummaryRow row;
  row.part = c[0], row.object = c[2], row.sensor = c[3], row.method = c[5], row.measure = c[6];
  row.block = number<std::size_t>(c[1]);
  row.views = number<int>(c[4]);
  row.at = number<double>(c[7]);
  row.runs = number<std::size_t>(c[8]);
  if (!c[9].empty()) row.mean = number<double>(c[9]), row.spread = number<double>(c[10]);
  if (!c[11].empty()) row.better = number<std::size_t>(c[11]);
  const std::size_t dash = c[12].find('-');
  row.first_run = number<std::size_t>(c[12].substr(0, dash));
  row.last_run = number<std::size_t>(c[12].substr(dash + 1));
  row.hash = c[13], row.note = c[14];
  return row;
}

bool is_of(const SummaryRow& row, const StudySetting& setting) {
  return row.part == name(setting.part) && row.block == setting.block && row.sensor == setting.sensor &&
         row.views == setting.views;
}

}  // namespace

SummaryTable::SummaryTable(const fs::path& folder) {
  const fs::path file = folder / "summary.csv";
  std::istringstream in(read_file(file));
  std::string line;
  std::getline(in, line);
  if (!line.starts_with("part,block,object,sensor,views,method,measure,at,"))
    throw std::runtime_error(fmt::format("{}: is no summary of a study", file.string()));
  for (int number = 2; std::getline(in, line); ++number) try {
      rows_.push_back(row_of(line));
    } catch (const std::invalid_argument&) {
      throw std::runtime_error(fmt::format("{}:{}: is no row of a summary", file.string(), number));
    }
}

std::vector<SummaryTable::Point> SummaryTable::course(const StudySetting& setting, const std::string& object,
                                                      const std::string& method, const std::string& measure) const {
  std::vector<Point> points;
  for (const SummaryRow& row : rows_) {
    if (!is_of(row, setting) || row.object != object || row.method != method || row.measure != measure) continue;
    points.push_back({row.at, row.mean, row.spread});
  }
  return points;
}

std::optional<double> SummaryTable::value(const StudySetting& setting, const std::string& object,
                                          const std::string& method, const std::string& measure) const {
  const auto points = course(setting, object, method, measure);
  return points.empty() ? std::nullopt : std::optional(points.front().mean);
}

std::vector<std::string> SummaryTable::distinct(const StudySetting& setting, const std::string& measure,
                                                const std::function<const std::string&(const SummaryRow&)>& of) const {
  std::vector<std::string> names;
  for (const SummaryRow& row : rows_)
    if (is_of(row, setting) && row.measure == measure && std::ranges::find(names, of(row)) == names.end())
      names.push_back(of(row));
  return names;
}

std::vector<std::string> SummaryTable::methods(const StudySetting& setting, const std::string& measure) const {
  return distinct(setting, measure, [](const SummaryRow& row) -> const std::string& { return row.method; });
}

std::vector<std::string> SummaryTable::objects(const StudySetting& setting, const std::string& measure) const {
  auto names = distinct(setting, measure, [](const SummaryRow& row) -> const std::string& { return row.object; });
  std::erase(names, mean_object);
  return names;
}

std::vector<StudySetting> SummaryTable::settings(StudyPart part, const std::string& measure) const {
  std::vector<StudySetting> all;
  for (const SummaryRow& row : rows_) {
    const StudySetting setting{part, row.block, row.sensor, row.views};
    if (row.part == name(part) && row.measure == measure && std::ranges::find(all, setting) == all.end())
      all.push_back(setting);
  }
  const auto count = [&](const StudySetting& s) { return objects(s, measure).size() * methods(s, measure).size(); };
  std::ranges::stable_sort(all, std::greater(), count);
  return all;
}

std::vector<TimingRow> read_study_timings(const fs::path& folder) {
  std::vector<TimingRow> rows;
  if (!is_there(folder / study_timings_name)) return rows;
  std::istringstream in(read_file(folder / study_timings_name));
  for (std::string line; std::getline(in, line);) try {
      const std::vector<std::string> c = cells_of(line);
      if (c.size() != 15) continue;
      const auto seconds = [&](std::size_t i) { return number<double>(c[i]); };
      rows.push_back({c[1],
                      c[2],
                      c[3],
                      number<int>(c[4]),
                      c[5],
                      {{seconds(8), seconds(9), seconds(10), seconds(11), seconds(13), seconds(12)}, seconds(14)}});
    } catch (const std::invalid_argument&) {  // the header, or what a killed program left
    }
  return rows;
}

}  // namespace nextview
