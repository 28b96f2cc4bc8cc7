#include "ui/commands/starting_script.hpp"

#include "ui/commands/file_commands.hpp"

namespace nextview {
namespace {

/// As it is found from any folder; known objects by their names.
std::string place_of(const std::string& object) {
  std::error_code error;
  return std::filesystem::exists(object, error) ? std::filesystem::absolute(object).string() : object;
}

}  // namespace

std::vector<std::string> starting_script(const Configuration& configuration) {
  std::vector<std::string> script;
  Configuration reached, wanted = configuration;
  if (wanted.object.file != reached.object.file) {
    script.push_back(command::open(place_of(wanted.object.file)).text());
    reached.object.file = wanted.object.file;
  }
  if (!wanted.recorded.folder.empty()) {
    script.push_back(command::open(place_of(wanted.recorded.folder)).text());
    reached.recorded.folder = wanted.recorded.folder;
  }
  if (wanted.sensor_preset != reached.sensor_preset) {  // sets other settings, too
    script.push_back(command::set("sensor.preset", wanted.sensor_preset).text());
    apply_sensor_preset(reached, wanted.sensor_preset);
  }
  const auto from = settings(reached), to = settings(wanted);
  for (std::size_t i = 0; i < to.size(); ++i)
    if (from[i].text() != to[i].text()) script.push_back(command::set(to[i].key, to[i].text()).text());
  return script;
}

}  // namespace nextview
