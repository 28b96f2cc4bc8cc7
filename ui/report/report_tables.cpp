// The tables of a study's report.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/file/counted.hpp"
#include "ui/appearance/markup.hpp"
#include "ui/report/html.hpp"
#include "ui/report/study_chart_parts.hpp"
#include "ui/report/study_report.hpp"

namespace nextview {
namespace {

using Cells = std::vector<std::string>;

/// What tables have beside the main measure: a number after the last view, or the one there is.
struct Extra {
  const char *measure, *heading;
  double unit;
  int digits;
};
std::span<const Extra> extras(StudyPart part) {
  static constexpr Extra plans[] = {{"coverage[%]", "coverage at the end [%]", 1.0, 1},
                                    {"path[m]", "path [m]", 1.0, 2}};
  static constexpr Extra maps[] = {{"d_kl[nats]", "D_KL [knats]", 1e3, 1},
                                   {"rows_open[%]", "open rows [%]", 1.0, 1},
                                   {"leaks[%]", "leaks [%]", 1.0, 1}};
  return part == StudyPart::planning ? std::span<const Extra>(plans) : std::span<const Extra>(maps);
}

std::string heading_of(StudyPart part) {
  return part == StudyPart::planning ? "mean coverage over the views [%]"
                                     : "log loss near the surface [nats per voxel]";
}

/// Without a sign where nothing is left of the number.
std::string fixed(double value, int digits) {
  const std::string text = fmt::format("{:.{}f}", value, digits);
  return text.find_first_of("123456789") == std::string::npos ? fmt::format("{:.{}f}", 0.0, digits) : text;
}

std::string with_spread(const SummaryRow& row, StudyPart part) {
  const int digits = part == StudyPart::planning ? 1 : 3;
  const std::string mean = fixed(row.mean, digits);
  return row.runs < 2 ? mean : mean + " ± " + fixed(row.spread, digits);
}

/// Rows of one setting and object.
class Rows {
 public:
  Rows(const SummaryTable& table, const StudySetting& setting, const std::string& object) : part_(setting.part) {
    for (const SummaryRow& row : table.rows())
      if (row.part == name(setting.part) && row.block == setting.block && row.sensor == setting.sensor &&
          row.views == setting.views && row.object == object)
        rows_.push_back(&row);
  }
  /// The last there is: of courses, what is reached at the end.
  const SummaryRow* find(const std::string& method, std::string_view measure) const {
    const SummaryRow* found = nullptr;
    for (const SummaryRow* row : rows_)
      if (row->method == method && row->measure == measure && (!found || row->at > found->at)) found = row;
    return found;
  }
  const SummaryRow* comparison(const std::string& method) const {
    const std::string begin = std::string(main_measure(part_)) + " - ";
    for (const SummaryRow* row : rows_)
      if (row->method == method && row->measure.starts_with(begin)) return row;
    return nullptr;
  }
  /// "random": what the others are compared with.
  std::string reference() const {
    for (const SummaryRow* row : rows_)
      if (const auto dash = row->measure.find(" - "); dash != std::string::npos) return row->measure.substr(dash + 3);
    return {};
  }
  bool has_reference() const { return !reference().empty(); }
  StudyPart part() const { return part_; }

 private:
  StudyPart part_;
  std::vector<const SummaryRow*> rows_;
};

Cells columns(const Rows& rows, bool of_means) {
  Cells cells = {"method", of_means ? "objects" : "runs", heading_of(rows.part())};
  if (rows.has_reference()) {
    cells.push_back("difference to " + markup_text(in_words(rows.reference())) + ", pairwise");
    cells.emplace_back(of_means ? "better on" : "better in");
  }
  if (rows.part() == StudyPart::planning) cells.emplace_back("gap closed");
  for (const Extra& extra : extras(rows.part())) cells.emplace_back(extra.heading);
  cells.emplace_back("of runs");
  cells.emplace_back("hash");
  return cells;
}

/// A method's numbers, each of the same runs.
Cells cells_of(const Rows& rows, const std::string& method) {
  const SummaryRow* main = rows.find(method, main_measure(rows.part()));
  if (!main) return {};
  Cells cells = {markup_text(in_words(method)), fmt::format("{}", main->runs), with_spread(*main, rows.part())};
  if (rows.has_reference()) {
    const SummaryRow* pairs = rows.comparison(method);
    cells.push_back(pairs ? with_spread(*pairs, rows.part()) : "");
    cells.push_back(pairs && pairs->better ? fmt::format("{} of {}", *pairs->better, pairs->runs) : "");
  }
  if (rows.part() == StudyPart::planning) {
    const SummaryRow* gap = rows.find(method, "gap_closed");
    cells.push_back(gap ? fixed(gap->mean, 2) : "");
  }
  for (const Extra& extra : extras(rows.part())) {
    const SummaryRow* row = rows.find(method, extra.measure);
    cells.push_back(row ? fixed(row->mean / extra.unit, extra.digits) : "");
  }
  cells.push_back(fmt::format("{}-{}", main->first_run, main->last_run));
  cells.push_back("<code>" + markup_text(main->hash) + "</code>");
  return cells;
}

std::string table_of(const SummaryTable& table, const StudySetting& setting, const std::string& object) {
  const Rows rows(table, setting, object);
  std::vector<Cells> cells;
  for (const std::string& method : table.methods(setting, main_measure(setting.part)))
    if (Cells row = cells_of(rows, method); !row.empty()) cells.push_back(std::move(row));
  return html_table(columns(rows, object == mean_object), cells, 1);
}

std::string setting_section(const SummaryTable& table, const StudySetting& setting) {
  std::string text = fmt::format("<h3>Sensor {}, {}</h3>\n", markup_text(in_words(setting.sensor)),
                                 counted(std::uint64_t(setting.views), "view"));
  text += table_of(table, setting, mean_object);
  const auto objects = table.objects(setting, main_measure(setting.part));
  text += fmt::format("<details><summary>by object ({})</summary>\n", objects.size());
  for (const std::string& object : objects)
    text += fmt::format("<h4>{}</h4>\n", markup_text(in_words(object))) + table_of(table, setting, object);
  return text + "</details>\n";
}

/// The best method of those that do not know the object, by the main measure.
std::string best_method(const Rows& rows, const std::vector<std::string>& methods) {
  std::string best;
  double value = 0.0;
  for (const std::string& method : methods) {
    const SummaryRow* row = rows.find(method, main_measure(rows.part()));
    if (!row || method == "oracle" || method == "set-cover") continue;
    if (best.empty() || (more_is_better(rows.part()) ? row->mean > value : row->mean < value))
      best = method, value = row->mean;
  }
  return best;
}

std::vector<StudySetting> settings_of(const Study& study, std::size_t block, const SummaryTable& table) {
  std::vector<StudySetting> settings;
  const StudyBlock& b = study.blocks[block];
  for (const std::string& sensor : b.sensors)
    for (const int views : b.views)
      if (const StudySetting setting{b.part, block + 1, sensor, views};
          !table.methods(setting, main_measure(b.part)).empty())
        settings.push_back(setting);
  return settings;
}

/// "objects a, b; seeds 1, 2; …"
std::string block_text(const StudyBlock& block) {
  std::vector<std::string> objects;
  for (const std::string& object : block.objects) objects.push_back(object_label(object));
  std::string text = fmt::format("Objects {}; seeds {}", fmt::join(objects, ", "), fmt::join(block.seeds, ", "));
  if (block.part == StudyPart::planning)
    text += fmt::format("; start views (azimuth, elevation) at {} degrees", fmt::join(block.starts, ", "));
  return markup_text(text + ".");
}

}  // namespace

std::string report_overview(const Study& study, const SummaryTable& table) {
  std::string text;
  for (const StudyPart part : {StudyPart::planning, StudyPart::maps}) {
    std::vector<Cells> cells;
    for (std::size_t i = 0; i < study.blocks.size(); ++i) {
      if (study.blocks[i].part != part) continue;
      for (const StudySetting& setting : settings_of(study, i, table)) {
        const Rows rows(table, setting, mean_object);
        const std::string best = best_method(rows, table.methods(setting, main_measure(part)));
        Cells row = best.empty() ? Cells() : cells_of(rows, best);
        if (row.empty()) continue;
        row.resize(5);  // up to the comparison
        row.insert(row.begin(),
                   {fmt::format("{}", i + 1), markup_text(in_words(setting.sensor)), fmt::format("{}", setting.views)});
        row[6] +=
            rows.reference().empty() || row[6].empty() ? "" : " (" + markup_text(in_words(rows.reference())) + ")";
        cells.push_back(std::move(row));
      }
    }
    if (cells.empty()) continue;
    text += part == StudyPart::planning ? "<h3>Plans: the most coverage without knowing the object</h3>\n"
                                        : "<h3>Maps: the least log loss near the surface</h3>\n";
    text += html_table(
        {"block", "sensor", "views", "best", "objects", heading_of(part), "difference, pairwise", "better on"}, cells,
        4);
  }
  return text;
}

std::string report_tables(const Study& study, const SummaryTable& table) {
  std::string text;
  for (std::size_t i = 0; i < study.blocks.size(); ++i) {
    const StudyBlock& block = study.blocks[i];
    text += fmt::format("<h2>Block {}: {}</h2>\n<p>{}</p>\n", i + 1,
                        block.part == StudyPart::planning ? "plans" : "maps", block_text(block));
    for (const StudySetting& setting : settings_of(study, i, table)) text += setting_section(table, setting);
  }
  return text;
}

}  // namespace nextview
