// Demos: those that come with the program to their end, the same frames however they are played, and broken ones.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>
#include <set>

#include "core/file/installation.hpp"
#include "core/file/read_file.hpp"
#include "tests/integration/demos.hpp"
#include "tests/integration/user.hpp"
#include "tests/render/animation_pictures.hpp"
#include "tests/render/render_test.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// With everything that moves.
constexpr const char* short_demo =
    "hide-panels\ntitle \"A sphere\" 0.5\nopen tiny.toml\ncaption \"Two views\"\norbit 90 1 10\nwait until done\n"
    "step\nwait 0.3\nfly-to 20 40 0.7 1.5\nhide-panels\nstep\ncaption \"{reason}\" 1\nhighlight view 0.9\n"
    "wait until done\nassert views 2\nassert coverage > 0\n";

TEST_F(Demos, FramesAreTheSameEveryTimeOnAnyNumberOfThreadsAndHoweverManyThereAre) {
  const Demo played = demo(short_demo);
  const auto first = frames(played, small);
  EXPECT_EQ(first.size(), 11u) << "of 2.65 s: 1 of motion, 0.3, and a caption of 1 that comes once the last has gone";
  std::set<std::vector<std::uint8_t>> different;
  for (const Image& frame : first) different.insert(frame.rgba);
  EXPECT_GT(different.size(), 7u) << "nothing moves";
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  expect_same(first, frames(played, small));
  const auto half = frames(played, {small.size, 2});
  for (std::size_t i = 0; i < half.size(); ++i) EXPECT_TRUE(half[i] == first.at(2 * i)) << "at " << 0.5 * i << " s";
}

/// It is the README's animation, too: a picture of every other second, half a second each.
TEST_F(Demos, TheTourPlaysToItsEndAndLooksAsItsPicture) {
  std::vector<Image> shown;
  int count = 0;
  play_demo(read_demo("tour"), {{480, 270}, 4}, [&](const Image& frame, int number) {
    count = number;
    if (number % 8 == 5) shown.push_back(frame);
  });
  EXPECT_GT(count, 4 * 90);
  EXPECT_LT(count, 4 * 130) << "it is to take about two minutes at most";
  expect_animation("demo_tour", shown, 2);
}

TEST_F(Demos, AllOthersThatComeWithTheProgramPlayToTheirEnd) {
  auto names = demo_names();
  EXPECT_THAT(names, ::testing::IsSupersetOf({"compare", "gibbs", "recorded", "tour"}));
  std::erase(names, "tour");
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const Demo played = read_demo(name);
    if (!played.needs.empty() && !missing_data(played).empty()) {
      EXPECT_THAT(missing_data(played).front(), HasSubstr("; it needs Debian's package "));
      EXPECT_THROW(require_data(played), std::runtime_error);
      continue;
    }
    EXPECT_THAT(missing_data(played), ::testing::IsEmpty());
    int count = 0;
    EXPECT_NO_THROW(play_demo(played, {{160, 90}, 4}, [&](const Image&, int number) { count = number; }));
    EXPECT_GT(count, 4 * 20);
  }
}

TEST_F(Demos, AWindowShowsTheSameFrames) {
  const Demo played = demo(short_demo);
  const auto expected = frames(played, small);
  OffscreenTarget target(320, 180);
  SessionWorker worker;
  InspectionWorker inspector;
  Interface window(target, worker, inspector, 0.25);
  window.play_demo(played.calls);
  // As a display does: frames of uneven length, and some while the session works.
  std::size_t next = 0;
  for (double time = 0, wanted = 0; next < expected.size();) {
    if (!window.is_still()) {
      window.draw(0);
      continue;
    }
    if (time >= wanted - 1e-9) {
      EXPECT_TRUE(target.read_back() == expected[next]) << "frame " << next + 1;
      wanted = 0.25 * double(++next);
    }
    const double step = std::min(wanted - time, next % 2 ? 0.1 : 0.07);
    window.draw(step);
    time += step;
    if (window.script_is_done()) break;
  }
  EXPECT_GE(next, expected.size() - 1);
}

TEST_F(Demos, ACaptionsTimeStandsStillWhileTheSessionWorks) {
  User user(tiny_scan(), 320, 180, 0.25);
  user.run("caption \"A sphere\" 100\n");
  const Presentation& shown = user.window().state().presentation;
  constexpr double frame = 0.05;
  const double begin = shown.time;
  user.window().draw(frame);
  EXPECT_NEAR(shown.time - begin, frame, 1e-9) << "nothing runs";
  int worked = 0;
  double passed = 0;
  for (int view = 0; view < 4; ++view) {
    user.type(key('S'));
    do {
      const bool works = user.worker().progress().busy;
      const double before = shown.time;
      user.window().draw(frame);
      if (!works) continue;
      ++worked;
      passed += shown.time - before;
    } while (user.worker().progress().busy || !user.window().is_still());
  }
  EXPECT_EQ(user.session().records.size(), 4u);
  EXPECT_GE(worked, 4) << "it was never looked while the session worked";
  EXPECT_LT(passed, 1.5 * frame) << "of " << worked << " frames; what works may end just before one is drawn";
}

TEST_F(Demos, TheOperatorPausesSkipsAndTakesOver) {
  OffscreenTarget target(320, 180);
  SessionWorker worker;
  InspectionWorker inspector;
  Interface window(target, worker, inspector, 0.25);
  window.play_demo(demo("hide-panels\ntoggle-legends\ntoggle-views\ntoggle-rays\ncaption \"one\"\nwait 100\ncaption "
                        "\"two\"\nwait 100\n")
                       .calls);
  const auto frames = [&](int count) {
    for (int i = 0; i < count; ++i) window.draw(0.1);
  };
  const auto type = [&](Key key) {
    window.push(input::KeyChange{key, true});
    window.push(input::KeyChange{key, false});
    frames(8);
  };
  frames(8);
  const Presentation& shown = window.state().presentation;
  ASSERT_TRUE(shown.caption);
  EXPECT_EQ(shown.caption->text, "one");
  type(Key::space);
  const double time = shown.time;
  frames(5);
  EXPECT_TRUE(shown.paused);
  EXPECT_EQ(shown.time, time);
  type(Key::space);
  EXPECT_GT(shown.time, time);
  type(Key::right);
  EXPECT_EQ(shown.caption->text, "two");
  type(Key::alt);
  type(Key::f12);
  EXPECT_TRUE(window.state().full_screen);
  EXPECT_FALSE(window.script_is_done());
  type(Key::escape);
  EXPECT_TRUE(window.script_is_done());
  EXPECT_FALSE(shown.demo);
  EXPECT_FALSE(window.state().panels_hidden) << "there is nothing to go on with";
  EXPECT_TRUE(window.state().layers.legends);
  EXPECT_TRUE(window.state().layers.views);
  EXPECT_TRUE(window.state().layers.rays);
  for (const char* line : {"hide-panels", "toggle-legends", "toggle-views", "toggle-rays"})
    EXPECT_EQ(std::ranges::count(window.state().history.lines, line), 2) << "a recording begins with " << line;
}

TEST_F(Demos, WhatOneLeavesAwayComesBackAtItsEnd) {
  OffscreenTarget target(320, 180);
  SessionWorker worker;
  InspectionWorker inspector;
  Interface window(target, worker, inspector, 0.25);
  window.play_demo(demo("hide-panels\ntoggle-legends\ntoggle-views\ntoggle-rays\nwait 0.5\n").calls);
  for (int i = 0; i < 5; ++i) window.draw(0.05);
  EXPECT_TRUE(window.state().panels_hidden);
  for (int i = 0; i < 30; ++i) window.draw(0.1);
  EXPECT_FALSE(window.state().presentation.demo);
  EXPECT_FALSE(window.state().panels_hidden);
  const LayerChoice& layers = window.state().layers;
  EXPECT_TRUE(layers.legends && layers.views && layers.rays);
}

TEST_F(Demos, WhatOneEndsWithStaysUntilTheNextObject) {
  User user(tiny_scan(), 320, 180, 0.25);
  user.window().play_demo(demo("open box\nstep\ntoggle-octree\ntoggle-cloud\ncloud-colour distance\n"
                               "object-style solid\n")
                              .calls);
  user.wait();
  const LayerChoice& layers = user.window().state().layers;
  ASSERT_FALSE(user.window().state().presentation.demo);
  EXPECT_TRUE(layers.cloud && !layers.octree) << "that is what was shown";
  user.run("open sphere\n");
  EXPECT_TRUE(layers.octree && !layers.cloud);
  EXPECT_EQ(layers.object_style, MeshStyle::ghost);
  EXPECT_EQ(layers.cloud_colouring, CloudColouring::single);
  EXPECT_EQ(user.window().state().history.lines.back(), "cloud-colour single") << "a recording has it, too";
}

TEST_F(Demos, OnlyOneWithCaptionsHasRoomForThem) {
  for (const bool captioned : {false, true}) {
    User user(tiny_scan(), 320, 180, 0.25);
    user.window().play_demo(demo(captioned ? "wait 0.5\ncaption \"one\" 0.2\nwait 100\n" : "wait 100\n").calls);
    const auto has_room = [&] {
      for (int i = 0; i < 5; ++i) user.window().draw(0.01);
      return !user.window().layout().captions.empty();
    };
    EXPECT_EQ(has_room(), captioned);
    user.type(Key::space);
    EXPECT_TRUE(has_room()) << "for what the keys do while it is paused";
    user.type(Key::space);
    EXPECT_EQ(has_room(), captioned);
  }
}

TEST_F(Demos, AFileThatIsOpenedIsPlayed) {
  User user(tiny_scan(), 320, 180, 0.25);
  user.drop(demo("open box\nstep\n").file);
  user.wait();
  EXPECT_EQ(user.session().object_name, "box");
  EXPECT_EQ(user.session().records.size(), 1u);
  EXPECT_FALSE(user.window().state().presentation.demo);
}

TEST_F(Demos, AFileThatIsDroppedTakesOverAndIsOpened) {
  User user(tiny_scan(), 320, 180, 0.25);
  user.window().play_demo(demo("caption \"one\"\nwait 100\n").calls);
  for (int i = 0; i < 5; ++i) user.window().draw(0.1);
  ASSERT_TRUE(user.window().state().presentation.demo);
  user.drop("box");
  user.wait();
  EXPECT_FALSE(user.window().state().presentation.demo);
  EXPECT_EQ(user.session().object_name, "box");
}

TEST_F(Demos, WhatOneBorrowsOfTheUserIsGivenBack) {
  User user(tiny_scan(), 320, 180, 0.25);
  const WindowPreferences own{1.25, true, true, {200, 300, 150}};
  user.window().set_preferences(own);
  user.run("cloud-colour height\ntoggle-orthographic\n");
  user.window().play_demo(
      demo("open box\ntext-size bigger\npanel-sizes 150 150 150\ncloud-colour view\nwait 0.5\n").calls);
  const WindowState& state = user.window().state();
  EXPECT_FALSE(state.dark || state.guide_open || state.orthographic) << "it is played in a window as it is at first";
  EXPECT_EQ(user.window().preferences(), own) << "and the window may be closed meanwhile";
  user.wait();
  EXPECT_LT(user.window().seconds_to_next_frame(), 0.1) << "that it has ended is seen without a hand";
  user.window().draw(0.1);
  ASSERT_FALSE(state.presentation.demo);
  EXPECT_EQ((WindowPreferences{state.text_scale, state.guide_open, state.dark, state.place_sizes}), own);
  EXPECT_TRUE(state.orthographic);
  user.run("open sphere\n");
  EXPECT_EQ(state.layers.cloud_colouring, CloudColouring::by_height);
  EXPECT_EQ(user.window().preferences(), own);
}

TEST_F(Demos, MistakesNameTheirLine) {
  const std::string file = (folder_ / "demo.nextview").string();
  EXPECT_EQ(error_of("wait 1\nwiat 1\n"), file + ":2: there is no command 'wiat'; did you mean 'wait'?");
  EXPECT_THAT(error_of("\n\nwait soon\n"), HasSubstr(":3: wait: SECONDS must be a number from 0 to 600, not 'soon'"));
  EXPECT_THAT(error_of("export-cloud cloud.ply\n"), HasSubstr(":1: export-cloud: a demo writes below --out only"));
  EXPECT_THAT(error_of("connect \"python3 mine.py\"\n"), HasSubstr(":1: connect: a demo starts no program"));
  EXPECT_THROW(demo("save-picture ../a.png\n", folder_), std::runtime_error);
  EXPECT_THROW(demo("save-picture /tmp/a.png\n", folder_), std::runtime_error);
  EXPECT_EQ(demo("save-picture a.png\n", folder_).calls.front().values().front(), (folder_ / "a.png").string());
  EXPECT_THAT(error_of("# nothing\n"), HasSubstr("has no commands"));
  EXPECT_THAT(error_of("wait 0.1\nstep\n", true), HasSubstr(":2: step: there is no object yet"));
  EXPECT_THAT(error_of("open sphere\nassert views 3\n", true), HasSubstr(":2: assert: views is 0, not = 3"));
  EXPECT_THAT(error_of("assert views many\n"), HasSubstr(":1: assert"));
  EXPECT_THROW(read_demo("tuor"), std::runtime_error);
  EXPECT_EQ(missing_data(demo("open nowhere.ply\n")).size(), 1u);
}

/// A demo that is cut, has its lines swapped, words of other lines, huge numbers or unknown commands.
std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t end) { return std::size_t(random() % std::max<std::size_t>(end, 1)); };
  static const std::vector<std::string> words = {"1e308",          "-1",          "nan",    "wait",    "\"",
                                                 "until",          "orbit 1e9 1", "assert", "{}{}{",   "%n",
                                                 "99999999999999", "#",           "open",   "\x01\xff"};
  for (std::size_t changes = 1 + below(3); changes-- > 0;) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text.insert(at, words[below(words.size())]);
        break;
      case 2:
        text.replace(at, std::min<std::size_t>(below(9), text.size() - at), words[below(words.size())]);
        break;
      case 3:
        text += text.substr(at, below(200));
        break;
      default:
        text.erase(at, below(12));
    }
  }
  return text;
}

TEST_F(Demos, TwoHundredMutatedOnesPlayOrSayWhatIsWrong) {
  std::mt19937 random(20240229 + GTEST_FLAG_GET(random_seed));
  const std::string file = (folder_ / "demo.nextview").string();
  int wrong = 0;
  for (int i = 0; i < 200; ++i) {
    const std::string text = mutated(short_demo, random);
    SCOPED_TRACE(text);
    std::string error = error_of(text);
    // Played only every tenth, and not what would take long: settings and waits may have become anything.
    if (error.empty() && i % 10 == 0 && text.find("e9") == text.npos && text.size() < 1000)
      error = error_of(text, true);
    wrong += !error.empty();
    EXPECT_TRUE(error.empty() || error.starts_with(file + ":")) << error;
    EXPECT_EQ(error.find('\n'), error.npos) << error;
  }
  EXPECT_GT(wrong, 60);
  EXPECT_LT(wrong, 200);
}

}  // namespace
}  // namespace nextview
