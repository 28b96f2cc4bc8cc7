#include "ui/commands/demo_recording.hpp"

#include <gmock/gmock.h>

#include "ui/commands/scan_commands.hpp"
#include "ui/commands/script.hpp"
#include "ui/commands/script_recorder.hpp"
#include "ui/commands/selection_commands.hpp"

namespace nextview {
namespace {

/// Behind the comment that it begins with.
std::string lines_of(const CommandHistory& history, double since) {
  const std::string demo = recorded_demo(history, {"a.nextview", since});
  EXPECT_NO_THROW(parse_script(demo));
  return demo.substr(demo.find('\n') + 1);
}

TEST(DemoRecording, WaitsWhereTheOperatorDid) {
  CommandHistory history;
  ScriptRecorder recorder(history);
  recorder.begin(Configuration());
  recorder.add(command::step());
  history.now = 5;
  recorder.add(command::step());
  history.now = 5.02;
  recorder.add(command::select_next());
  history.now = 7.254;
  EXPECT_EQ(lines_of(history, 0), "step\nwait 5\nstep\nselect-next\nwait 2.25\n") << "nothing is lost by a short pause";
  recorder.add(parse_call("quit"));
  EXPECT_EQ(lines_of(history, 4), "step\nwait 1\nstep\nselect-next\nwait 2.25\n") << "what was before is done at once";
}

TEST(DemoRecording, NothingWaitsForADemoThatWasPlayedBefore) {
  CommandHistory history;
  ScriptRecorder recorder(history);
  for (const char* line : {"title Begin 5", "open box", "wait 4", "caption One", "highlight view 3"})
    recorder.add(parse_call(line));
  history.now = 9;
  recorder.add(parse_call("caption Two"));
  EXPECT_EQ(lines_of(history, 9), "open box\ncaption Two\n");
}

TEST(DemoRecording, LongPausesTakeSeveralLines) {
  EXPECT_EQ(lines_of({{}, {}, 1500.5}, 0), "wait 600\nwait 600\nwait 300.5\n");
}

TEST(DemoRecording, WhatWritesFilesIsAComment) {
  CommandHistory history;
  ScriptRecorder recorder(history);
  recorder.add(parse_call("export-cloud /tmp/cloud.ply"));
  EXPECT_EQ(lines_of(history, 0), "# export-cloud /tmp/cloud.ply\n") << "a demo writes below its own folder only";
}

TEST(DemoRecording, WhatAFlightTookAlreadyIsNotWaitedForBeforeIt) {
  CommandHistory history;
  ScriptRecorder recorder(history);
  history.now = 3;
  recorder.add(parse_call("fly-to 10 20 2"), 0, 2);
  history.now = 4;
  recorder.add(command::step());
  EXPECT_EQ(lines_of(history, 0), "wait 1\nfly-to 10 20 2\nwait 3\nstep\n");
}

}  // namespace
}  // namespace nextview
