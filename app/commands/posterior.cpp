#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/progress.hpp"
#include "core/file/atomic_file.hpp"
#include "core/gibbs/exact_posterior.hpp"
#include "core/gibbs/posterior_sampler.hpp"
#include "core/gibbs/toys.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

struct PosteriorArguments {
  std::string toy, model = "attenuation", csv;
  double prior = 0.1;
  std::optional<double> sigma;  ///< [m]; the toy has its own
  int sweeps = 50'000;
  std::uint64_t seed = 1;
};

ForwardModel model_named(const std::string& text) {
  for (const ForwardModel model :
       {ForwardModel::paper, ForwardModel::cone, ForwardModel::beam, ForwardModel::attenuation})
    if (text == name(model)) return model;
  throw std::invalid_argument(fmt::format("--model takes paper, cone, beam or attenuation, not '{}'", text));
}

PosteriorSamplerConfig make_config(const PosteriorArguments& arguments, const GibbsToy& toy) {
  PosteriorSamplerConfig config;
  config.model.kind = model_named(arguments.model);
  config.model.sigma = arguments.sigma.value_or(toy.sigma);
  config.model.angular_sigma = 0.1;        // the toys' rays are few and far apart
  config.model.attenuations = {0.3, 2.0};  // so few that each must count: a voxel is thin or solid
  config.prior = arguments.prior;
  config.sweeps = arguments.sweeps;
  config.burn_in = arguments.sweeps / 20;
  config.until_stationary = false;
  config.ray_spacing = 0.0;
  config.seed = arguments.seed;
  config.validate();
  return config;
}

/// The three answers to the same measurements.
struct Answers {
  ExactPosterior exact;
  GibbsPosterior sampled;
  std::vector<Voxel> independent;
};

/// @throws Stopped
Answers answer(const GibbsToy& toy, const PosteriorSamplerConfig& config) {
  const StopOnInterrupt stop;
  const ProgressLine progress;
  const auto tell = [&](double fraction, std::string_view what, const SamplerDiagnostics&) {
    progress(fraction, what);
  };
  const RangeMeasurements measurements = measurements_of(toy.scans);
  OccupancyMap map(toy.grid, {});
  for (const Scan& scan : toy.scans) map.insert(scan);
  Answers answers{exact_posterior(toy.grid, measurements, config.model, config.prior),
                  sample_posterior(toy.grid, measurements, config, {}, {}, tell, stop.token()), map.voxels().dense()};
  throw_if_stopped(stop.token());
  progress.clear();
  return answers;
}

void print_table(const GibbsToy& toy, const PosteriorSamplerConfig& config, const Answers& answers) {
  fmt::print("{}: {}\n", toy.name, toy.summary);
  fmt::print("{} voxels of {:g} mm, model {}, prior {:g}, sigma {:g} mm, {} chains of {} sweeps\n\n",
             toy.grid.voxel_count(), 1e3 * toy.grid.resolution, name(config.model.kind), config.prior,
             1e3 * config.model.sigma, config.chains, config.sweeps);
  fmt::print("{:>5}  {:<8} {:>9} {:>9} {:>11} {:>9}\n", "voxel", "x y z", "exact", "sampler", "difference", "OctoMap");
  double largest = 0.0;
  for (std::uint32_t v = 0; v < toy.grid.voxel_count(); ++v) {
    const Eigen::Vector3i cell = toy.grid.cell(v);
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
      std::pow(config.model.levels(), toy.grid.voxel_count()), largest, toy.look_at);
}

std::string to_csv(const GibbsToy& toy, const Answers& answers) {
  std::string csv = "voxel,x,y,z,exact,sampler,informed,reach,octomap\n";
  for (std::uint32_t v = 0; v < toy.grid.voxel_count(); ++v) {
    const Eigen::Vector3i cell = toy.grid.cell(v);
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", v, cell.x(), cell.y(), cell.z(), answers.exact.occupied[v],
                       answers.sampled.occupied[v], answers.sampled.informed[v], answers.exact.reach[v],
                       answers.independent[v].probability);
  }
  return csv;
}

std::string toy_list() {
  std::string list;
  for (const GibbsToy& toy : gibbs_toys()) list += fmt::format("  {:<14} {}\n", toy.name, toy.summary);
  return list;
}

int run(const PosteriorArguments& arguments) {
  if (arguments.toy == "list") {
    fmt::print("{}", toy_list());
    return 0;
  }
  const GibbsToy& toy = gibbs_toy(arguments.toy);
  const PosteriorSamplerConfig config = make_config(arguments, toy);
  const Answers answers = answer(toy, config);
  if (arguments.csv == "-") {
    fmt::print("{}", to_csv(toy, answers));
    return 0;
  }
  if (!arguments.csv.empty()) write_file(arguments.csv, to_csv(toy, answers));
  print_table(toy, config, answers);
  return 0;
}

}  // namespace

void add_posterior_command(CLI::App& program) {
  auto arguments = std::make_shared<PosteriorArguments>();
  CLI::App* app = program.add_subcommand(
      "posterior", "What rays say of a few voxels: exactly, by the Gibbs sampler, and with independent voxels");
  app->add_option("--toy", arguments->toy, "a toy below, or list")->required()->type_name("NAME");
  app->add_option("--model", arguments->model, "forward sensor model: paper, cone, beam or attenuation")
      ->capture_default_str();
  app->add_option("--prior", arguments->prior, "probability that a voxel is occupied")->capture_default_str();
  app->add_option("--sigma", arguments->sigma, "noise of the ranges [m]; the toy has its own")->type_name("M");
  app->add_option("--sweeps", arguments->sweeps, "of each chain")->capture_default_str();
  app->add_option("--seed", arguments->seed)->capture_default_str();
  app->add_option("--csv", arguments->csv, "write a row a voxel, too; - for standard output and no table")
      ->type_name("FILE");
  app->footer("Toys:\n" + toy_list() +
              "Examples:\n  nextview posterior --toy slot\n  nextview posterior --toy contradiction --model beam");
  app->callback([arguments] { throw CLI::RuntimeError(run(*arguments)); });
}

}  // namespace nextview
