#include "ui/commands/starting_script.hpp"

#include <gtest/gtest.h>

#include "ui/commands/script.hpp"

namespace nextview {
namespace {

using Lines = std::vector<std::string>;

/// What `set` and `open` do to a configuration.
Configuration followed(const Lines& script) {
  Configuration configuration;
  for (const std::string& line : script) {
    const CommandCall call = parse_call(line);
    const auto values = call.values();
    if (call.command->name == "open") {
      configuration.object.file = values[0];
    } else if (values.at(0) == "sensor.preset") {
      apply_sensor_preset(configuration, values[1]);
    } else {
      auto all = settings(configuration);
      for (Setting& setting : all)
        if (setting.key == values[0]) setting.set(values[1]);
    }
    EXPECT_NO_THROW(configuration.validate()) << line;
  }
  return configuration;
}

TEST(StartingScript, NamesObjectAndGain) {
  EXPECT_EQ(starting_script({}), Lines{});
  Configuration c;
  c.object.file = "bunny";
  c.planner.gain = "area-factor";
  EXPECT_EQ(starting_script(c), (Lines{"open bunny", "set planner.gain area-factor"}));
}

TEST(StartingScript, LeadsToTheSameConfiguration) {
  for (const char* file : {"paper", "calibrated"}) {
    Configuration c = read_configuration(assets_folder() / "configurations" / (std::string(file) + ".toml"), {});
    EXPECT_EQ(to_toml(followed(starting_script(c))), to_toml(c)) << file;
  }
  Configuration c;
  apply_sensor_preset(c, "narrow");
  c.sensor.width = Configuration().sensor.width;  // a default that the preset would not have
  c.planner.combined_weights = "";
  c.seed = 77;
  EXPECT_EQ(to_toml(followed(starting_script(c))), to_toml(c));
}

}  // namespace
}  // namespace nextview
