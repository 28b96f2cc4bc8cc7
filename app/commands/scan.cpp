#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <set>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/progress.hpp"
#include "app/commands/resumed_scan.hpp"
#include "app/commands/scan_text.hpp"
#include "app/commands/scanner.hpp"
#include "app/commands/shell_text.hpp"
#include "app/commands/surface_output.hpp"
#include "core/config/input_files.hpp"
#include "core/export/scan_files.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/session_folder.hpp"
#include "core/session/setup_warnings.hpp"
#include "ui/figures/session_figure.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

constexpr int most_failures = 3;  // one after the other

struct ScanArguments {
  ConfigurationOptions options;
  std::string out, resume;
  bool overwrite = false, no_pictures = false, no_surfaces = false;
  ScannerOptions scanner;
};

/// A picture of each step.
class StepPictures {
 public:
  StepPictures(bool wanted, bool only_missing) : only_missing_(only_missing) {
    if (wanted) figure_.emplace(target_.emplace(1600, 1000));
  }
  void write(const Session& session, OutputFolder& out) {
    if (!figure_) return;
    const std::string name = fmt::format("step_{:02}.png", session.records().size());
    if (!only_missing_ || !is_there(out.path() / name)) figure_->write(session, out.claim(name));
  }

  /// After the last step: what was drawn in, for other pictures; none if none are wanted.
  RenderTarget* leave_target() {
    figure_.reset();
    return target_ ? &*target_ : nullptr;
  }

 private:
  std::optional<OffscreenTarget> target_;  ///< one for all: what it takes to draw in it is made once
  std::optional<SessionFigure> figure_;
  bool only_missing_;
};

/// Makes the best candidate the next view that the scanner has not failed to take; false if there is none.
bool avoid(const std::set<std::size_t>& failed, Session& session) {
  if (!session.next_candidate() || !failed.contains(*session.next_candidate())) return true;
  const std::vector<Candidate>& candidates = session.records().back().candidates;
  std::optional<std::size_t> best;
  for (std::size_t v = 0; v < candidates.size(); ++v)
    if (candidates[v].available && !failed.contains(v) && (!best || is_better(candidates[v], candidates[*best])))
      best = v;
  if (best) session.override_next_view(*best);
  return best.has_value();
}

/// Takes the views, one after the other, with a picture of each. A live scanner that is lost is reached again; where it
/// cannot take a view, or one is rejected, another one is taken.
void take_views(Session& session, Scanner* scanner, SessionFolder& folder, StepPictures& pictures,
                const ProgressLine& progress, const std::stop_token& stop) {
  int failures = 0;  // one after the other
  std::set<std::size_t> failed;
  while (session.finished().empty()) {
    try {
      if (!folder.step(session, progress, stop)) break;
    } catch (const std::runtime_error& error) {
      progress.clear();
      const bool is_rejected = dynamic_cast<const ScanRejected*>(&error);
      if ((!scanner && !is_rejected) || ++failures > most_failures) throw;
      fmt::print(stderr, "{}\n", printable(error.what()));
      if (scanner && scanner->is_lost())
        scanner->reconnect(stop);
      else if (session.next_candidate())
        failed.insert(*session.next_candidate());
      if (!avoid(failed, session)) throw;
      continue;
    }
    failures = 0;
    progress.clear();
    print_step(session, session.records().back());
    pictures.write(session, folder.out());
    if (!avoid(failed, session) && session.finished().empty())
      throw std::runtime_error("none of the views that are left could be taken");
  }
}

void write_results(const Session& session, const ScanArguments& arguments, OutputFolder& out,
                   const std::string& failure, StepPictures& pictures, const ProgressLine& progress,
                   const std::stop_token& stop) {
  progress(1.0, "writing the files");
  write_scan(session, out);
  std::string surface_files;
  if (!arguments.no_surfaces && !session.records().empty()) {
    const auto surfaces = scan_surfaces(session, progress, stop);
    progress.clear();
    surface_files =
        write_and_print_surfaces(surfaces, session.name(), session.records().size(), out, pictures.leave_target());
    if (surfaces.empty())
      surface_files = fmt::format(
          "  (no surfaces: stopped before they were made; nextview export {} surface surface.ply makes one)\n",
          shell_text(out.path()));
  }
  print_end(session, failure);
  print_files(session, out.path(), !arguments.no_pictures, surface_files);
}

void print_warnings(const Session& session) {
  if (session.recording() || !session.mesh()) return;
  for (const std::string& warning : setup_warnings(session.configuration(), *session.mesh(), session.candidates()))
    fmt::print(stderr, "warning: {}\n", warning);
}

/// Takes what views are left, and writes all that is made of them.
int finish(Session& session, const ScanArguments& arguments, Scanner* scanner, SessionFolder& folder,
           StepPictures& pictures, const ProgressLine& progress, const std::stop_token& stop) {
  std::string failure;
  try {
    take_views(session, scanner, folder, pictures, progress, stop);
  } catch (const std::runtime_error& error) {
    if (session.records().empty()) throw;
    failure = error.what();  // what was taken is written all the same
  }
  try {
    write_results(session, arguments, folder.out(), failure, pictures, progress, stop);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error& error) {  // a full disk, for example
    throw std::runtime_error(fmt::format("{}; what was captured is kept: nextview scan --resume {} writes the rest",
                                         error.what(), shell_text(folder.out().path())));
  }
  if (!failure.empty()) throw std::runtime_error(failure);
  folder.keep_state(session);
  folder.close();
  return session.finished().empty() || stop.stop_requested() ? exit_stopped : 0;
}

void require_free(const std::filesystem::path& folder, bool overwrite, std::span<const InputFile> inputs) {
  const InTheWay found = in_the_way(folder, inputs);
  if (found == InTheWay::nothing || (found == InTheWay::session && overwrite)) return;
  const char* const why = found == InTheWay::session
                              ? "holds a session: --resume goes on with it, --overwrite replaces it; or"
                              : "is not empty, and holds no session;";
  throw std::invalid_argument(fmt::format("{}: {} give another folder, for example --out {}", folder.string(), why,
                                          free_folder(folder).string()));
}

int begin(const ScanArguments& arguments) {
  const std::filesystem::path wanted =
      arguments.out.empty() ? free_folder("out") : std::filesystem::path(arguments.out);
  Configuration configuration = arguments.options.configuration();
  const std::vector<InputFile> inputs = input_files(configuration);
  OutputFolder out(wanted, inputs);
  require_free(wanted, arguments.overwrite, inputs);
  const MadeFolder made = out.make();  // a folder that cannot be written to is told before the object is prepared
  const StopOnInterrupt stop;
  const ProgressLine progress;
  std::optional<Scanner> scanner;
  if (arguments.scanner.wanted()) scanner.emplace(arguments.scanner, configuration, stop.token());
  SessionParts parts = scanner ? scanner->parts(configuration) : SessionParts{};
  Session session(configuration, std::move(parts), progress, stop.token());
  progress.clear();
  if (!session.finished().empty()) throw std::invalid_argument(session.name() + ": " + session.finished());
  print_head(session);
  print_warnings(session);
  SessionFolder folder = SessionFolder::begin(std::move(out), session);
  StepPictures pictures(!arguments.no_pictures, false);
  return finish(session, arguments, scanner ? &*scanner : nullptr, folder, pictures, progress, stop.token());
}

/// Goes on with a session, by whatever it was ended.
int resume(const ScanArguments& arguments) {
  SavedSession saved = read_session(arguments.resume);
  const bool has_changed = adopt_changes(arguments.options, saved);
  const StopOnInterrupt stop;
  const ProgressLine progress;
  Configuration& c = saved.configuration;
  std::optional<Scanner> scanner;
  if (arguments.scanner.wanted()) scanner.emplace(arguments.scanner, c, stop.token());
  SessionParts parts = scanner ? scanner->parts(c) : c.driver.name.empty() ? SessionParts{} : absent_scanner_parts(c);
  Session session(began_with(saved), std::move(parts), progress, stop.token());
  progress.clear();
  SessionFolder folder = SessionFolder::go_on(OutputFolder(saved.folder, {}), saved, session);
  // That looks at every capture; only where it does not do is it to be found out which one is lost.
  const bool has_all_files =
      has_files(saved.folder, !arguments.no_pictures, !arguments.no_surfaces) && restore_kept(session, saved, &folder);
  if (!has_changed && !has_all_files) require_captures_of_results(saved);
  print_head(session);
  StepPictures pictures(!arguments.no_pictures, true);
  const auto each = [&](std::uint32_t) {
    progress.clear();
    print_step(session, session.records().back());
    pictures.write(session, folder.out());
  };
  if (has_all_files)
    for (const StepRecord& record : session.records()) print_step(session, record);
  const bool is_restored = has_all_files || restore(session, saved, &folder, each, progress, stop.token());
  progress.clear();
  for (const std::string& notice : saved.notices)
    fmt::print(stderr, "notice: {}\n", printable(fmt::format("{}: {}", saved.folder.string(), notice)));
  if (!is_restored) return exit_stopped;
  if (has_changed) require_no_earlier_end(session, saved);
  const bool has_finished = !session.finished().empty();
  if (has_finished)
    fmt::print(
        "\nIt was finished already: no view is taken, its files are {}. To go on, let it end later, by "
        "--views,\n--termination.surface_left, or another of termination.*\n",
        has_all_files ? "there" : "made again");
  if (has_finished && has_all_files) return 0;
  folder.keep_configuration(session);
  return finish(session, arguments, scanner ? &*scanner : nullptr, folder, pictures, progress, stop.token());
}

int run(const ScanArguments& arguments) { return arguments.resume.empty() ? begin(arguments) : resume(arguments); }

}  // namespace

void add_scan_command(CLI::App& program) {
  auto arguments = std::make_shared<ScanArguments>();
  CLI::App* app =
      program.add_subcommand("scan", "Scan an object without a display: pictures, map, cloud, surfaces and numbers");
  arguments->options.add_to(*app);
  arguments->scanner.add_to(*app);
  CLI::Option* out = app->add_option("--out", arguments->out,
                                     "folder for the session: new, empty, or with --overwrite that of another one; "
                                     "the next that is free of out, out-2, … if it is not given")
                         ->type_name("DIR")
                         ->check(not_empty());
  app->add_flag("--overwrite", arguments->overwrite, "replaces the session that is in the folder");
  app->add_option("--resume", arguments->resume,
                  "goes on with the session in this folder, whatever ended it; termination.* and the limits of "
                  "registration may be changed")
      ->type_name("DIR")
      ->transform(kept_session())
      ->excludes(out)
      ->excludes(app->get_option("OBJECT"));
  app->add_flag("--no-pictures", arguments->no_pictures, "write no pictures: faster");
  app->add_flag("--no-surfaces", arguments->no_surfaces, "make no surfaces: faster");
  app->footer(
      "Examples:\n  nextview scan --out out\n  nextview scan bunny.ply --gain rear-side-entropy --views 10 --seed 7 "
      "--out bunny\n"
      "  nextview scan --recorded frames --out recorded\n"
      "  nextview scan --driver \"python3 turntable.py scans\" --map.region \"-0.1 -0.1 0 0.1 0.1 0.2\" --out part\n"
      "  nextview scan --resume out --termination.surface_left 0 --views 30\n"
      "  nextview scan --config out/config.toml --sensor.range_noise 0.005 --out noisy");
  app->callback([arguments] { throw CLI::RuntimeError(run(*arguments)); });
}

}  // namespace nextview
