// Sensors that are known by name, or have a file of their own.
#include <gtest/gtest.h>

#include "tests/unit/config/configuration_file.hpp"

namespace nextview {
namespace {

using SensorPreset = ConfigurationFile;

TEST_F(SensorPreset, PresetsThenOverrides) {
  Configuration narrow, wide;
  apply_sensor_preset(narrow, "narrow");
  apply_sensor_preset(wide, "wide");
  EXPECT_EQ(narrow.sensor_preset, "narrow");
  EXPECT_NE(narrow.sensor.field_of_view, wide.sensor.field_of_view);
  // The order in the file does not matter.
  for (const char* text : {"[sensor]\npreset = 'narrow'\nwidth = 77\n", "[sensor]\nwidth = 77\npreset = 'narrow'\n"}) {
    const Configuration c = read(text);
    EXPECT_EQ(c.sensor_preset, "narrow");
    EXPECT_EQ(c.sensor.width, 77);
    EXPECT_EQ(c.sensor.height, narrow.sensor.height);
    EXPECT_EQ(c.sensor.field_of_view, narrow.sensor.field_of_view);
  }
  // A preset leaves nothing of the sensor before it.
  Configuration base;
  base.sensor.width = 5;
  EXPECT_EQ(read("sensor.preset = 'wide'\n", base).sensor.width, wide.sensor.width);
}

TEST_F(SensorPreset, ThePapersPresetIsTheDefault) {
  Configuration paper;
  apply_sensor_preset(paper, "paper");
  EXPECT_EQ(texts(paper), default_texts());
  for (const char* name : {"paper", "narrow", "wide"}) {
    Configuration configuration;
    apply_sensor_preset(configuration, name);
    EXPECT_NO_THROW(configuration.validate()) << name;
  }
}

TEST_F(SensorPreset, APresetMayBeAFileOfSensorSettingsAlone) {
  const auto preset = (folder_ / "mine.toml").string();
  std::ofstream(preset) << "[sensor]\nwidth = 31\n";
  EXPECT_EQ(read("sensor.preset = '" + preset + "'\n").sensor.width, 31);
  for (const char* bad :
       {"[map]\nresolution = 0.02\n", "[sensor]\npreset = 'wide'\n", "[sensor]\nwidht = 3\n", "[sensor"}) {
    std::ofstream(preset, std::ios::trunc) << bad;
    Configuration configuration;
    EXPECT_THROW(apply_sensor_preset(configuration, preset), std::runtime_error) << bad;
  }
}

TEST_F(SensorPreset, UnknownPresetsNameTheKnownAndTheLine) {
  const std::string why = reason("\nsensor.preset = 'narow'\n");
  EXPECT_NE(why.find("narrow"), std::string::npos) << why;
  EXPECT_NE(why.find(":2:"), std::string::npos) << why;
}

}  // namespace
}  // namespace nextview
