#include "ui/report/study_report.hpp"

#include <fmt/format.h>

#include "core/file/file_hash.hpp"
#include "core/file/json_text.hpp"
#include "core/file/read_file.hpp"
#include "core/study/study_folder.hpp"
#include "ui/appearance/markup.hpp"
#include "ui/report/html.hpp"
#include "ui/report/study_charts.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json study_json(const fs::path& folder) {
  const fs::path file = folder / study_json_name;
  Json json = parse_json_if_it_is<Json>(read_file(file));
  if (!json.is_object() || !json.contains("program") || !json.contains("runs") || !json.contains("objects"))
    throw std::runtime_error(file.string() + ": is not that of a study");
  return json;
}

std::string text_of(const Json& value) {
  return markup_text(value.is_string() ? value.get<std::string>() : json_text(value));
}

/// What it is, and how to have it again.
std::string head(const fs::path& folder, const Study& study, const Json& json) {
  const FileHash summary = file_hash(folder / "summary.csv");
  std::string text = fmt::format(
      "<h1>Study {}</h1>\n<p class=\"soft\">{}, {} runs; summary.csv of {} bytes, crc32 {}</p>\n",
      markup_text(study.name), text_of(json.at("program")), text_of(json.at("runs")), summary.bytes, summary.crc32);
  text +=
      "<p>Each row of the tables stands for the runs in its column <em>of runs</em>; its hash is of their keys, which "
      "follow from the program's version, the settings and the bytes of the objects. With the study's file (at the end "
      "of this page) as study.toml, and the same version and objects, this computes them once more, to the same "
      "hash and the same numbers:</p>\n<pre>nextview study study.toml --runs FIRST-LAST --out again</pre>\n"
      "<p>Without <code>--runs</code> it computes all. Numbers are mean ± standard deviation: of an object over its "
      "start views and seeds; of all objects over their means. Pairwise differences are between runs that differ in "
      "their method alone. Methods take turns, so the runs from the first to the last of a mean over objects are "
      "those of other methods too.</p>\n";
  return text;
}

std::string figures(const SummaryTable& table) {
  std::string text = "<h2>Figures</h2>\n";
  for (const StudyFigure& figure : study_figures())
    if (const auto drawing = figure.draw(table, Look::light()))
      text += fmt::format(
          "<figure>\n{}<figcaption>{} <code>nextview figure {} --study STUDY --out figures</code>"
          "</figcaption>\n</figure>\n",
          drawing->svg(), markup_text(figure.caption), figure.name);
  return text;
}

std::string failures(const SummaryTable& table) {
  std::vector<std::vector<std::string>> cells;
  for (const SummaryRow& row : table.rows())
    if (row.measure == "failure")
      cells.push_back({markup_text(row.object), markup_text(row.sensor), markup_text(row.method), markup_text(row.note),
                       fmt::format("{}", row.runs), fmt::format("{}-{}", row.first_run, row.last_run)});
  if (cells.empty()) return "<h2>Runs that came to nothing</h2>\n<p>None.</p>\n";
  return "<h2>Runs that came to nothing</h2>\n" +
         html_table({"object", "sensor", "method", "the first reason", "runs", "of runs"}, cells, 4);
}

std::string seconds(const fs::path& folder) {
  const auto timings = read_study_timings(folder);
  if (timings.empty()) return {};
  TimeTable table = time_table(timings);
  for (auto& row : table.rows)
    for (std::string& cell : row) cell = markup_text(cell);
  return "<h2>Seconds a view</h2>\n<p>On the machine that the study ran on; the only numbers here that differ from one "
         "time to the next.</p>\n<details><summary>by method and stage</summary>\n" +
         html_table(table.columns, table.rows, 4) + "</details>\n";
}

std::string inputs(const Json& json, const Study& study) {
  std::vector<std::vector<std::string>> cells;
  for (const auto& [object, said] : json.at("objects").items()) cells.push_back({markup_text(object), text_of(said)});
  return "<h2>Inputs</h2>\n" + html_table({"object", "its file"}, cells, 2) + "<h3>The study's file</h3>\n<pre>" +
         markup_text(study.text) + "</pre>\n";
}

}  // namespace

std::string study_report(const fs::path& folder, const SummaryTable& table) {
  const Study study = read_study(folder / study_file_name);
  const Json json = study_json(folder);
  return html_page("Study " + study.name, head(folder, study, json) + "<h2>At a glance</h2>\n" +
                                              report_overview(study, table) + figures(table) +
                                              report_tables(study, table) + failures(table) + seconds(folder) +
                                              inputs(json, study));
}

}  // namespace nextview
