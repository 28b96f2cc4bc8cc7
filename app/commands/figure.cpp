#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/progress.hpp"
#include "app/commands/report_scans.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/json_text.hpp"
#include "core/file/printable.hpp"
#include "core/file/readable_folder.hpp"
#include "core/progress/stopped.hpp"
#include "core/results/made_folder.hpp"
#include "core/study/study_folder.hpp"
#include "ui/render_target/offscreen_target.hpp"
#include "ui/report/scan_figures.hpp"
#include "ui/report/study_charts.hpp"
#include "ui/report/study_report.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr const char *time_table_name = "table_1", *report_name = "report";
constexpr double design_dpi = 96.0;  // at which a pixel of a drawing is one of its picture
constexpr double mm_an_inch = 25.4, points_a_mm = 72.0 / mm_an_inch;
constexpr double least_points = 7.0;  // of letters, as journals ask for

struct FigureArguments {
  std::string name, study, out, size;
  std::vector<std::string> sessions;
  std::vector<int> views;
  double dpi = 2 * design_dpi, width = 0;  ///< width: of the print [mm]; 0: none
  bool list = false, dark = false;
};

/// What all pictures are drawn in, made when the first one is: what it takes to draw is made once.
class SharedTarget {
 public:
  RenderTarget& get() {
    if (!target_) target_.emplace(smallest_picture, smallest_picture);
    return *target_;
  }

 private:
  std::optional<OffscreenTarget> target_;
};

bool is_wanted(const FigureArguments& a, const std::string& name) { return a.name == "all" || a.name == name; }

void print_list() {
  for (const StudyFigure& figure : study_figures()) fmt::print("{:<22} {}\n", figure.name, figure.caption);
  for (const ScanFigure& figure : scan_figures()) fmt::print("{:<22} {}\n", figure.name, figure.caption);
  fmt::print("{:<22} {}\n", time_table_name, "Table 1: seconds a view and stage, as CSV, Markdown and LaTeX.");
  fmt::print("{:<22} {}\n", report_name,
             "All of a study as one HTML file: its charts, tables of means and comparisons, and what they are of.");
}

Look look_of(const FigureArguments& a) { return a.dark ? Look::dark() : Look::light(); }

/// Pixels of the picture a pixel of the drawing, which has its width in print.
double scale_of(const FigureArguments& a, const VectorDrawing& drawing) {
  return a.width > 0 ? a.width * a.dpi / (mm_an_inch * drawing.width()) : a.dpi / design_dpi;
}

/// No wider than what keeps its smallest letters as large as they must be.
Sheet sheet_of(const FigureArguments& a) {
  if (a.width <= 0) return look_of(a);
  return {look_of(a), theme::small_text * a.width * points_a_mm / least_points};
}

/// Where a figure has its own width letters follow from it.
void warn_of_letters(const FigureArguments& a, const std::string& name, const VectorDrawing& drawing) {
  if (a.width <= 0 || !drawing.smallest_text()) return;
  const double points = *drawing.smallest_text() * points_a_mm * a.width / drawing.width();
  if (points > least_points - 0.05) return;
  fmt::print(stderr,
             "warning: {}: its smallest letters are {:.1f} pt at --width {:g}; from {:.0f} on they are {:g} pt\n", name,
             points, a.width, std::ceil(a.width * least_points / points), least_points);
}

/// A drawing, and beside it what it shows and what it was made from.
void write_drawing(const FigureArguments& a, RenderTarget& target, const std::string& name,
                   const VectorDrawing& drawing, nlohmann::ordered_json about, const std::string& configuration) {
  const fs::path out = a.out;
  const Image image = a.size.empty() ? drawing.image(target, scale_of(a, drawing))
                                     : drawing.image(target, picture_size(a.size, "--size"));
  write_png(image, out / (name + ".png"), configuration, a.dpi);
  if (drawing.is_vector())
    write_file(out / (name + ".svg"), drawing.svg(a.width > 0 ? std::optional(a.width) : std::nullopt));
  warn_of_letters(a, name, drawing);
  about["configuration"] = configuration;
  write_file(out / (name + ".json"), json_text(about, 2) + "\n");
  fmt::print("{}.png,{} .json\n", name, drawing.is_vector() ? " .svg," : "");
  flush_output();
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
void write_figure(const FigureArguments& a, SharedTarget& target, const StudyFigure& figure, const SummaryTable& table,
                  const fs::path& study) {
  const auto drawing = figure.draw(table, sheet_of(a));
  if (!drawing && a.name != "all")
    throw std::invalid_argument(fmt::format("{}: the study has nothing that {} shows, which needs {}", study.string(),
                                            figure.name, figure.needs));
  if (!drawing) return;
  write_drawing(a, target.get(), figure.name, *drawing,
                {{"figure", figure.name},
                 {"caption", figure.caption},
                 {"study", study.filename().string()},
                 {"summary_crc32", file_hash(study / "summary.csv").crc32}},
                read_file(study / study_file_name));
}

void write_study_figures(const FigureArguments& a, SharedTarget& target, const SummaryTable& table,
                         const fs::path& study, const std::stop_token& stop) {
  for (const StudyFigure& figure : study_figures()) {
    throw_if_stopped(stop);
    if (is_wanted(a, figure.name)) write_figure(a, target, figure, table, study);
  }
  if (is_wanted(a, time_table_name)) write_time_table(study, a.out);
  if (!is_wanted(a, report_name)) return;
  write_file(fs::path(a.out) / "report.html", study_report(study, table));
  fmt::print("report.html\n");
}

/// Scenes are drawn for a scale, which follows from the drawing's size, if a picture's is given.
VectorDrawing drawn(const FigureArguments& a, RenderTarget& target, const ScanFigure& figure,
                    std::span<ReportScan> scans) {
  FigurePaper paper{target, look_of(a), a.dpi / design_dpi, a.views};
  if (a.views.empty()) paper.views = {1, 2, 3, 4, 5, 6, 7, 8};
  if (a.size.empty() && a.width <= 0) return figure.draw(scans, paper);
  paper.scale = 0.0;
  const VectorDrawing first = figure.draw(scans, paper);
  paper.scale = a.size.empty() ? scale_of(a, first) : first.scale_within(picture_size(a.size, "--size"));
  return figure.draw(scans, paper);
}

/// Those that are asked for by number; of the default ones, what is not there is left out.
void require_views(const std::vector<int>& views, const ReportScan& scan) {
  for (const int view : views)
    if (std::size_t(view) > scan.states.size())
      throw std::invalid_argument(
          fmt::format("--views {}: {} has {}", view, scan.name, counted(scan.states.size(), "view")));
}

void write_scan_figures(const FigureArguments& a, SharedTarget& target, const std::stop_token& stop) {
  if (std::ranges::none_of(scan_figures(), [&](const ScanFigure& figure) { return is_wanted(a, figure.name); })) return;
  const ProgressLine progress;
  auto scans = a.sessions.empty() ? made_scans(progress, stop) : report_scans(a.sessions, progress, stop);
  if (is_wanted(a, "strategy")) require_views(a.views, scans.front());
  std::vector<std::string> names;
  for (const ReportScan& scan : scans) names.push_back(scan.name);
  for (const ScanFigure& figure : scan_figures()) {
    throw_if_stopped(stop);
    if (is_wanted(a, figure.name))
      write_drawing(a, target.get(), figure.name, drawn(a, target.get(), figure, scans),
                    {{"figure", figure.name}, {"caption", figure.caption}, {"scans", names}},
                    to_toml(scans.front().session->configuration(), a.out));
  }
}

/// A folder that holds anything but figures by these names is not written to.
void require_folder_of_figures(const fs::path& out) {
  const auto names = figure_names();
  std::error_code error;
  for (fs::directory_iterator entry(out, error), end; !error && entry != end; entry.increment(error))
    if (std::ranges::find(names, entry->path().stem().string()) == names.end())
      throw std::invalid_argument(fmt::format("{}: holds something else than figures ({}); give another folder",
                                              out.string(), printable(entry->path().filename().string())));
}

/// Of sessions alone come scenes alone, unless a study's figure or a study is asked for.
bool draws_study(const FigureArguments& a) {
  const auto wanted = [&](const auto& figure) { return is_wanted(a, figure.name); };
  const bool is_of_study =
      std::ranges::any_of(study_figures(), wanted) || is_wanted(a, time_table_name) || is_wanted(a, report_name);
  return is_of_study && (a.sessions.empty() || !a.study.empty() || a.name != "all");
}

/// @throws std::invalid_argument
void check(const FigureArguments& a) {
  if (a.name.empty()) throw std::invalid_argument("figure: give a NAME, or all, and --out DIR; or --list");
  const auto names = figure_names();
  if (std::ranges::find(names, a.name) == names.end())
    throw std::invalid_argument(
        fmt::format("there is no figure '{}'{}", a.name, did_you_mean(a.name, names, "; see nextview figure --list")));
  if (a.out.empty()) throw std::invalid_argument(fmt::format("figure {}: give its folder, --out DIR", a.name));
  const auto is_scene = [&](const ScanFigure& figure) { return is_wanted(a, figure.name); };
  if (!a.sessions.empty() && std::ranges::none_of(scan_figures(), is_scene))
    throw std::invalid_argument(
        fmt::format("figure {}: is one of a study (--study DIR), not of '{}'", a.name, a.sessions.front()));
  for (const std::string& session : a.sessions)
    if (study_contents(session))
      throw std::invalid_argument(fmt::format("{0}: is the folder of a study, which is given as --study {0}", session));
  if (!a.size.empty()) picture_size(a.size, "--size");
}

int run(const FigureArguments& a) {
  if (a.list) return print_list(), 0;
  check(a);
  const fs::path study = a.study.empty() ? assets_folder() / "studies" / "nextview" : fs::path(a.study);
  std::optional<SummaryTable> table;
  if (draws_study(a)) {
    require_readable(study);
    if (!is_there(study / "summary.csv"))
      throw std::invalid_argument(fmt::format(
          "{}: is no folder of a finished study, which has a summary.csv; give --study what `nextview study` wrote",
          study.string()));
    table.emplace(study);
  }
  require_folder_of_figures(a.out);
  const MadeFolder folder(a.out);
  const StopOnInterrupt stop;
  SharedTarget target;
  if (table) write_study_figures(a, target, *table, study, stop.token());
  write_scan_figures(a, target, stop.token());
  return 0;
}

}  // namespace

std::vector<std::string> figure_names() {
  std::vector<std::string> names = {"all"};
  for (const StudyFigure& figure : study_figures()) names.push_back(figure.name);
  for (const ScanFigure& figure : scan_figures()) names.push_back(figure.name);
  names.emplace_back(time_table_name);
  names.emplace_back(report_name);
  return names;
}

void add_figure_command(CLI::App& program) {
  auto a = std::make_shared<FigureArguments>();
  CLI::App* app = program.add_subcommand("figure", "Draw figures and tables of a study, and of scans");
  app->add_option("NAME", a->name, "of a figure, or all");
  app->add_option("SESSION", a->sessions, "folders of sessions that scenes are drawn of; else scans made for it")
      ->transform(kept_session())
      ->type_name("DIR");
  app->add_option("--study", a->study, "folder of a study; else the one that comes with the program")->type_name("DIR");
  app->add_option("--out", a->out, "folder for them: new, empty, or of figures")->type_name("DIR");
  app->add_option("--dpi", a->dpi, "of the pictures; 96 draws a pixel a pixel")
      ->check(within(48.0, 600.0))
      ->capture_default_str();
  CLI::Option* size =
      app->add_option("--size", a->size, "of the pictures in pixels, whatever the dpi")->type_name("WxH");
  app->add_option("--width", a->width,
                  "of the figures in print, for a column of 85 mm for instance: charts are laid out anew so that their "
                  "letters are 7 pt there, and what cannot be is told")
      ->check(within(40.0, 1000.0))
      ->type_name("MM")
      ->excludes(size);
  app->add_option("--views", a->views, "that `strategy` has as columns, from 1 (default 1 to 8)")
      ->delimiter(',')
      ->check(within(1, 1000000))
      ->type_name("LIST");
  app->add_flag("--dark", a->dark, "on dark paper");
  app->add_flag("--list", a->list, "prints all figures and ends");
  app->footer(
      "Examples:\n  nextview figure all --out figures\n  nextview figure gap_closed --study mine --out figures --dpi "
      "300\n  nextview figure coverage_by_view --width 85 --out figures\n  nextview figure strategy my-scan --views "
      "1,2,4,8 --out figures");
  app->callback([a] { throw CLI::RuntimeError(run(*a)); });
}

}  // namespace nextview
