#include "tests/integration/random_calls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace nextview {
namespace {

/// Values of settings that a scan stays small with. What is not here takes the value that it has.
const std::map<std::string, std::vector<std::string>> small_settings = {
    {"seed", {"1", "7"}},
    {"object.file", {"sphere", "box", "no such object"}},
    {"object.longest_side", {"0.5", "0.3", "40"}},
    {"sensor.preset", {"paper", "no such preset"}},
    {"sensor.width", {"80", "64", "1", "0"}},
    {"sensor.height", {"60", "48"}},
    {"sensor.field_of_view", {"60", "20", "170"}},
    {"sensor.dropout", {"0", "0.5", "1"}},
    {"map.resolution", {"0.04", "0.05", "0.1"}},
    {"views.count", {"8", "1", "20"}},
    {"views.radius", {"0.9", "0.1"}},
    {"gibbs.chains", {"1", "2"}},
    {"gibbs.sweeps", {"20", "40"}},
    {"gibbs.view_sweeps", {"2", "4"}},
    {"planner.gain_weight", {"0", "1"}},
    {"termination.views", {"4", "2", "12"}},
    {"evaluation.surface_samples", {"500"}},
    {"evaluation.enabled", {"true", "false"}},
    {"views.file", {"", "no such file"}},
};

}  // namespace

std::string RandomCalls::number(const Command& command, const Argument& argument) {
  using Kind = Argument::Kind;
  double low = argument.low, high = argument.high;
  if (command.name == "speed") high = 0.02;  // nobody waits for a minute here
  if (argument.name == "seconds") high = 0.1;
  if (command.name == "export-turntable") high = 4;
  if (command.name == "refine") high = argument.name == "chains" ? 2 : 60;
  if (argument.kind == Kind::whole) return std::to_string(std::lround(low) + long(below(std::size_t(high - low) + 1)));
  switch (below(6)) {
    case 0:
      return fmt::format("{}", low);
    case 1:
      return fmt::format("{}", high);
    case 2:
    case 3:  // most of what there is to see is near the origin
      low = std::max(low, -0.3);
      high = std::min(high, 0.3);
      break;
    default:
      break;
  }
  if (!(low < high)) return fmt::format("{}", argument.low);
  return fmt::format("{}", std::uniform_real_distribution<double>(low, high)(random_));
}

std::string RandomCalls::file(const Command& command) {
  if (command.name != "open") {
    const std::map<std::string, std::string> endings = {
        {"save-picture", ".png"},  {"save-script", ".txt"},   {"record", ".nextview"},
        {"export-cloud", ".pcd"},  {"export-map", ".ot"},     {"export-surface", ".stl"},
        {"export-views", ".json"}, {"export-curves", ".svg"}, {"export-picture", ".png"}};
    const auto found = endings.find(command.name);
    const std::string end = found == endings.end() ? "" : found->second;
    return (folder_ / fmt::format("{} {}{}", command.name, below(3), end)).string();
  }
  const std::array files = {std::string("box"), std::string("sphere"), configuration_.string(),
                            std::string("/no/such file.ply")};
  return files[below(files.size())];
}

std::string RandomCalls::setting(const std::string& key) {
  if (const auto found = small_settings.find(key); found != small_settings.end())
    return found->second[below(found->second.size())];
  Configuration defaults;
  for (const Setting& s : settings(defaults)) {
    if (s.key != key) continue;
    if (const auto* choice = std::get_if<Setting::Choice>(&s.value)) return choice->names[below(choice->names.size())];
    return s.text();
  }
  return "";
}

std::string RandomCalls::value(const Command& command, const Argument& argument, const std::vector<std::string>& given,
                               const SessionSnapshot& session) {
  if (argument.kind == Argument::Kind::file) return file(command);
  if (command.name == "set" && argument.name == "value") return setting(given.front());
  const auto choices = argument.choices ? argument.choices(session) : std::vector<std::string>();
  const bool any = argument.kind != Argument::Kind::choice && below(8) == 0;  // a number that may be out of range
  if (!choices.empty() && !any) return choices[below(choices.size())];
  if (argument.name == "size") return below(2) == 0 ? "64x48" : "two words";
  if (command.name == "connect") return "/no/such/driver";  // "view" may be an editor, which then answers nothing
  if (argument.kind == Argument::Kind::text) return below(2) == 0 ? "view" : "two words";
  if (command.name == "inspect-ray" && !any) return std::to_string(below(48));
  return number(command, argument);
}

std::pair<const Command*, std::vector<std::string>> RandomCalls::next(const SessionSnapshot& session, int often) {
  const Command* command = nullptr;
  do {
    command = &commands()[below(commands().size())].get();
  } while (command->name == "quit" || command->name == "play-demo");
  const std::array<std::string, 7> wrong = {"", "x", "nan", "-1e9", "1e99", "two words", "\""};
  std::vector<std::string> values;
  for (const Argument& argument : command->arguments()) {
    if (argument.optional && below(3) == 0) break;
    const bool allowed = below(std::size_t(often)) != 0 || argument.kind == Argument::Kind::file;
    values.push_back(allowed ? value(*command, argument, values, session) : wrong[below(wrong.size())]);
  }
  if (below(50) == 0) values.push_back("1");
  return {command, values};
}

}  // namespace nextview
