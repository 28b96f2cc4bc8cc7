// Where commands bring the scene's camera, and the view that a script has in place of it.
#include <gmock/gmock.h>

#include <numbers>

#include "tests/unit/workbench/inspected_scan.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/script.hpp"
#include "ui/commands/selection_commands.hpp"

namespace nextview {
namespace {

class CameraCommands : public testing::Test {
 protected:
  CommandTarget target() { return {worker_, window_, session_, progress_}; }
  /// What a line asks of the camera, if it asks for one thing.
  template <class Motion>
  Motion motion(const std::string& line) {
    CommandTarget acted_on = target();
    window_.camera_motions.clear();
    execute(parse_call(line), acted_on);
    EXPECT_EQ(window_.camera_motions.size(), 1u) << line;
    return std::get<Motion>(window_.camera_motions.at(0));
  }

  SessionWorker worker_;
  WindowState window_;
  SessionSnapshot session_;
  WorkerProgress progress_;
};

/// Azimuths go from x towards y, elevations from there towards z.
TEST_F(CameraCommands, EachSideIsWhereItsNameSays) {
  const std::pair<const char*, Vector3> sides[] = {{"front", -Vector3::UnitY()}, {"back", Vector3::UnitY()},
                                                   {"right", Vector3::UnitX()},  {"left", -Vector3::UnitX()},
                                                   {"top", Vector3::UnitZ()},    {"bottom", -Vector3::UnitZ()}};
  for (const auto& [name, direction] : sides) {
    const auto look = motion<camera_motion::LookFrom>(std::string("standard-view ") + name);
    const double a = look.azimuth * std::numbers::pi / 180, e = look.elevation * std::numbers::pi / 180;
    const Vector3 from(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    EXPECT_LT((from - direction).norm(), 0.01) << name;
    EXPECT_LT(std::abs(look.elevation), 90) << "there is no upright straight above";
  }
  motion<camera_motion::Frame>("standard-view usual");
}

TEST_F(CameraCommands, TurnsAndStepsAreAsLargeAsIsSaid) {
  const auto turn = motion<camera_motion::Turn>("turn -12.5 30");
  EXPECT_EQ(turn.azimuth, -12.5);
  EXPECT_EQ(turn.elevation, 30);
  EXPECT_EQ(motion<camera_motion::Zoom>("zoom 2").steps, 2);
  const auto look = motion<camera_motion::LookFrom>("look-from -40 25");
  EXPECT_EQ(look.azimuth, -40);
  EXPECT_EQ(look.elevation, 25);
}

TEST_F(CameraCommands, AViewFromWhereTheSceneIsLookedAtHasNumbersInAScript) {
  InspectedScan scan(small_scan());
  session_ = scan.now();
  const Vector3 from(0.5, 0.35, 0.6);
  window_.scene_camera = look_at(from, Vector3(0.05, 0.0, -0.05));
  CommandCall wanted = parse_call("custom-view");
  wanted.line = 7;
  CommandTarget acted_on = target();
  const CommandCall written = with_numbers(wanted, acted_on);
  EXPECT_EQ(written.command, wanted.command);
  EXPECT_EQ(written.line, 7);
  std::vector<double> numbers;
  for (const std::string& value : written.values()) numbers.push_back(std::stod(value));
  ASSERT_EQ(numbers.size(), 6u);
  const Vector3 stands(numbers[0], numbers[1], numbers[2]), looked_at(numbers[3], numbers[4], numbers[5]);
  EXPECT_LT((stands - from).norm(), 1e-9);
  EXPECT_LT(((looked_at - stands).normalized() - window_.scene_camera.linear().col(2)).norm(), 1e-9);
  execute(written, acted_on);
  EXPECT_TRUE(window_.selection.custom_view.value().isApprox(window_.scene_camera, 1e-9)) << "it does the same";
}

TEST_F(CameraCommands, OtherCallsAreWrittenAsTheyAre) {
  CommandTarget acted_on = target();
  EXPECT_EQ(with_numbers(parse_call("custom-view"), acted_on).text(), "custom-view") << "there is no object yet";
  InspectedScan scan(small_scan());
  session_ = scan.now();
  window_.scene_camera = look_at(Vector3(0.5, 0.35, 0.6), Vector3::Zero());
  for (const char* line : {"custom-view 0.6 -0.5 0.4 0 0 0", "look-through", "step"})
    EXPECT_EQ(with_numbers(parse_call(line), acted_on).text(), line);
}

}  // namespace
}  // namespace nextview
