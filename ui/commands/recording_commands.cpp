#include "ui/commands/recording_commands.hpp"

#include "core/file/atomic_file.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/demo_file.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

constexpr const char* first_demo = "tour";

std::string play_why_not(const CommandState& t) {
  if (t.window.recording) return "a recording runs: record-stop ends it";
  if (t.session.live) return "a scanner is connected: disconnect leaves it";
  return t.window.presentation.demo ? "a demo is playing" : "";
}

/// As the recording stands now.
void write_recording(const CommandTarget& t) {
  write_file(t.window.recording->file, recorded_demo(t.window.history, *t.window.recording));
}

}  // namespace

const CommandOf<std::optional<std::string>> command::play_demo{
    {.name = "play-demo",
     .menu = "Demo",
     .text = "Play the tour",
     .help = "Plays a demo in place of what is shown: the tour, one that comes with the program, or a file.",
     .why_not = play_why_not,
     .question =
         [](const CommandState& t, const auto&) {
           return CommandQuestion{what_is_lost(t, false), "Play"};
         }},
    argument::optional(argument::file("demo", "its name or file", [](const SessionSnapshot&) { return demo_names(); })),
    [](CommandTarget& t, const std::optional<std::string>& demo) {
      const std::string wanted = demo.value_or(first_demo);
      require_data(read_demo(wanted));  // what is wrong with it ends nothing
      t.window.wanted_demo = wanted;
    }};

const CommandOf<std::string> command::record{
    {.name = "record",
     .menu = "Demo",
     .text = "Record a demo…",
     .help =
         "Writes what is done from now on as a demo, with its pauses and the camera's motions, until record-stop or "
         "the window's end. What was done before is done at once when it is played.",
     .writes = true},
    argument::file("file", "a file that ends in .nextview", argument::fixed({"recorded.nextview"})),
    [](CommandTarget& t, const std::string& file) {
      if (!file.ends_with(".nextview")) throw std::invalid_argument("record: " + file + " must end in .nextview");
      // One that runs goes on in this file: its own may be one that cannot be written any more.
      const DemoRecording recording{file, t.window.recording ? t.window.recording->since : t.window.history.now};
      write_file(file, recorded_demo(t.window.history, recording));
      t.window.recording = recording;
      t.worker.log().add(LogEntry::Level::success, "Recording to " + file + " until Demo › Stop recording");
    }};

const CommandOf<> command::record_stop{
    {.name = "record-stop",
     .menu = "Demo",
     .text = "Stop recording",
     .help = "Ends what record began: the file is complete.",
     .why_not = [](const CommandState& t) { return t.window.recording ? "" : "nothing is recorded: record begins"; }},
    [](CommandTarget& t) {
      write_recording(t);
      t.worker.log().add(LogEntry::Level::success, "Recorded: " + t.window.recording->file);
      t.window.recording.reset();
    }};

}  // namespace nextview
