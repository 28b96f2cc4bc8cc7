#include <iostream>
#include <memory>
#include <stdexcept>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "core/driver/driver_server.hpp"
#include "core/session/driver_setup.hpp"
#include "core/session/session_parts.hpp"
#include "core/source/simulated_source.hpp"

namespace nextview {
namespace {

/// What another session must know to be the same as one with the simulator built in.
std::map<std::string, std::string> own_settings(Configuration& c) {
  std::map<std::string, std::string> own;
  for (const Setting& setting : settings(c)) {
    const bool decided = setting.key.starts_with("object.") || setting.key.starts_with("sensor.");
    if (decided && setting.key != "object.file") own[setting.key] = setting.text();
  }
  return own;
}

int run_simulated(const ConfigurationOptions& options) {
  Configuration c = options.configuration();
  require_exact_robot(c);
  const ConfiguredObject object = load_object(c);
  const auto world = std::make_shared<const SimulatedWorld>(object.placed, c.sensor);
  FreeFlyingCamera robot(configured_start_view(c));
  SourceDescription description = SimulatedSource(world, c.seed).describe();
  description.start = robot.pose();
  serve({"simulated camera",
         {"stop", "simulated"},
         description,
         std::filesystem::absolute(object.file).string(),
         robot,
         [&](std::uint64_t seed) { return std::make_unique<SimulatedSource>(world, seed); },
         c.seed,
         own_settings(c)},
        std::cin, std::cout);
  return 0;
}

}  // namespace

void add_driver_command(CLI::App& program) {
  auto options = std::make_shared<ConfigurationOptions>();
  CLI::App* app =
      program.add_subcommand("driver", "A scanner for --driver: the driver protocol, spoken by this program");
  app->callback([] { throw std::invalid_argument("driver: simulated is missing: nextview driver simulated OBJECT"); });
  CLI::App* simulated = app->add_subcommand(
      "simulated", "The simulated camera: reads requests from standard input and answers until `bye`");
  options->add_to(*simulated);
  simulated->footer("Examples:\n  nextview driver simulated bunny.ply --sensor.range_noise 0.001");
  app->footer(
      "Examples:\n  nextview scan --driver \"nextview driver simulated bunny.ply\"\n"
      "  echo '{\"id\": 1, \"request\": \"hello\", \"protocol\": 1}' | nextview driver simulated bunny.ply");
  simulated->callback([options] { throw CLI::RuntimeError(run_simulated(*options)); });
}

}  // namespace nextview
