#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/progress.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/printable.hpp"
#include "core/progress/stopped.hpp"
#include "core/results/output_folder.hpp"
#include "ui/report/study_charts.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr const char* time_table_name = "table_1";
constexpr double design_dpi = 96.0;  // at which a pixel of a drawing is one of its picture

struct FigureArguments {
  std::string name, study, out;
  double dpi = 2 * design_dpi;
  bool list = false, dark = false;
};

bool is_wanted(const FigureArguments& a, const std::string& name) { return a.name == "all" || a.name == name; }

std::vector<std::string> known_figures() {
  std::vector<std::string> names = {"all"};
  for (const StudyFigure& figure : study_figures()) names.push_back(figure.name);
  names.emplace_back(time_table_name);
  return names;
}

void print_list() {
  for (const StudyFigure& figure : study_figures()) fmt::print("{:<22} {}\n", figure.name, figure.caption);
  fmt::print("{:<22} {}\n", time_table_name, "Table 1: seconds a view and stage, as CSV, Markdown and LaTeX.");
}

/// What a figure shows and what it was made from, beside it.
void write_caption(const std::string& name, const std::string& caption, const fs::path& study, const fs::path& out) {
  const nlohmann::ordered_json json = {{"figure", name},
                                       {"caption", caption},
                                       {"study", study.filename().string()},
                                       {"summary_crc32", file_hash(study / "summary.csv").crc32},
                                       {"configuration", read_file(study / study_file_name)}};
  write_file(out / (name + ".json"), json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void write_time_table(const fs::path& study, const fs::path& out) {
  const TimeTable table = time_table(read_study_timings(study));
  const std::string name = time_table_name;
  write_file(out / (name + ".csv"), csv_text(table));
  write_file(out / (name + ".md"), markdown_text(table));
  write_file(out / (name + ".tex"), latex_text(table));
  fmt::print("{}.csv, .md, .tex\n", name);
}

/// A figure that the study has nothing of is passed over, or, if it was asked for by name, an error.
void write_figure(const FigureArguments& a, const StudyFigure& figure, const SummaryTable& table,
                  const fs::path& study) {
  const auto drawing = figure.draw(table, a.dark ? Look::dark() : Look::light());
  if (!drawing && a.name != "all")
    throw std::invalid_argument(fmt::format("{}: the study has nothing that {} shows", study.string(), figure.name));
  if (!drawing) return;
  const fs::path out = a.out;
  write_file(out / (figure.name + ".svg"), drawing->svg());
  write_png(drawing->image(a.dpi / design_dpi), out / (figure.name + ".png"));
  write_caption(figure.name, figure.caption, study, out);
  fmt::print("{}.png, .svg, .json\n", figure.name);
  std::fflush(stdout);
}

/// A folder that holds anything but figures by these names is not written to.
void require_folder_of_figures(const fs::path& out) {
  const auto names = known_figures();
  std::error_code error;
  for (fs::directory_iterator entry(out, error), end; !error && entry != end; entry.increment(error))
    if (std::ranges::find(names, entry->path().stem().string()) == names.end())
      throw std::invalid_argument(fmt::format("{}: holds something else than figures ({}); give another folder",
                                              out.string(), printable(entry->path().filename().string())));
}

int run(const FigureArguments& a) {
  if (a.list) return print_list(), 0;
  if (a.name.empty() || a.out.empty())
    throw std::invalid_argument("figure: give a NAME, or all, and --out DIR; or --list");
  const auto names = known_figures();
  if (std::ranges::find(names, a.name) == names.end())
    throw std::invalid_argument(
        fmt::format("there is no figure '{}'; did you mean '{}'?", a.name, nearest(a.name, names)));
  const fs::path study = a.study.empty() ? assets_folder() / "studies" / "nextview" : fs::path(a.study);
  const SummaryTable table(study);
  require_folder_of_figures(a.out);
  std::error_code error;
  fs::create_directories(a.out, error);
  require_writable_folder(a.out);
  const StopOnInterrupt stop;
  for (const StudyFigure& figure : study_figures()) {
    throw_if_stopped(stop.token());
    if (is_wanted(a, figure.name)) write_figure(a, figure, table, study);
  }
  if (is_wanted(a, time_table_name)) write_time_table(study, a.out);
  return 0;
}

}  // namespace

void add_figure_command(CLI::App& program) {
  auto a = std::make_shared<FigureArguments>();
  CLI::App* app = program.add_subcommand("figure", "Draw figures and tables of a study");
  app->add_option("NAME", a->name, "of a figure, or all");
  app->add_option("--study", a->study, "folder of a study; else the one that comes with the program")->type_name("DIR");
  app->add_option("--out", a->out, "folder for them: new, empty, or of figures")->type_name("DIR");
  app->add_option("--dpi", a->dpi, "of the pictures; 96 draws a pixel a pixel")
      ->check(CLI::Range(48.0, 600.0))
      ->capture_default_str();
  app->add_flag("--dark,!--light", a->dark, "on dark paper");
  app->add_flag("--list", a->list, "prints all figures and ends");
  app->footer(
      "Examples:\n  nextview figure all --out figures\n  nextview figure gap_closed --study mine --out figures --dpi "
      "300");
  app->callback([a] { throw CLI::RuntimeError(run(*a)); });
}

}  // namespace nextview
