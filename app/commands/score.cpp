#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/commands/commands.hpp"
#include "app/commands/opened_session.hpp"
#include "app/commands/progress.hpp"
#include "core/config/configuration.hpp"
#include "core/export/single_export.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/offline/session_scores.hpp"
#include "core/planner/policy.hpp"
#include "core/session/saved_session.hpp"

namespace nextview {
namespace {

struct ScoreArguments {
  std::string session, scene, csv, gain = "all", semantics = "published";
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
        fmt::format("there is no gain '{}' to score views by{}", gain,
                    did_you_mean(gain, known, fmt::format("; it is all, or one of {}", fmt::join(known, ", ")))));
  return {gain};
}

std::string to_csv(const SceneScores& scores) {
  std::string csv = fmt::format("view,{},rays,milliseconds\n", fmt::join(scores.gains, ","));
  for (std::size_t v = 0; v < scores.views.size(); ++v) {
    const ViewScore& score = scores.views[v];
    std::string gains;
    for (const double gain : score.gains) gains += std::isfinite(gain) ? fmt::format("{},", gain) : ",";
    csv += fmt::format("{},{}{},{:.3f}\n", v, gains, score.rays, score.milliseconds);
  }
  return csv;
}

/// The views that have a value, the best first.
std::vector<std::size_t> best_first(const std::vector<double>& values) {
  std::vector<std::size_t> order;
  for (std::size_t v = 0; v < values.size(); ++v)
    if (std::isfinite(values[v])) order.push_back(v);
  std::ranges::stable_sort(order, [&](auto a, auto b) { return values[a] > values[b]; });
  return order;
}

/// For people: the best views of each gain.
void print_ranking(const SceneScores& scores) {
  constexpr std::size_t shown = 5;
  const auto has_value = [](const ViewScore& view) {
    return std::ranges::any_of(view.gains, [](double gain) { return std::isfinite(gain); });
  };
  if (std::ranges::none_of(scores.views, has_value)) {
    fmt::print("{}; none is left to rank: they were taken, or cannot be reached\n",
               counted(scores.views.size(), "candidate view"));
    return;
  }
  fmt::print("{}; the best by each gain:\n\n", counted(scores.views.size(), "candidate view"));
  for (std::size_t g = 0; g < scores.gains.size(); ++g) {
    std::vector<double> values;
    for (const ViewScore& view : scores.views) values.push_back(view.gains[g]);
    std::vector<Candidate> candidates(values.size());
    for (std::size_t v = 0; v < values.size(); ++v) {
      candidates[v].available = std::isfinite(values[v]);
      candidates[v].gain = candidates[v].available ? values[v] : 0.0;
    }
    const Ranking ranking = rank(candidates, {{1.0, 0.0}});
    const std::vector<std::size_t> order = best_first(values);
    const std::string unit = policy_entry(scores.gains[g]).make({})->unit();
    fmt::print("{:<28}", unit.empty() ? scores.gains[g] : fmt::format("{} [{}]", scores.gains[g], unit));
    for (std::size_t i = 0; i < std::min(shown, order.size()); ++i)
      fmt::print("  {:>3}: {:<10.6g}", order[i], values[order[i]]);
    fmt::print("{}\n", ranking.degenerate.empty() ? "" : "  (no ranking: " + ranking.degenerate + ")");
  }
}

Semantics semantics_of(const ScoreArguments& arguments) {
  if (arguments.semantics != "published" && arguments.semantics != "reference")
    throw std::invalid_argument(fmt::format("--semantics takes published or reference, not '{}'", arguments.semantics));
  return arguments.semantics == "reference" ? Semantics::reference : Semantics::published;
}

SceneScores scores_of_scene(const ScoreArguments& arguments, const ProgressLine& progress,
                            const std::stop_token& stop) {
  const Semantics semantics = semantics_of(arguments);
  const auto gains = wanted_gains(arguments.gain, semantics);
  std::error_code no_such_file;
  if (!arguments.csv.empty() && std::filesystem::equivalent(arguments.scene, arguments.csv, no_such_file))
    throw std::invalid_argument(fmt::format("--csv {}: is the scene that is scored; give another file", arguments.csv));
  const RecordedScene scene = read_recorded_scene(arguments.scene);
  const auto warn = [&](const std::string& text) {
    fmt::print(stderr, "{}\n", printable(fmt::format("{}: {}", arguments.scene, text)));
  };
  try {
    return score_scene(scene, semantics, gains, warn, progress, stop);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", arguments.scene, error.what()));
  }
}

/// By the session's own semantics: its maps are of them.
SceneScores scores_of_session(const ScoreArguments& arguments, const ProgressLine& progress,
                              const std::stop_token& stop) {
  const Configuration configuration = read_session(arguments.session).configuration;
  const auto gains = wanted_gains(arguments.gain, configuration.planner.semantics);
  if (!arguments.csv.empty() && arguments.csv != "-")
    require_no_kept_file(arguments.csv, configuration, arguments.session);
  return score_session(*opened_session(arguments.session, {}, progress, stop), gains, progress, stop);
}

int run(const ScoreArguments& arguments) {
  const StopOnInterrupt stop;
  const ProgressLine progress;
  const SceneScores scores = arguments.session.empty() ? scores_of_scene(arguments, progress, stop.token())
                                                       : scores_of_session(arguments, progress, stop.token());
  progress.clear();
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
  CLI::App* app =
      program.add_subcommand("score", "Rank the candidate views of a session, or of a scene of recorded scans");
  CLI::Option* session =
      app->add_option("SESSION", arguments->session, "folder of a session, as `scan --out` leaves it: as it stands")
          ->transform(kept_session());
  CLI::Option* scene =
      app->add_option("--scene", arguments->scene, "scene file: lines `param`, `scan` with its points, `view`")
          ->type_name("FILE")
          ->excludes(session);
  app->add_option("--semantics", arguments->semantics,
                  "of a scene: published, or what the reference code computes; a session has its own")
      ->capture_default_str()
      ->excludes(session);
  app->add_option("--gain", arguments->gain,
                  "a gain, 'combined', or 'all'; gibbs refines the map first, which takes seconds")
      ->capture_default_str();
  app->add_option("--csv", arguments->csv,
                  "write a row per view with raw values; - for standard output; else a summary is printed")
      ->type_name("FILE");
  app->footer(
      "Examples:\n  nextview score out\n  nextview score out --gain rear-side-entropy --csv scores.csv\n"
      "  nextview score --scene scans1.txt --semantics reference --gain all --csv scores.csv");
  app->callback([arguments, session, scene] {
    if (!*session && !*scene) throw CLI::RequiredError("SESSION or --scene");
    throw CLI::RuntimeError(run(*arguments));
  });
}

}  // namespace nextview
