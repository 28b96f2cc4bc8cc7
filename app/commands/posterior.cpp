#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/progress.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/gibbs/exact_posterior.hpp"
#include "core/gibbs/posterior_sampler.hpp"
#include "core/gibbs/test_problems.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/progress/stopped.hpp"
#include "core/setting/setting_sources.hpp"

namespace nextview {
namespace {

struct PosteriorArguments {
  std::string problem, former, model = "attenuation", csv;
  double prior = 0.1;
  std::optional<double> sigma;  ///< [m]; the test problem has its own
  int sweeps = 50'000;
  std::uint64_t seed = 1;
};

ForwardModel model_named(const std::string& text) {
  for (const ForwardModel model :
       {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam, ForwardModel::attenuation})
    if (text == name(model)) return model;
  throw std::invalid_argument(fmt::format("--model takes paper, cone, beam or attenuation, not '{}'", text));
}

/// What settings are called here.
const SettingSources option_names = {
    {"gibbs.prior", {"--prior", "", ""}}, {"gibbs.sigma", {"--sigma", "", ""}}, {"gibbs.sweeps", {"--sweeps", "", ""}}};

PosteriorSamplerConfig make_config(const PosteriorArguments& arguments, const TestProblem& problem) {
  PosteriorSamplerConfig config;
  config.model.kind = model_named(arguments.model);
  config.model.sigma = arguments.sigma.value_or(problem.sigma);
  config.model.angular_sigma = 0.1;        // the test problems' rays are few and far apart
  config.model.attenuations = {0.3, 2.0};  // so few that each must count: a voxel is thin or solid
  config.prior = arguments.prior;
  config.sweeps = arguments.sweeps;
  config.burn_in = arguments.sweeps / 20;
  config.until_stationary = false;
  config.ray_spacing = 0.0;
  config.seed = arguments.seed;
  try {
    config.validate();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(as_given(error.what(), option_names));
  }
  return config;
}

/// The three answers to the same measurements.
struct Answers {
  ExactPosterior exact;
  GibbsPosterior sampled;
  std::vector<Voxel> independent;
};

/// @throws Stopped
Answers answer(const TestProblem& problem, const PosteriorSamplerConfig& config) {
  const StopOnInterrupt stop;
  const ProgressLine progress;
  const auto report = [&](double fraction, std::string_view what, const SamplerDiagnostics&) {
    progress(fraction, what);
  };
  const RangeMeasurements measurements = measurements_of(problem.scans);
  OccupancyMap map(problem.grid, {});
  for (const Scan& scan : problem.scans) map.insert(scan);
  Answers answers{exact_posterior(problem.grid, measurements, config.model, config.prior),
                  sample_posterior(problem.grid, measurements, config, {}, {}, report, stop.token()),
                  map.voxels().dense()};
  if (stop.asked()) throw Stopped();
  progress.clear();
  return answers;
}

void print_table(const TestProblem& problem, const PosteriorSamplerConfig& config, const Answers& answers) {
  fmt::print("{}: {}\n", problem.name, problem.summary);
  fmt::print("{} voxels of {:g} mm, model {}, prior {:g}, sigma {:g} mm, {} of {}\n\n", problem.grid.voxel_count(),
             1e3 * problem.grid.resolution, name(config.model.kind), config.prior, 1e3 * config.model.sigma,
             counted(config.chains, "chain"), counted(config.sweeps, "sweep"));
  fmt::print("{:>5}  {:<8} {:>9} {:>9} {:>11} {:>9}\n", "voxel", "x y z", "exact", "sampler", "difference", "OctoMap");
  double largest = 0.0;
  for (std::uint32_t v = 0; v < problem.grid.voxel_count(); ++v) {
    const Eigen::Vector3i cell = problem.grid.cell(v);
    const double exact = answers.exact.occupied[v], sampled = answers.sampled.occupied[v];
    fmt::print("{:>5}  {} {} {}    {:>9.4f} ", v, cell.x(), cell.y(), cell.z(), exact);
    if (answers.sampled.informed[v]) {
      fmt::print("{:>9.4f} {:>+11.4f}", sampled, sampled - exact);
      largest = std::max(largest, std::abs(sampled - exact));
    } else {
      fmt::print("{:>9} {:>11}", "hidden", "");
    }
    fmt::print(" {:>9.2f}{}\n", answers.independent[v].probability,
               answers.independent[v].measured ? "" : "  unmeasured");
  }
  fmt::print(
      "\nP(occupied). exact: all {:g} maps added up (Eqs. 3-4). sampler: off by at most {:.4f}; hidden: under half a\n"
      "ray gets there, reported as 0.5. OctoMap: every voxel for itself.\n\n{}\n",
      std::pow(config.model.levels(), problem.grid.voxel_count()), largest, problem.look_at);
}

std::string to_csv(const TestProblem& problem, const Answers& answers) {
  std::string csv = "voxel,x,y,z,exact,sampler,informed,reach,octomap\n";
  for (std::uint32_t v = 0; v < problem.grid.voxel_count(); ++v) {
    const Eigen::Vector3i cell = problem.grid.cell(v);
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", v, cell.x(), cell.y(), cell.z(), answers.exact.occupied[v],
                       answers.sampled.occupied[v], answers.sampled.informed[v], answers.exact.reach[v],
                       answers.independent[v].probability);
  }
  return csv;
}

std::string problem_list() {
  std::string list;
  for (const TestProblem& problem : test_problems())
    list += fmt::format("  {:<14} {}\n", problem.name, problem.summary);
  return list;
}

void take_former_name(PosteriorArguments& arguments) {
  if (!arguments.former.empty()) {
    fmt::print(stderr, "notice: --toy is called --problem now; its old name will go with version 0.6\n");
    arguments.problem = arguments.former;
  }
  if (arguments.problem.empty()) throw CLI::RequiredError("--problem");
}

int run(PosteriorArguments arguments) {
  take_former_name(arguments);
  if (arguments.problem == "list") {
    fmt::print("{}", problem_list());
    return 0;
  }
  const TestProblem& problem = test_problem(arguments.problem);
  const PosteriorSamplerConfig config = make_config(arguments, problem);
  std::optional<AtomicFile> csv;  // first: where none can be written nobody waits for the answers
  if (!arguments.csv.empty() && arguments.csv != "-") csv.emplace(arguments.csv);
  const Answers answers = answer(problem, config);
  if (arguments.csv == "-") {
    fmt::print("{}", to_csv(problem, answers));
    return 0;
  }
  if (csv) {
    csv->stream() << to_csv(problem, answers);
    csv->commit();
  }
  print_table(problem, config, answers);
  return 0;
}

}  // namespace

void add_posterior_command(CLI::App& program) {
  auto arguments = std::make_shared<PosteriorArguments>();
  CLI::App* app = program.add_subcommand(
      "posterior", "What rays say of a few voxels: exactly, by the Gibbs sampler, and with independent voxels");
  app->add_option("--problem", arguments->problem, "a test problem below, or list")->type_name("NAME");
  app->add_option("--toy", arguments->former)->group("");  // its name in version 0.4, read until 0.6
  app->add_option("--model", arguments->model, "forward sensor model: paper, cone, beam or attenuation")
      ->capture_default_str();
  app->add_option("--prior", arguments->prior, "probability that a voxel is occupied")->capture_default_str();
  app->add_option("--sigma", arguments->sigma, "noise of the ranges [m]; the test problem has its own")
      ->type_name("M")
      ->transform(quantity("m"));
  app->add_option("--sweeps", arguments->sweeps, "of each chain")->capture_default_str();
  app->add_option("--seed", arguments->seed, "of the chains' random numbers")->capture_default_str();
  app->add_option("--csv", arguments->csv, "write a row per voxel, too; - for standard output and no table")
      ->type_name("FILE");
  app->footer(
      "Test problems:\n" + problem_list() +
      "Examples:\n  nextview posterior --problem slot\n  nextview posterior --problem contradiction --model beam");
  app->callback([arguments] { throw CLI::RuntimeError(run(*arguments)); });
}

}  // namespace nextview
