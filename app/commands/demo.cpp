#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "app/commands/commands.hpp"
#include "app/commands/options.hpp"
#include "app/commands/progress.hpp"
#include "core/file/printable.hpp"
#include "core/results/output_folder.hpp"
#include "core/session/saved_session.hpp"
#include "ui/demo/demo_frames.hpp"
#include "ui/demo/demo_video.hpp"
#include "ui/demo/demo_window.hpp"

namespace nextview {
namespace {

struct DemoArguments {
  std::string demo = "tour", out, size, video;
  std::optional<int> frames_per_second;
  bool check = false, list_commands = false;
};

/// What is missing is no mistake of the demo's.
int check(const DemoArguments& a) {
  const Demo demo = read_demo(a.demo, a.out.empty() ? "out" : a.out);
  const auto missing = missing_data(demo);
  for (const std::string& line : missing) fmt::print(stderr, "warning: {}; the demo is skipped\n", printable(line));
  if (missing.empty()) fmt::print("{}: {} commands\n", printable(demo.file.string()), demo.calls.size());
  return 0;
}

int draw(const DemoArguments& a) {
  const DemoPictures pictures{a.size.empty() ? DemoPictures().size : picture_size(a.size, "--size"),
                              a.frames_per_second.value_or(DemoPictures().frames_per_second)};
  if (!a.video.empty()) require_video(a.video);
  const Demo demo = read_demo(a.demo, a.out);
  require_data(demo);
  const std::vector<InputFile> inputs = {{demo.file, "the demo"}};
  OutputFolder folder(a.out, inputs);
  require_no_session(a.out);
  folder.begin("demo");
  const StopOnInterrupt stop;
  const ProgressLine progress;
  const int frames = write_demo(
      demo, pictures, folder, [&](int number) { progress(0, fmt::format("frame {}", number)); }, stop.token());
  progress.clear();
  fmt::print("{}: frame_00001.png to frame_{:05}.png\n", printable(a.out), frames);
  if (a.video.empty()) return 0;
  write_video(a.out, pictures.frames_per_second, a.video);
  fmt::print("{}\n", printable(a.video));
  return 0;
}

int run(const DemoArguments& a) {
  if (a.list_commands) return fmt::print("{}", demo_commands()), 0;
  if (a.check) return check(a);
  if (!a.out.empty()) return draw(a);
  if (!a.size.empty() || !a.video.empty() || a.frames_per_second)
    throw std::invalid_argument("--size, --fps and --video need --out DIR");
  const Demo demo = read_demo(a.demo);
  require_data(demo);
  return show_demo(demo);
}

/// "compare, gibbs, tour"
std::string names_text() { return fmt::format("{}", fmt::join(demo_names(), ", ")); }

}  // namespace

void add_demo_command(CLI::App& program) {
  auto a = std::make_shared<DemoArguments>();
  CLI::App* app = program.add_subcommand("demo", "Play a demo: in the window, or to frames and video without one");
  app->add_option("DEMO", a->demo, fmt::format("a file of commands, or one of {} (default tour)", names_text()));
  app->add_option("--out", a->out, "no window: writes frame_00001.png, … here, the same ones every time")
      ->type_name("DIR");
  app->add_option("--size", a->size, "of the frames in pixels (default 1280x720)")->type_name("WxH");
  app->add_option("--fps", a->frames_per_second, "frames a second, of the demo's own time (default 30)")
      ->check(within(1, 120));
  app->add_option("--video", a->video, "also makes a video of them by the program ffmpeg, or an animated PNG")
      ->type_name("FILE.mp4|FILE.webm|FILE.png");
  app->add_flag("--check", a->check, "only tells whether every line is right, and what it opens is there");
  app->add_flag("--list-commands", a->list_commands, "prints all commands and ends");
  app->footer(
      "In the window Space pauses, Right skips, F12 is the full screen, and any other key or a click takes over.\n"
      "Examples:\n  nextview demo\n  nextview demo gibbs --out frames --size 1920x1080 --video gibbs.mp4\n"
      "  nextview demo mine.nextview --check");
  app->callback([a] { throw CLI::RuntimeError(run(*a)); });
}

}  // namespace nextview
