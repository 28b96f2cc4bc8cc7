#include "app/commands/written_file_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/file/counted.hpp"
#include "core/file/json_text.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"

namespace nextview {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t largest = std::uintmax_t{1} << 28;  // [bytes]

/// A table is known by how its first line begins, for later versions add columns.
struct TableKind {
  std::string_view begins, what, row;
  std::vector<std::string_view> of_last_row = {};  ///< how the names of columns begin that say what came of it
};

const std::vector<TableKind>& table_kinds() {
  static const std::vector<TableKind> kinds = {
      {"step,view,overridden,",
       "the steps of a scan",
       "step",
       {"coverage_visible@", "coverage_recorded@", "surface_left", "entropy", "path"}},
      {"step,view,available,", "the candidates of a scan after each view", "row"},
      {"step,view,x[m],", "the views of a scan, as poses of the camera in the world", "view"},
      {"step,merged_rays,", "what refined the Gibbs map of a scan after each view", "refinement", {"sweeps", "r_hat"}},
      {"step,sense[s],", "the seconds that each step of a scan took", "step"},
      {"views,frame,name,", "the coverage of a recording by views, in this and in other orders", "row"},
      {"view,gain_before[nats],", "candidate views by their entropy in sight before and after a refinement", "view"},
      {"chain,sweep,", "the sweeps of a refinement's chains", "row"},
      {"lists[s],sweeps[s]", "the seconds that a refinement took", "row"},
      {"iteration,cross_entropy",
       "the way of a calibration to the fitted sensor model",
       "iteration",
       {"cross_entropy"}},
      {"object,views,held_out,", "the maps of a calibration, before and after it, compared with the objects", "row"},
      {"part,block,object,", "the summary of a study", "row"},
      {"run,key,part,", "the runs of a study, with their main measures", "run"},
      {"key,part,object,", "the seconds that each run of a study took", "run"},
      {"part,sensor,views,method,runs,sense", "the seconds a view and stage of a study's plans and maps (Table 1)",
       "row"},
      {"voxel,x,y,z,exact,", "a test problem of the Gibbs map, with its exact posterior", "voxel"},
  };
  return kinds;
}

/// `score --csv` names the gains that it was asked for in between.
const TableKind scores_of_views = {"view,", "the gains of candidate views", "view"};
constexpr std::string_view scores_end = ",rays,milliseconds";

const TableKind* kind_of(const std::string& head) {
  const auto& kinds = table_kinds();
  const auto found = std::ranges::find_if(kinds, [&](const TableKind& kind) { return head.starts_with(kind.begins); });
  if (found != kinds.end()) return &*found;
  return head.starts_with(scores_of_views.begins) && head.ends_with(scores_end) ? &scores_of_views : nullptr;
}

/// Without the digits of a number that mean nothing to people.
std::string short_text(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number && text.find('.') != text.npos ? fmt::format("{:.6g}", number) : text;
}

/// Of a line whose cells have no quotes, as those of the tables that are looked into.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) all.push_back(cell);
  return all;
}

std::optional<std::string> table_info(const std::filesystem::path& file) {
  std::istringstream lines(read_file(file, largest));
  std::string head, last;
  std::getline(lines, head);
  const TableKind* const kind = kind_of(head);
  if (!kind) return std::nullopt;
  std::size_t rows = 0;
  for (std::string line; std::getline(lines, line); last = line) ++rows;
  std::string text = fmt::format("{}: {}", kind->what, counted(rows, kind->row));
  const std::vector<std::string> names = cells(head), values = cells(last);
  for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i)
    if (!values[i].empty() &&
        std::ranges::any_of(kind->of_last_row, [&](std::string_view begin) { return names[i].starts_with(begin); }))
      text += fmt::format("\n  {} after the last: {}", printable(names[i]), printable(short_text(values[i])));
  return text;
}

/// A report is known by what it has at its top.
struct ReportKind {
  std::vector<const char*> members;
  const char* what;
};

const std::vector<ReportKind>& report_kinds() {
  static const std::vector<ReportKind> kinds = {
      {{"object", "gain", "views", "finished"}, "what a scan reached"},
      {{"name", "views", "diagnostics"}, "what a refinement of the map reached"},
      {{"program", "command", "files"}, "the list of what a command of Nextview wrote beside it"},
      {{"fit", "found_in_unmeasured"}, "where simulated scans found new surface"},
      {{"cross_entropy_before_nats", "examples"}, "the fit of a sensor model"},
      {{"program", "study", "rows"}, "the summary of a study"},
      {{"program", "study", "objects"}, "what a study is of"},
      {{"key", "part", "method", "measured"}, "a run of a study"},
      {{"figure", "caption"}, "what a figure shows, and is made from"},
      {{"mesh", "openings"}, "the slots and bores of a mesh"},
      {{"cameras"}, "the directions that a session is looked at from"},
  };
  return kinds;
}

constexpr std::string_view surface_names = "surface_";

std::string member_text(const std::string& name, const Json& value) {
  if (value.is_array()) return fmt::format("{}: {}", name, counted(value.size(), "entry", "entries"));
  std::string text = value.is_string() ? value.get<std::string>() : short_text(json_text(value));
  constexpr std::size_t longest = 300;  // of a configuration that a figure carries, its first lines
  if (text.size() > longest) text = text.substr(0, text.find('\n')) + " …";
  return fmt::format("{}: {}", name, text);
}

std::optional<std::string> report_info(const std::filesystem::path& file) {
  const Json json = parse_json_if_it_is<Json>(read_file(file, largest));
  if (json.is_array() && !json.empty() && json.front().is_object() && json.front().contains("T_world_camera"))
    return fmt::format("the views of a scan: {}", counted(json.size(), "view"));
  if (!json.is_object() || json.empty()) return std::nullopt;
  const auto& kinds = report_kinds();
  const auto found = std::ranges::find_if(kinds, [&](const ReportKind& kind) {
    return std::ranges::all_of(kind.members, [&](const char* member) { return json.contains(member); });
  });
  const bool is_of_surfaces = json.begin().key().starts_with(surface_names);
  if (found == kinds.end() && !is_of_surfaces) return std::nullopt;
  std::string text = is_of_surfaces ? "the surfaces that were made of a scan" : found->what;
  for (const auto& [name, value] : json.items()) {
    if (!value.is_object()) text += "\n  " + printable(member_text(name, value));
    if (!value.is_object()) continue;
    text += fmt::format("\n  {}:", printable(name));
    for (const auto& [inner, number] : value.items())
      if (!number.is_structured()) text += " " + printable(member_text(inner, number)) + ",";
    text.pop_back();
  }
  return text;
}

}  // namespace

std::optional<std::string> written_file_info(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".csv") return table_info(file);
  return ending == ".json" ? report_info(file) : std::nullopt;
}

}  // namespace nextview
