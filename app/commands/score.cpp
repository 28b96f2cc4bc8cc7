#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/commands/commands.hpp"
#include "app/commands/progress.hpp"
#include "core/config/configuration.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/offline/scene_scores.hpp"
#include "core/planner/policy.hpp"

namespace nextview {
namespace {

struct ScoreArguments {
  std::string scene, csv, gain = "all", semantics = "published";
};

/// The reference code knows no Gibbs map.
std::vector<std::string> wanted_gains(const std::string& gain, Semantics semantics) {
  std::vector<std::string> known;
  for (const PolicyEntry& policy : policies()) {
    const bool on_posterior = policy.make({})->needs().posterior;
    if (!policy.baseline && !(on_posterior && semantics == Semantics::reference)) known.push_back(policy.name);
  }
  if (gain == "all") return known;
  if (std::find(known.begin(), known.end(), gain) == known.end())
    throw std::invalid_argument(
        fmt::format("there is no gain '{}' to score a scene by; did you mean '{}'?", gain, nearest(gain, known)));
  return {gain};
}

std::string to_csv(const SceneScores& scores) {
  std::string csv = fmt::format("view,{},rays,milliseconds\n", fmt::join(scores.gains, ","));
  for (std::size_t v = 0; v < scores.views.size(); ++v) {
    const ViewScore& score = scores.views[v];
    csv += fmt::format("{},{},{},{:.3f}\n", v, fmt::join(score.gains, ","), score.rays, score.milliseconds);
  }
  return csv;
}

/// For people: the best views of each gain.
void print_ranking(const SceneScores& scores) {
  constexpr std::size_t shown = 5;
  fmt::print("{}; the best by each gain:\n\n", counted(scores.views.size(), "candidate view"));
  for (std::size_t g = 0; g < scores.gains.size(); ++g) {
    std::vector<Candidate> candidates(scores.views.size());
    for (std::size_t v = 0; v < candidates.size(); ++v) candidates[v].gain = scores.views[v].gains[g];
    const Ranking ranking = rank(candidates, {1.0, 0.0});
    std::vector<std::size_t> order(candidates.size());
    for (std::size_t v = 0; v < order.size(); ++v) order[v] = v;
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return candidates[a].gain > candidates[b].gain; });
    fmt::print("{:<18}", scores.gains[g]);
    for (std::size_t i = 0; i < std::min(shown, order.size()); ++i)
      fmt::print("  {:>3}: {:<10.6g}", order[i], candidates[order[i]].gain);
    fmt::print("{}\n", ranking.degenerate.empty() ? "" : "  (no ranking: " + ranking.degenerate + ")");
  }
}

int run(const ScoreArguments& arguments) {
  if (arguments.semantics != "published" && arguments.semantics != "reference")
    throw std::invalid_argument(fmt::format("--semantics takes published or reference, not '{}'", arguments.semantics));
  const Semantics semantics = arguments.semantics == "reference" ? Semantics::reference : Semantics::published;
  const auto gains = wanted_gains(arguments.gain, semantics);
  std::error_code no_such_file;
  if (!arguments.csv.empty() && std::filesystem::equivalent(arguments.scene, arguments.csv, no_such_file))
    throw std::invalid_argument(fmt::format("--csv {}: is the scene that is scored; give another file", arguments.csv));
  const RecordedScene scene = read_recorded_scene(arguments.scene);
  const auto warn = [&](const std::string& text) {
    fmt::print(stderr, "{}\n", printable(fmt::format("{}: {}", arguments.scene, text)));
  };
  const StopOnInterrupt stop;
  const ProgressLine progress;
  SceneScores scores;
  try {
    scores = score_scene(scene, semantics, gains, warn, progress, stop.token());
    progress.clear();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", arguments.scene, error.what()));
  }
  if (arguments.csv.empty())
    print_ranking(scores);
  else if (arguments.csv == "-")
    fmt::print("{}", to_csv(scores));
  else
    write_file(arguments.csv, to_csv(scores));
  return 0;
}

}  // namespace

void add_score_command(CLI::App& program) {
  auto arguments = std::make_shared<ScoreArguments>();
  CLI::App* app = program.add_subcommand("score", "Rank the candidate views of a scene of recorded scans");
  app->add_option("--scene", arguments->scene, "scene file: lines `param`, `scan` with its points, `view`")
      ->required()
      ->type_name("FILE");
  app->add_option("--semantics", arguments->semantics, "published, or what the reference code computes")
      ->capture_default_str();
  app->add_option("--gain", arguments->gain,
                  "a gain, 'combined', or 'all'; gibbs refines the map first, which takes seconds")
      ->capture_default_str();
  app->add_option("--csv", arguments->csv,
                  "write a row per view with raw values; - for standard output; else a summary is printed")
      ->type_name("FILE");
  app->footer("Example:\n  nextview score --scene scans1.txt --semantics reference --gain all --csv scores.csv");
  app->callback([arguments] { throw CLI::RuntimeError(run(*arguments)); });
}

}  // namespace nextview
