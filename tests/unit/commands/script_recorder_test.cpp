#include "ui/commands/script_recorder.hpp"

#include <gmock/gmock.h>

#include "ui/commands/layer_commands.hpp"
#include "ui/commands/scan_commands.hpp"
#include "ui/commands/scene_commands.hpp"
#include "ui/commands/script.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

using testing::ElementsAre;

TEST(ScriptRecorder, KeepsTheLastOfASlidersNumbers) {
  CommandHistory history;
  ScriptRecorder recorder(history);
  for (const double probability : {0.1, 0.2, 0.3}) recorder.add(command::threshold(probability));
  recorder.add(command::slice_at(0.1, 0.2));
  recorder.add(command::slice_at(0.1));
  recorder.add(command::slice_at(0.2));
  EXPECT_THAT(history.lines, ElementsAre("threshold 0.3", "slice-at 0.1 0.2", "slice-at 0.2"));
}

TEST(ScriptRecorder, KeepsEachOfWhatAddsUpOrIsNoNumber) {
  CommandHistory history;
  ScriptRecorder recorder(history);
  for (int twice = 0; twice < 2; ++twice) recorder.add(command::zoom(1.0));
  for (int twice = 0; twice < 2; ++twice) recorder.add(command::step());
  for (const char* panel : {"log", "view"}) recorder.add(command::panel(panel));
  EXPECT_THAT(history.lines, ElementsAre("zoom 1", "zoom 1", "step", "step", "panel log", "panel view"));
}

TEST(ScriptRecorder, HasValuesAsTheyWereWrittenAndNoPalette) {
  CommandHistory history;
  ScriptRecorder recorder(history);
  recorder.add(parse_call("speed 0.50"));
  recorder.add(command::palette());
  recorder.add(command::shortcuts());
  EXPECT_THAT(history.lines, ElementsAre("speed 0.50"));
  recorder.add(command::speed(1.0));
  EXPECT_THAT(history.lines, ElementsAre("speed 1"));
}

TEST(ScriptRecorder, BeginsWithWhatLeadsToTheConfiguration) {
  CommandHistory history;
  ScriptRecorder recorder(history);
  recorder.add(command::threshold(0.1));
  Configuration configuration;
  configuration.object.file = "bunny";
  recorder.begin(configuration);
  recorder.add(command::threshold(0.2));
  EXPECT_THAT(history.lines, ElementsAre("open bunny", "threshold 0.2"));
}

}  // namespace
}  // namespace nextview
