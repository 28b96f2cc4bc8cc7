// Every command in the whole window, by script and at random.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "core/file/atomic_file.hpp"
#include "tests/integration/random_calls.hpp"
#include "tests/integration/small_scan.hpp"
#include "tests/integration/user.hpp"
#include "tests/integration/valid_session.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"

namespace nextview {
namespace {

// The window of 1280 x 800 at three eighths of its size: a software renderer takes its time for each pixel.
constexpr int small_width = 480, small_height = 300;
constexpr double small_scale = 0.375;

/// Likewise.
Configuration coarse_scan() {
  Configuration c = tiny_scan();
  c.planner.ray_columns = 8;
  c.planner.ray_rows = 6;
  c.gibbs.sampler.sweeps = 40;
  c.termination.views = 6;
  c.termination.surface_left = 0.0;
  return c;
}

/// A refinement that does not end by itself while a few frames are drawn: it is never tried whether so long a burn-in
/// is stationary.
constexpr const char* endless_refinement =
    "reset\nset gibbs.burn_in 50000\nstep\nstep\nrefine 1 100000\npause-refinement\nresume-refinement\ncancel\n"
    "reset-setting gibbs.burn_in";

/// A camera, a map or a sampler that would keep the tests waiting.
bool is_large(const Configuration& c) {
  return c.sensor.width * c.sensor.height > 100 * 80 || c.map.region_edge / c.map.resolution > 40 ||
         c.views.count > 30 || c.gibbs.sampler.sweeps > 60 || c.evaluation.surface_samples > 1000;
}

/// A candidate that is left, but not the next view.
std::size_t another(const SessionSnapshot& s) {
  std::size_t candidate = 0;
  while (!s.available(candidate) || candidate == s.next_candidate) ++candidate;
  return candidate;
}

// Every command, by the case that walks it.
using Names = std::vector<std::string>;
const Names scan_names = {
    // File and Scan
    "open", "set", "reset-setting", "export", "save-picture", "save-script", "quit", "step", "play", "pause", "speed",
    "take-view", "take-proposal", "take-custom-view", "cancel", "undo", "redo", "reset",
    // Gibbs and Select
    "refine", "pause-refinement", "resume-refinement", "select-view", "select-taken", "select-next", "custom-view",
    "look-through", "inspect-voxel", "inspect-ray", "clear-selection",
    // Scene and Layers
    "frame", "look-from", "zoom", "toggle-object", "toggle-cloud", "toggle-octree", "toggle-views", "toggle-rays",
    "toggle-region", "toggle-missed", "object-style", "cloud-colour", "voxel-map", "voxel-colour", "toggle-occupied",
    "toggle-unknown", "toggle-free", "toggle-uncertain", "threshold", "uncertain-from", "slice-axis", "slice-at",
    "lock-ranges",
    // Window and Help
    "panel", "curves", "forget-runs", "sort", "palette", "shortcuts"};
const Names timeline_names = {"previous-view", "next-view", "go-to-view",     "branch", "go-to-branch", "rename-branch",
                              "remove-branch", "compare",   "stop-comparing", "split",  "continue"};
const Names export_names = {"export-cloud",  "export-map",     "export-surface",  "export-views",
                            "export-curves", "export-picture", "export-turntable"};
const Names scene_names = {"standard-view",  "turn",         "toggle-orthographic", "keep-camera",  "go-to-camera",
                           "remove-camera",  "section-axis", "section-at",          "flip-section", "second-view",
                           "toggle-surface", "surface-of",   "surface-colour",      "edit-region",  "toggle-candidates",
                           "toggle-legends", "measure",      "measure-point"};
const Names window_names = {"dark",        "panel-sizes", "text-size", "hide-panels",
                            "full-screen", "file-dialog", "guide",     "manual"};
const Names demo_script_names = {"caption", "title",  "highlight", "orbit",      "fly-to",
                                 "wait",    "assert", "record",    "record-stop"};
const Names scanner_names = {"connect", "answer", "reconnect", "disconnect"};
/// They have tests of their own; the first makes a large scan.
const Names walked_elsewhere = {"reset-settings", "play-demo", "dismiss"};

class Commands : public InTemporaryFolder {
 protected:
  Commands() { write_file(folder_ / "tiny scan.toml", to_toml(coarse_scan())); }
  std::filesystem::path file(const char* name) const { return folder_ / name; }
  /// As a script has it.
  std::string path(const char* name) const { return '"' + file(name).string() + '"'; }

  /// Does these lines, each of which must be done, and looks at the window.
  void walk(User& user, const std::string& lines) {
    SCOPED_TRACE(lines);
    const std::size_t before = user.worker().log().told().count;
    for (const CommandCall& call : parse_script(lines)) walked_.insert(call.command->name);
    user.run_quickly(lines);
    const auto log = *user.worker().log().entries();
    for (std::size_t i = log.size() - (user.worker().log().told().count - before); i < log.size(); ++i)
      for (const CommandCall& call : parse_script(lines))
        EXPECT_FALSE(log[i].text.starts_with(call.command->name + ": ")) << log[i].text;
    EXPECT_EQ(user.session().message, "");
    EXPECT_EQ(user.target().gl_error(), 0u);
    expect_valid(user.session());
    expect_valid(user.window().state(), user.session());
  }

  /// One after the other, the window looked at after each.
  void walk_each(User& user, std::initializer_list<const char*> scripts) {
    for (const char* lines : scripts) walk(user, lines);
  }
  /// Likewise, each of these commands with each value that it can have.
  void walk_choices(User& user, std::initializer_list<const char*> names) {
    for (const char* command : names)
      for (const std::string& value : find_command(command).arguments().front().choices({}))
        walk(user, fmt::format("{} {}", command, value));
  }

  /// At the end of a case.
  void expect_walked(User& user, const Names& names) const {
    for (const std::string& name : names) EXPECT_TRUE(walked_.contains(name)) << name;
    expect_words_for_people(*user.worker().log().entries());
  }

  std::set<std::string> walked_;
};

TEST_F(Commands, EachIsDoneByAScript) {
  User user(coarse_scan(), small_width, small_height, small_scale);
  walk(user, "frame\nlook-from 30 20\nzoom 2\nstep\nstep\n");
  walk(user, fmt::format("select-view {}", another(user.session())));
  walk_each(user, {"take-view",
                   "take-proposal",
                   "custom-view",
                   "custom-view 0.6 -0.6 0.5 0 0 0",
                   "take-custom-view",
                   "look-through",
                   "select-next",
                   "select-taken 1",
                   "inspect-voxel 0.01 0.02 0.03",
                   "inspect-ray 5",
                   "clear-selection",
                   "step",
                   "undo",
                   "redo",
                   "refine 2 20",
                   "refine",
                   endless_refinement,
                   "toggle-object",
                   "toggle-cloud",
                   "toggle-octree",
                   "toggle-views",
                   "toggle-rays",
                   "toggle-region",
                   "toggle-missed",
                   "toggle-object",
                   "toggle-cloud",
                   "toggle-octree",
                   "toggle-views",
                   "toggle-rays",
                   "toggle-region",
                   "toggle-occupied",
                   "toggle-unknown",
                   "toggle-free",
                   "toggle-uncertain",
                   "toggle-free",
                   "threshold 0.4",
                   "uncertain-from 0.3",
                   "slice-axis y",
                   "slice-at 0.05",
                   "slice-at 0 0.1",
                   "slice-axis none",
                   "lock-ranges",
                   "panel log",
                   "sort gain ascending",
                   "palette",
                   "palette",
                   "palette \"two words\"",
                   "palette",
                   "shortcuts",
                   "shortcuts"});
  walk_choices(user, {"object-style", "cloud-colour", "voxel-map", "voxel-colour", "slice-axis", "panel"});
  for (const char* kind : {"entropy", "coverage", "divergence", "gain", "time"})
    walk(user, fmt::format("curves {} entropy", kind));
  walk(user, "export " + path("a scan") + "\n");
  walk(user, "save-picture " + path("a picture.png") + "\n");
  EXPECT_TRUE(std::filesystem::exists(file("a scan") / "steps.csv"));
  EXPECT_GT(std::filesystem::file_size(file("a picture.png")), 10'000u);
  walk(user, "reset\nspeed 0\nplay\npause\n");
  walk(user, "set planner.gain average-entropy\nstep\nreset-setting planner.gain\nforget-runs\n");
  walk(user, "open box\nopen " + path("tiny scan.toml") + "\nset termination.views 3\n");
  walk(user, "save-script " + path("a script.txt") + "\n");
  EXPECT_NO_THROW(parse_script(read_file(file("a script.txt"))));
  EXPECT_FALSE(user.window().wants_to_quit());
  user.run("quit\n");
  EXPECT_TRUE(user.window().wants_to_quit());
  walked_.insert("quit");
  expect_walked(user, scan_names);
}

TEST_F(Commands, EachOfTheTimelineIsDoneByAScript) {
  User user(coarse_scan(), small_width, small_height, small_scale);
  walk(user, "step\nstep\n");
  walk(user, "previous-view\nnext-view\ngo-to-view 1\nbranch \"what if\"\nrename-branch \"what if\" closer\nstep\n");
  walk(user,
       "go-to-branch main\nsplit closer\nprevious-view\nnext-view\ncompare closer\nstop-comparing\nremove-branch "
       "closer\n");
  walk(user, "set termination.views 1\ncontinue\nset termination.views 6");
  expect_walked(user, timeline_names);
}

TEST_F(Commands, EachThatExportsIsDoneByAScript) {
  User user(coarse_scan(), small_width, small_height, small_scale);
  walk(user, "step\nstep\n");
  for (const auto& [command, name] :
       {std::pair("export-cloud", "a cloud.ply"), std::pair("export-map", "a map.bt"),
        std::pair("export-surface", "a surface.stl"), std::pair("export-views", "some views.json"),
        std::pair("export-curves", "curves.svg"), std::pair("export-picture", "a scene.png")}) {
    walk(user, fmt::format("{} {}\n", command, path(name)));
    EXPECT_TRUE(std::filesystem::exists(file(name))) << name;
  }
  walk(user, "export-turntable " + path("a turn") + " 2 64x48\n");
  EXPECT_TRUE(std::filesystem::exists(file("a turn") / "frame_00002.png"));
  expect_walked(user, export_names);
}

TEST_F(Commands, EachOfTheSceneIsDoneByAScript) {
  User user(coarse_scan(), small_width, small_height, small_scale);
  walk(user, "step\nstep\n");
  walk_each(user, {"toggle-region", "edit-region", "edit-region", "toggle-region"});
  walk_choices(user, {"section-axis", "second-view", "surface-of", "surface-colour"});
  walk(user,
       "standard-view top\nturn 30 -10\ntoggle-candidates\ntoggle-candidates\ntoggle-legends\ntoggle-legends\nmeasure\n"
       "measure-point 0 0 0.1\nmeasure-point 0.1 0 0.1\nmeasure bore\nmeasure\n");
  walk(user,
       "toggle-surface\nsection-axis z\nsection-at 0.01\nflip-section\nsection-axis none\ntoggle-surface\n"
       "toggle-orthographic\nkeep-camera here\nturn 20 0\ngo-to-camera here\nremove-camera here\n"
       "toggle-orthographic\n");
  expect_walked(user, scene_names);
}

TEST_F(Commands, EachOfWindowAndDemosIsDoneByAScript) {
  User user(coarse_scan(), small_width, small_height, small_scale);
  walk(user, "step\nstep\n");
  walk(user, "dark\ndark\npanel-sizes 300 400 200\n");
  walk(user,
       "text-size bigger\nhide-panels\nhide-panels\ntext-size usual\nfull-screen\nfull-screen\n"
       "file-dialog export\nfile-dialog\nguide\nguide\n");
  walk(user,
       "caption \"Why? {reason}\" 0.1\ntitle Title Subtitle 0.1\nhighlight view 0.1\norbit 10 0.1 5\nfly-to 20 30 0.1 "
       "1.2\n"
       "wait 0.1\nwait until done\nassert views >= 1\ncaption \"\"\n");
  walk(user, "record " + path("a recording.nextview") + "\nmanual\nmanual planning\nmanual\nrecord-stop\n");
  expect_walked(user, window_names);
  expect_walked(user, demo_script_names);
}

TEST_F(Commands, EachOfAScannerIsDoneByAScript) {
  User user(coarse_scan(), small_width, small_height, small_scale);
  walk(user, "set map.region \"-1 -1 -0.5 1 1 1.5\"\nconnect \"'" NEXTVIEW_FAKE_DRIVER "' '" +
                 file("no_fault").string() + "'\"\nstep\nanswer Move\nreconnect\ndisconnect\n");
  walk(user, "open box\nopen " + path("tiny scan.toml") + "\n");  // after a scanner, a simulated camera again
  expect_walked(user, scanner_names);
}

/// What a case names and does not walk fails there; what no case names fails here.
TEST_F(Commands, EachIsNamedByACase) {
  std::set<std::string> named;
  for (const Names* names : {&scan_names, &timeline_names, &export_names, &scene_names, &window_names,
                             &demo_script_names, &scanner_names, &walked_elsewhere})
    for (const std::string& name : *names) EXPECT_TRUE(named.insert(name).second) << name << " is named twice";
  for (const Command& command : commands()) EXPECT_TRUE(named.contains(command.name)) << command.name;
}

/// This part of EachIsDoneByAScript once depended on how fast the machine was.
TEST_F(Commands, ARefinementThatIsCancelledSaysSo) {
  User user(coarse_scan(), small_width, small_height, small_scale);
  walk(user, endless_refinement);
  const auto log = *user.worker().log().entries();
  expect_words_for_people(log);
  EXPECT_EQ(std::ranges::count(log, "The refinement is cancelled: there is no Gibbs map yet", &LogEntry::text), 1);
}

TEST_F(Commands, AllSettingsGoBackAndTheObjectStays) {
  User user(coarse_scan(), small_width, small_height, small_scale);
  user.run_quickly("reset-settings\n");
  Configuration expected;
  expected.object = coarse_scan().object;
  EXPECT_EQ(to_toml(user.session().configuration), to_toml(expected));
  user.run_quickly("undo\n");
  EXPECT_EQ(to_toml(user.session().configuration), to_toml(coarse_scan()));
}

TEST_F(Commands, AScriptThatWasSavedDoesTheSame) {
  const std::string script = '"' + file("script.txt").string() + '"';
  User first(coarse_scan(), small_width, small_height, small_scale);
  first.run_quickly(
      "step\nstep\nselect-view 3\nzoom 1\nzoom 1\nslice-axis x\nslice-at 0.1 0.2\nslice-at 0.05\n"
      "set planner.combined_weights \"\"\nstep\ncustom-view 0.6 -0.6 0.5 0 0 0\ntake-custom-view\nstep\nundo\nstep\n"
      "inspect-ray 3\ninspect-voxel 0 0 0\nsave-script " +
      script + "\n");
  const std::string saved = read_file(file("script.txt"));
  User second(coarse_scan(), small_width, small_height, small_scale);
  second.run_quickly(saved);
  expect_valid(second.session());
  ASSERT_EQ(second.session().records.size(), first.session().records.size());
  for (std::size_t k = 0; k < first.session().records.size(); ++k) {
    EXPECT_EQ(first.session().records[k].view, second.session().records[k].view);
    EXPECT_EQ(first.session().records[k].entropy, second.session().records[k].entropy);
  }
  EXPECT_EQ(first.window().state().selection, second.window().state().selection);
  EXPECT_EQ(first.window().state().layers.voxels, second.window().state().layers.voxels);
  EXPECT_TRUE(first.window().scene().camera_pose().isApprox(second.window().scene().camera_pose(), 1e-9)) << saved;
}

/// NEXTVIEW_RANDOM_COMMANDS sets how many; five hundred were run (CHANGELOG).
TEST_F(Commands, AtRandomLeaveAValidSession) {
  const char* const wanted = std::getenv("NEXTVIEW_RANDOM_COMMANDS");
  const std::size_t count = wanted ? std::stoul(wanted) : 200;
  User user(coarse_scan(), small_width, small_height, small_scale);
  // Other commands: --gtest_random_seed.
  RandomCalls random(20240229 + std::uint64_t(GTEST_FLAG_GET(random_seed)), folder_, file("tiny scan.toml"));
  std::size_t done = 0, refused = 0, views = 0;
  while (done + refused < count) {
    for (std::size_t batch = 1 + random.below(12); batch-- > 0;) {
      const auto [command, values] = random.next(user.session());
      const bool key = random.below(5) == 0 && !command->shortcuts().empty();
      // The default scan is a large one.
      if (command->name.starts_with("reset-setting") && random.below(6) != 0) continue;
      try {
        CommandCall call = command->read(values);
        ++done;
        if (key) {
          const Shortcut shortcut = command->shortcuts().front();
          if (shortcut.control) user.window().push(input::KeyChange{Key::control, true});
          user.type(shortcut.key);
          if (shortcut.control) user.window().push(input::KeyChange{Key::control, false});
        } else {
          user.window().run_script({std::move(call)});
        }
      } catch (const std::invalid_argument& error) {
        ++refused;
        EXPECT_THAT(error.what(), testing::HasSubstr(command->name));
      }
    }
    user.wait();
    const SessionSnapshot& s = user.session();
    SCOPED_TRACE(fmt::format("after {} commands", done + refused));
    expect_valid(s);
    expect_valid(user.window().state(), s);
    EXPECT_EQ(user.target().gl_error(), 0u);
    ASSERT_FALSE(user.window().wants_to_quit());
    views += s.records.size();
    if (is_large(s.configuration)) user.run("open \"" + file("tiny scan.toml").string() + "\"\n");
    if (HasFailure()) break;
  }
  EXPECT_GT(refused, count / 50);
  EXPECT_GT(views, count / 20) << "there was hardly ever anything to work on";
  expect_words_for_people(*user.worker().log().entries());
  user.run("open \"" + file("tiny scan.toml").string() + "\"\nstep\n");
  EXPECT_EQ(user.session().records.size(), 1u);
  EXPECT_EQ(user.session().message, "");
  EXPECT_EQ(user.target().gl_error(), 0u);
}

}  // namespace
}  // namespace nextview
