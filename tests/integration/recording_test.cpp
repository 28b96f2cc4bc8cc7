// What is done in the window is recorded as a demo, and the demo does the same.
#include <gmock/gmock.h>

#include <map>

#include "core/file/atomic_file.hpp"
#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "ui/commands/demo_file.hpp"
#include "ui/demo/demo_frames.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Recordings : public InTemporaryFolder {
 protected:
  std::string file() const { return (folder_ / "recorded.nextview").string(); }

  /// All that an export writes, but seconds and paths.
  std::map<std::string, std::string> results(User& user, const std::string& name) const {
    user.run("export \"" + (folder_ / name).string() + "\"\n");
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / name))
      if (entry.is_regular_file() && entry.path().filename() != "timings.csv")
        contents[fs::relative(entry.path(), folder_ / name)] = read_file(entry.path());
    return contents;
  }

  /// An operator at work: steps, a drag, a view of one's own, a branch, and pauses.
  void work(User& user) const {
    const auto rest = [&](double seconds) {
      user.wait();
      user.window().draw(seconds);
      user.wait();
    };
    user.window().ask(parse_call("step"));
    rest(1.5);
    const Rectangle& scene = user.window().layout().scene;
    user.move(scene.x + scene.width / 2, scene.y + scene.height / 2);
    user.press();
    for (int i = 0; i < 8; ++i) {
      user.move(scene.x + scene.width / 2 + 12 * i, scene.y + scene.height / 2 + 3 * i);
      user.window().draw(0.1);
    }
    user.release();
    rest(0.5);
    for (const char* line : {"custom-view", "take-custom-view", "step", "go-to-view 1", "branch mine", "step"}) {
      user.window().ask(parse_call(line));
      rest(0.25);
    }
  }
};

TEST_F(Recordings, ReplayToTheSameSession) {
  User user(tiny_scan(), 640, 400, 0.5);
  user.worker().keep_sessions(folder_ / "kept");
  user.window().record(file());
  work(user);
  user.run("record-stop\n");
  EXPECT_FALSE(user.window().state().recording);
  const std::string text = read_file(file());
  EXPECT_THAT(text, ::testing::ContainsRegex("\nstep\nwait 1\\.[5-9]"));
  EXPECT_THAT(text, HasSubstr("\nfly-to "));
  EXPECT_THAT(text, HasSubstr("\ncustom-view 0.")) << "with its numbers, not as the scene is looked at";
  const auto expected = results(user, "first");
  ASSERT_EQ(user.session().records.size(), 2u);
  ASSERT_TRUE(expected.contains("map.ot"));

  User again(tiny_scan(), 320, 200, 0.25);
  again.window().play_demo(read_demo(file()).calls);
  again.wait();
  const auto replayed = results(again, "second");
  for (const auto& [name, content] : expected)
    EXPECT_TRUE(replayed.contains(name) && replayed.at(name) == content) << name << " differs";
  EXPECT_EQ(replayed.size(), expected.size());
  const Pose drawn = user.window().scene().camera_pose(), replayed_camera = again.window().scene().camera_pose();
  EXPECT_GT(drawn.linear().col(2).dot(replayed_camera.linear().col(2)), 0.99999) << "it looks elsewhere: " << text;
  // How near the object is framed depends on the window, which has a strip for captions now.
  EXPECT_LT((drawn.translation() - replayed_camera.translation()).norm(), 0.1 * drawn.translation().norm());
}

/// When somebody pauses is told by no script: the views are.
TEST_F(Recordings, PlayedViewsAreSteps) {
  User user(tiny_scan(), 320, 200, 0.25);
  user.window().record(file());
  user.window().ask(parse_call("play"));
  while (user.session().records.size() < 2) user.window().draw(0.01);
  user.window().ask(parse_call("set planner.gain random"));
  while (user.session().records.size() < 4) user.window().draw(0.01);
  user.window().ask(parse_call("pause"));
  user.wait();
  user.window().stop_recording();
  const std::string text = read_file(file());
  EXPECT_EQ(text.find("\nplay"), text.npos) << text;
  EXPECT_EQ(text.find("pause\n"), text.npos) << text;
  User again(tiny_scan(), 320, 200, 0.25);
  again.window().play_demo(read_demo(file()).calls);
  again.wait();
  const auto views = [](User& who) {
    std::vector<int> taken;
    for (const StepRecord& record : who.session().records) taken.push_back(record.view);
    return taken;
  };
  EXPECT_EQ(views(again), views(user)) << text;
  EXPECT_EQ(again.session().message, "");
}

TEST_F(Recordings, PlayHeadlessInTheTimeThatTheyTook) {
  {
    User user(tiny_scan(), 640, 400, 0.5);
    user.window().record(file());
    work(user);
    user.window().stop_recording();
  }
  int frames = 0;
  play_demo(read_demo(file()), {{160, 90}, 4}, [&](const Image&, int number) { frames = number; });
  EXPECT_GE(frames, 4 * 5)
      << "1.5 s of looking, a drag of 0.8 s and 0.5 s, and six times 0.47 s until it is drawn well";
  EXPECT_LE(frames, 4 * 8) << read_file(file());
}

TEST_F(Recordings, BeginAnyTimeAndSayWhatIsWrong) {
  User user(tiny_scan(), 320, 200, 0.25);
  user.run("step\nset termination.views 7\n");
  std::vector<std::string> reasons;
  user.window().script().set_on_failure([&](const ScriptFailure& failure) { reasons.push_back(failure.reason); });
  user.run("record /no/such/folder/a.nextview\nrecord a.txt\nrecord-stop\n");
  EXPECT_EQ(reasons.size(), 3u);
  user.run("record \"" + file() + "\"\nstep\n");
  user.run("play-demo\n");
  EXPECT_EQ(reasons.size(), 4u) << "while one runs";
  fs::remove(file());
  fs::create_directories(file());
  user.run("record-stop\n");
  EXPECT_EQ(reasons.size(), 5u) << "its file cannot be written any more";
  const std::string elsewhere = (folder_ / "elsewhere.nextview").string();
  user.run("record \"" + elsewhere + "\"\n");
  user.window().stop_recording();
  User again(tiny_scan(), 320, 200, 0.25);
  again.window().play_demo(read_demo(elsewhere).calls);
  again.wait();
  EXPECT_EQ(again.session().records.size(), 2u);
  EXPECT_EQ(again.session().configuration.termination.views, 7);
}

/// Played from the menu, a demo begins with nothing, and leaves an operator who can go on.
TEST_F(Recordings, AreListedAndPlayedInTheWindowInPlaceOfWhatIsShown) {
  write_file(folder_ / "tiny.toml", to_toml(tiny_scan()));
  write_file(folder_ / "demo.nextview",
             "open \"" + (folder_ / "tiny.toml").string() +
                 "\"\ntoggle-octree\nstep\nwait 0.5\nassert views 1\nassert surface-left < 1\n");
  User user(tiny_scan(), 320, 200, 0.25);
  user.run("step\nstep\ntoggle-octree\nset planner.gain random\n");
  user.run("play-demo \"" + (folder_ / "demo.nextview").string() + "\"\n");
  EXPECT_EQ(user.session().records.size(), 1u);
  EXPECT_EQ(user.session().configuration.planner.gain, Configuration().planner.gain) << "settings are the default";
  EXPECT_FALSE(user.window().state().layers.octree) << "it was on before the demo's only toggle";
  EXPECT_FALSE(user.window().state().presentation.demo);
  EXPECT_EQ(user.session().message, "");
}

}  // namespace
}  // namespace nextview
