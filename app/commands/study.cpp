#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <memory>

#include "app/commands/commands.hpp"
#include "app/commands/progress.hpp"
#include "app/commands/shell_text.hpp"
#include "core/config/asset_names.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/progress/stopped.hpp"
#include "core/setting/mistyped_path.hpp"
#include "core/study/study_loop.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

struct StudyArguments {
  std::string file, out, shard, runs;
  std::vector<std::string> merge;
  bool resume = false, keep_scans = false;
};

/// Two whole numbers from 1 with a sign between them. @throws std::invalid_argument naming the option
std::pair<std::size_t, std::size_t> two_numbers(const std::string& text, char sign, const std::string& option) {
  std::pair<std::size_t, std::size_t> numbers;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, numbers.first);
  const bool has_sign = first.ec == std::errc() && first.ptr != end && *first.ptr == sign;
  const auto second = has_sign ? std::from_chars(first.ptr + 1, end, numbers.second) : first;
  if (!has_sign || second.ec != std::errc() || second.ptr != end || numbers.first < 1 || numbers.second < 1)
    throw std::invalid_argument(fmt::format("{} takes two whole numbers from 1 as I{}N, not '{}'", option, sign, text));
  return numbers;
}

/// One number is a range of one.
std::pair<std::size_t, std::size_t> range_of(const std::string& text) {
  const bool is_one = text.find('-') == text.npos;
  return two_numbers(is_one ? text + "-" + text : text, '-', "--runs");
}

StudyShare share_of(const StudyArguments& a, std::size_t runs) {
  StudyShare share{{1, runs}};
  if (!a.shard.empty()) std::tie(share.shard, share.shards) = two_numbers(a.shard, '/', "--shard");
  if (share.shard > share.shards)
    throw std::invalid_argument(fmt::format("--shard {}: there are {}", a.shard, counted(share.shards, "shard")));
  if (!a.runs.empty()) std::tie(share.range.first, share.range.last) = range_of(a.runs);
  if (share.range.first > share.range.last || share.range.last > runs)
    throw std::invalid_argument(fmt::format("--runs {}: the study has runs 1 to {}", a.runs, runs));
  return share;
}

void print_run(std::size_t number, const StudyRun& run, const RunResult& result, const RunSeconds& seconds) {
  const MeasuredValue* value = result.find(main_measure(run.part), 0.0);
  const std::string what = !result.failure.empty() ? "failed: " + result.failure
                           : value                 ? fmt::format("{} {:.4g}", main_measure(run.part), value->value)
                                                   : "done";
  fmt::print("{:>6}  {}: {} ({:.1f} s)\n", number, printable(run.text()), printable(what), seconds.total);
  flush_output();
}

/// Returns the exit code.
int print_summary(const StudySummary& summary, const fs::path& out) {
  if (summary.failed > 0)
    fmt::print(stderr, "warning: {} of {} came to nothing; summary.csv says why\n", summary.failed,
               counted(summary.runs, "run"));
  fmt::print(
      "{}/\n  summary.csv, .json   means, spreads and comparisons: {}\n  runs.csv             each of {}\n"
      "  timings.csv          seconds, which differ from one time to the next\n"
      "All of it as one HTML file: nextview figure report --study {} --out report\n",
      printable(out.string()), counted(summary.rows, "row"), counted(summary.runs, "run"), shell_text(out));
  return summary.failed > 0 ? exit_bad_input : 0;
}

/// Likewise: what failed is told now, for the summary comes with the merge.
int print_shard(const StudyKeys& keys, const StudyFolder& folder, const StudyShare& share) {
  std::vector<std::size_t> failed;
  for (std::size_t number = 1; number <= keys.keys.size(); ++number)
    if (share.takes(number) && !folder.result(keys.keys[number - 1]).failure.empty()) failed.push_back(number);
  if (!failed.empty())
    fmt::print(stderr, "warning: of the runs of this shard {} came to nothing: {}\n", failed.size(),
               fmt::join(failed, ", "));
  fmt::print("Shard {} of {} is done. When all are: nextview study --merge DIR… --out DIR\n", share.shard,
             share.shards);
  return failed.empty() ? 0 : exit_bad_input;
}

/// A file, or one of those that come with the program by its name: "smoke", "assets/studies/smoke.toml".
fs::path study_file(const std::string& wanted) {
  if (is_there(wanted)) return wanted;
  const fs::path own = assets_folder() / "studies" / fs::path(wanted).filename().replace_extension(".toml");
  if (is_there(own)) return own;
  const std::vector<std::string> known = asset_names("studies");
  throw std::runtime_error(
      fmt::format("{}: there is no such file{}", wanted,
                  did_you_mean_path(wanted, known,
                                    fmt::format("; studies that come with the program are {}", fmt::join(known, ", ")),
                                    [](const fs::path& file) { return file.extension() == ".toml"; })));
}

int run_file(const StudyArguments& a) {
  const Study study = read_study(study_file(a.file));
  const StudyShare share = share_of(a, study.size());
  const StudyKeys keys = keys_of(study);
  const StudyFolder folder = StudyFolder::begin(a.out, study, keys, a.resume);
  const StopOnInterrupt stop;
  const ProgressLine progress;
  const auto done = [&](std::size_t number, const StudyRun& run, const RunResult& result, const RunSeconds& seconds) {
    progress.clear();
    print_run(number, run, result, seconds);
  };
  try {
    run_study(study, keys, folder, share, a.keep_scans, done, progress, stop.token());
  } catch (const Stopped&) {
    progress.clear();
    fmt::print(stderr, "What is done stays in {}; the same command with --resume goes on.\n", printable(a.out));
    throw;
  }
  progress.clear();
  if (share.shards > 1) return print_shard(keys, folder, share);
  return print_summary(summarise(study, keys.keys, {&folder, 1}, share.range, folder.path()), folder.path());
}

/// The study of all these folders. @throws std::invalid_argument naming one that holds another
StudyKeys common_keys(const std::vector<StudyFolder>& folders) {
  const auto keys_text = [](const StudyFolder& folder) { return read_file(folder.path() / study_keys_name); };
  const std::string text = keys_text(folders.front());
  for (const StudyFolder& folder : folders)
    if (keys_text(folder) != text)
      throw std::invalid_argument(
          fmt::format("{}: holds another study than {}, or was made by another version or of other objects",
                      folder.path().string(), folders.front().path().string()));
  StudyKeys keys;
  for (std::size_t at = 0; at < text.size(); at += 17) keys.keys.push_back(text.substr(at, 16));
  return keys;
}

void merge_timings(const std::vector<StudyFolder>& folders, const fs::path& out) {
  AtomicFile merged(out / study_timings_name);
  merged.stream() << timing_columns;
  for (const StudyFolder& folder : folders) {
    const fs::path file = folder.path() / study_timings_name;
    if (!is_there(file)) continue;
    const std::string text = read_file(file);
    if (const std::size_t end = text.find('\n'); end != text.npos) merged.stream() << text.substr(end + 1);
  }
  merged.commit();
}

int merge(const StudyArguments& a) {
  std::vector<StudyFolder> folders;
  for (const std::string& folder : a.merge) folders.push_back(StudyFolder::open(folder));
  const StudyKeys keys = common_keys(folders);
  const fs::path first = folders.front().path();
  const Study study = read_study(first / study_file_name);
  if (study.size() != keys.keys.size())
    throw std::invalid_argument(fmt::format("{}: its keys are not those of its study", first.string()));
  const StudyShare share = share_of(a, study.size());
  require_results(keys.keys, folders, share.range);  // before there is a folder
  const StudyFolder out = StudyFolder::begin_merged(a.out, folders.front());
  const StudySummary summary = summarise(study, keys.keys, folders, share.range, out.path());
  merge_timings(folders, out.path());
  return print_summary(summary, out.path());
}

int run(const StudyArguments& a) {
  if (a.merge.empty() == a.file.empty())
    throw std::invalid_argument(
        "study: give either a study's FILE or --merge and its folders, and --out DIR; see nextview study --help");
  if (a.out.empty()) throw std::invalid_argument("study: give the folder for its results, --out DIR");
  return a.merge.empty() ? run_file(a) : merge(a);
}

}  // namespace

void add_study_command(CLI::App& program) {
  auto a = std::make_shared<StudyArguments>();
  CLI::App* app =
      program.add_subcommand("study", "Compare policies and maps over objects, start views, seeds, sensors");
  app->add_option("FILE", a->file, "what is compared (TOML); smoke comes with the program");
  app->add_option("--out", a->out, "folder for it: new, or empty")->type_name("DIR");
  CLI::Option* shard =
      app->add_option("--shard", a->shard, "does each N-th run, beginning with the I-th, in a folder of its own")
          ->type_name("I/N");
  CLI::Option* resume = app->add_flag("--resume", a->resume, "goes on with the study in the folder, if there is one");
  CLI::Option* keep = app->add_flag("--keep-scans", a->keep_scans, "keeps each plan's session, in sessions/KEY");
  app->add_option("--runs", a->runs, "these runs alone, counted from 1: what a row of summary.csv is of")
      ->type_name("FIRST-LAST")
      ->excludes(shard);
  app->add_option("--merge", a->merge, "writes the summary of what shards have done")
      ->type_name("DIR…")
      ->excludes(shard)
      ->excludes(resume)
      ->excludes(keep);
  app->footer(
      "Examples:\n  nextview study assets/studies/smoke.toml --out smoke\n  nextview study mine.toml --out mine "
      "--resume\n"
      "  nextview study mine.toml --shard 3/8 --out mine-3 --resume\n  nextview study --merge mine-1 mine-2 mine-3 "
      "--out "
      "mine\n  nextview study mine.toml --runs 13-18 --out again");
  app->callback([a] { throw CLI::RuntimeError(run(*a)); });
}

}  // namespace nextview
