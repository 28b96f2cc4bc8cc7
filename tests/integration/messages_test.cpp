// One line that names the thing, the reason and what to do.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Messages : public ::testing::Test {
 protected:
  std::string in(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(in(name), std::ios::binary) << content;
    return in(name);
  }
  std::string scan() const { return "scan box --no-pictures --out " + in("out") + " "; }
  /// What it says on standard error, which is one line, before it ends with 2.
  static std::string complaint(const std::string& arguments) {
    const Result run = nextview(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  }
  static std::string line(const std::string& reason) { return "nextview: " + reason + "\n"; }

  TemporaryFolder folder_;
};

TEST_F(Messages, ARangeErrorInAFileNamesFileLineAndKey) {
  const auto with = [&](const std::string& content) {
    return complaint(scan() + "--config " + write("c.toml", content));
  };
  const std::string file = in("c.toml");
  EXPECT_EQ(with("seed = 1\n[sensor]\nrange_noise = 5\n"),
            line(file + ":3: sensor.range_noise must be from 0 to 1 m, not 5 m"));
  EXPECT_EQ(with("[map]\n\nhit = 0.2\n"), line(file + ":3: map.hit must be over 0.5 and below 1, not 0.2"));
  EXPECT_EQ(with("[cloud]\noutlier_neighbours = 0\n"),
            line(file + ":2: cloud.outlier_neighbours must be from 1 to 1000, not 0"));
  EXPECT_EQ(with("[termination]\nviews = 0\n"), line(file + ":2: termination.views must be from 1 to 10000, not 0"));
  EXPECT_EQ(with("[map]\nhit = \"0.8\"\n"), line(file + ":2: map.hit takes a number, without quotes"));
  EXPECT_EQ(with("[views]\ncount = -1\n"), line(file + ":2: views.count must be from 1 to 10000, not -1"));
  EXPECT_EQ(with("[gibbs]\neta_hit = 0\n"), line(file + ":2: gibbs.eta_hit must be over 0 and at most 1000, not 0"));
  EXPECT_EQ(with("[planner]\nray_rows = 0\n"), line(file + ":2: planner.ray_rows must be from 1 to 2000, not 0"));
  // The bound that is not kept is of another setting than the one that the file gives.
  EXPECT_EQ(with("[sensor]\nmax_range = 0.01\n"),
            line(file + ":2: sensor.min_range, 0.2 m, must be at most sensor.max_range, 0.01 m"));
  EXPECT_EQ(with("[map]\nregion_edge = 100\n"),
            line(file + ":2: map.region_edge / map.resolution must be from 1 to 1024 voxels, not 10000: make voxels "
                        "98 mm or larger"));
}

TEST_F(Messages, OfSeveralFilesTheOneIsNamedThatGaveTheSetting) {
  const std::string good = write("good.toml", "[sensor]\nrange_noise = 0.01\n");
  const std::string bad = write("bad.toml", "[sensor]\n\nwidth = 0\n");
  EXPECT_EQ(complaint(scan() + "--config " + bad + " --config " + good),
            line(bad + ":3: sensor.width must be from 1 to 16384 px, not 0"));
  EXPECT_EQ(complaint(scan() + "--sensor " + write("lidar.toml", "[sensor]\ndropout = 2\n")),
            line(in("lidar.toml") + ":2: sensor.dropout must be from 0 to 1, not 2"));
  // What one file leaves wrong another may mend.
  const std::string far = write("far.toml", "[sensor]\nmin_range = 7\n"),
                    farther = write("farther.toml", "[sensor]\nmax_range = 9\n");
  EXPECT_THAT(complaint(scan() + "--config " + far), HasSubstr("far.toml:2: sensor.min_range, 7 m, must"));
  EXPECT_THAT(complaint(scan() + "--config " + far + " --config " + farther + " --seed x"), HasSubstr("--seed"));
}

TEST_F(Messages, ARangeErrorOnTheCommandLineNamesTheOption) {
  EXPECT_EQ(complaint(scan() + "--sensor.range_noise 5"), line("--sensor.range_noise must be from 0 to 1 m, not 5 m"));
  EXPECT_EQ(complaint(scan() + "--views 0"), line("--views (termination.views) must be from 1 to 10000, not 0"));
  EXPECT_EQ(complaint(scan() + "--termination.views 0"), line("--termination.views must be from 1 to 10000, not 0"));
  EXPECT_EQ(complaint(scan() + "--views many"), line("--views (termination.views) takes a whole number, not 'many'"));
  EXPECT_EQ(complaint(scan() + "--sensor.max_range 0.01"),
            line("sensor.min_range, 0.2 m, must be at most --sensor.max_range, 0.01 m"));
  EXPECT_THAT(complaint(scan() + "--sensor none"), HasSubstr("--sensor (sensor.preset): there is no sensor 'none'"));
  EXPECT_THAT(complaint(scan() + "--views 2 --termination.views 2"), HasSubstr("--views"));
  // The option is wrong, not the file that it overrides.
  EXPECT_EQ(
      complaint(scan() + "--config " + write("c.toml", "[sensor]\nrange_noise = 0.1\n") + " --sensor.range_noise 5"),
      line("--sensor.range_noise must be from 0 to 1 m, not 5 m"));
}

TEST_F(Messages, AnOptionThatIsBehindASettingIsNamedInItsPlace) {
  EXPECT_EQ(complaint("posterior --problem slot --prior 2"), line("--prior must be over 0 and below 1, not 2"));
  EXPECT_EQ(complaint("posterior --problem slot --sweeps 1"), line("--sweeps must be from 4 to 1000000, not 1"));
  EXPECT_EQ(complaint("posterior --problem slot --sigma 0"), line("--sigma must be over 0, not 0"));
}

TEST_F(Messages, OfTwoSettingsEachIsNamedAsItWasGiven) {
  const std::string near = write("near.toml", "[sensor]\nmax_range = 0.3\n"),
                    far = write("far.toml", "\nsensor.min_range = 0.4\n");
  EXPECT_EQ(complaint(scan() + "--config " + near + " --config " + far),
            line(far + ":2: sensor.min_range, 0.4 m, must be at most sensor.max_range (" + near + ":2), 0.3 m"));
  EXPECT_EQ(complaint(scan() + "--config " + near + " --sensor.min_range 0.4"),
            line(near + ":2: --sensor.min_range, 0.4 m, must be at most sensor.max_range, 0.3 m"));
}

TEST_F(Messages, AnObjectThatIsNotThereIsToldWithItsPlace) {
  const std::string missing = ": there is no such file, nor an object of this name that comes with the program";
  const std::string file = write("c.toml", "\n[object]\nfile = \"none.ply\"\n");
  const std::string bare = "scan --no-pictures --out " + in("out") + " ";
  EXPECT_EQ(complaint(bare + "--config " + file), line(file + ":3: object.file: none.ply" + missing));
  EXPECT_EQ(complaint(bare + "--object.file none.ply"), line("--object.file: none.ply" + missing));
  EXPECT_EQ(complaint(bare + "--config " + file + " other.ply"), line("other.ply" + missing));
}

TEST_F(Messages, WhatIsGivenTwiceEmptyOrInVainIsToldSo) {
  EXPECT_EQ(complaint(scan() + "--views 2 --views 3"),
            line("--views is given more than once; see nextview scan --help"));
  EXPECT_EQ(complaint(scan() + "--threads"), line("--threads is given no value; see nextview scan --help"));
  EXPECT_EQ(complaint("info ''"), line("PATH: is empty; give a name, or leave it out; see nextview info --help"));
  EXPECT_THAT(complaint("scan sphere --resume " + in("out")),
              HasSubstr("OBJECT and --resume do not go together: leave one of them out"));
  EXPECT_THAT(complaint(scan() + "--truth part.stl"), HasSubstr("only recorded scans are compared with a mesh"));
  EXPECT_THAT(complaint("--verion"), HasSubstr("did you mean '--version'?"));
  fs::create_symlink(in("loop.stl"), in("loop.stl"));
  EXPECT_EQ(complaint("info " + in("loop.stl")),
            line(in("loop.stl") + ": cannot be read: Too many levels of symbolic links"));
}

TEST_F(Messages, HelpTellsTheBounds) {
  const Result run = nextview("scan --help");
  EXPECT_THAT(run.out, HasSubstr("from 1 to 16384"));
  EXPECT_THAT(run.out, HasSubstr("--views"));
  EXPECT_THAT(run.out, HasSubstr("the same as --views"));
}

TEST_F(Messages, WhatStandsInFilesAndNamesIsQuoted) {
  const std::string nasty = "a\nb\x1b[31m\x9f.ply";
  EXPECT_EQ(
      complaint("scan --no-pictures --out " + in("out") + " '" + nasty + "'"),
      line("a\\nb\\x1b[31m\\x9f.ply: there is no such file, nor an object of this name that comes with the program"));
  EXPECT_THAT(complaint(scan() + "--config " + write("c.toml", "\"a\\u001b[2Jb\\nc\" = 1\n")),
              HasSubstr("there is no setting 'a\\x1b[2Jb\\nc'"));
  EXPECT_THAT(complaint(scan() + "--gain '\x1b]0;title\a'"), HasSubstr("\\x1b]0;title\\x07"));
  EXPECT_THAT(complaint("score --scene " + write("s.txt", "scan 0 0 0 0 0 0 1 1\n0 0 1\nparam \x1b[1m 1\n")),
              ::testing::Not(HasSubstr("\x1b")));
}

TEST_F(Messages, AWarningOutOfAFileIsQuoted) {
  const std::string scene = write("s.txt", "param b\x1b[1m 1\nscan 0 0 0 0 0 0 1 1\n0 0 0.3\nview 0 0 0 0 0 0 1\n");
  const Result run = nextview("score --gain occlusion-aware --scene " + scene);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, ::testing::StartsWith(scene + ": parameter b\\x1b[1m has no meaning here and is ignored\n"));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST_F(Messages, AMistypedCommandIsSaidToBeOne) {
  for (const auto& [typed, meant] :
       {std::pair{"scna", "scan"}, {"refien", "refine"}, {"windw", "window"}, {"bunnny", "bunny"}})
    EXPECT_EQ(complaint(std::string(typed) + " --threads 1"),
              line(fmt::format("no such command '{}', nor a file or an object of this name; did you mean '{}'? See "
                               "nextview --help",
                               typed, meant)));
  EXPECT_EQ(complaint("bogus-arg"),
            line("no such command 'bogus-arg', nor a file or an object of this name; see nextview --help"));
  EXPECT_THAT(complaint("--threads 2 scna"), HasSubstr("no such command 'scna'"));
  for (const char* object : {"box", "bunny", "slotted_plate"})
    EXPECT_THAT(complaint(object), HasSubstr("cannot open a window")) << "that is what a window is opened with";
  for (const char* file : {"none.ply", "no/such"})
    EXPECT_THAT(complaint(file), HasSubstr(std::string(file) + ": there is no such file")) << "before it is opened";
}

TEST_F(Messages, WhatIsTooMuchStandsAsItWasTypedWithTheOptionThatIsMeant) {
  EXPECT_EQ(complaint("scan one two three"), line("not expected: two three; see nextview scan --help"));
  for (const auto& [typed, meant] : {std::pair{"--veiws 3", "--views"},
                                     {"--view.count=3", "--views.count"},
                                     {"--noise 3", "--sensor.range_noise"},
                                     {"-seed 3", "--seed"},
                                     {"--no_picture", "--no-pictures"},
                                     {"--object.centered true", "--object.centred"},
                                     {"--thread 2", "--threads"}})
    EXPECT_THAT(complaint(scan() + typed),
                ::testing::EndsWith(fmt::format("; did you mean '{}'? See nextview scan --help\n", meant)))
        << typed;
  EXPECT_EQ(complaint("scan --fisrt 1 --last --threads 2 more"),
            line("not expected: --fisrt --last more; see nextview scan --help"));
}

TEST_F(Messages, OptionsOfTheProgramMayComeFirst) {
  const std::string box = NEXTVIEW_SOURCE_DIR "/assets/objects/box.ply";
  for (const char* threads : {"--threads 2 ", "--threads=2 "}) {
    for (const std::string& rest : {box, "--gain area-factor " + box, "window " + box, std::string()})
      EXPECT_THAT(complaint(threads + rest), HasSubstr("cannot open a window")) << rest;
    const Result run = nextview(threads + ("scan box --views 1 --no-surfaces --sensor.width 80 --sensor.height 60 "
                                           "--map.resolution 0.04 --out " +
                                           in("out")));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(fs::exists(in("out/step_01.png"))) << "drawn without a display";
    fs::remove_all(in("out"));
  }
  EXPECT_THAT(complaint("--threads"), HasSubstr("--threads"));
}

TEST_F(Messages, AScanThatWentWellSaysNothingOnStandardError) {
  const Result run = nextview(scan() + "--views 1 --sensor.width 80 --sensor.height 60 --map.resolution 0.04");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, ::testing::Not(HasSubstr(" done")));
}

TEST_F(Messages, AScanBeginsInItsWorkingVolume) {
  EXPECT_EQ(complaint(scan() + "--robot.working_volume '-2 -2 -2 2 2 0'"),
            line("--robot.working_volume: the start view lies outside of it; planner.start_view begins elsewhere"));
  EXPECT_FALSE(fs::exists(in("out")));
}

TEST_F(Messages, AnEmptyNameIsNotTakenForNone) {
  EXPECT_EQ(complaint("scan ''"), line("OBJECT: is empty; give a name, or leave it out; see nextview scan --help"));
  EXPECT_EQ(complaint("scan box --out ''"),
            line("--out: is empty; give a name, or leave it out; see nextview scan --help"));
}

TEST_F(Messages, ANumberOrWordThatIsNotTakenIsToldWithThoseThatAre) {
  EXPECT_EQ(complaint("export out turntable frames --frames 1"),
            line("--frames: takes a whole number from 2 to 3600, not '1'; see nextview export --help"));
  EXPECT_EQ(complaint("demo --fps 2.5"),
            line("--fps: takes a whole number from 1 to 120, not '2.5'; see nextview demo --help"));
  EXPECT_EQ(complaint("figure all --dpi high"),
            line("--dpi: takes a number from 48 to 600, not 'high'; see nextview figure --help"));
  EXPECT_EQ(complaint("calibrate --fit map"),
            line("--fit: takes sensor-model or new-surface, not 'map'; see nextview calibrate --help"));
  EXPECT_EQ(complaint("refine out --voxel -1"),
            line("--voxel: takes 0 or from 0.1 mm to 1 m, not '-1'; see nextview refine --help"));
  EXPECT_EQ(complaint("refine out --voxel '10 um'"),
            line("--voxel: takes 0 or from 0.1 mm to 1 m, not '10 um'; see nextview refine --help"));
  EXPECT_EQ(complaint("refine out --stand-off 1cm5"),
            line("--stand-off: takes from 10 mm to 100 m, not '1cm5'; see nextview refine --help"));
  EXPECT_EQ(complaint("driver real"), line("not expected: real; see nextview driver --help"));
  EXPECT_EQ(complaint("driver"), line("driver: simulated is missing: nextview driver simulated OBJECT"));
}

TEST_F(Messages, AConfigurationThatIsNotThereIsToldWithThoseThatAre) {
  EXPECT_EQ(complaint("scan box --config mine"),
            line("--config: there is no file 'mine'; those that come with the program are calibrated, new_surface, "
                 "paper, published_bunny"));
  EXPECT_EQ(complaint("scan box --config papr"), line("--config: there is no file 'papr'; did you mean 'paper'?"));
  EXPECT_EQ(complaint("scan box --config /tmp"),
            line("--config: /tmp is a folder; that of a session is given as /tmp/config.toml"));
}

TEST_F(Messages, WhatIsMeantByAMistypedNameIsGuessed) {
  EXPECT_THAT(complaint("scan bunnny --out " + in("out")), HasSubstr("; did you mean 'bunny'?"));
  EXPECT_THAT(complaint(scan() + "--sensor narow"), HasSubstr("there is no sensor 'narow'; did you mean 'narrow'?"));
  EXPECT_THAT(complaint("posterior --problem corridoor"), HasSubstr("; did you mean 'corridor'?"));
  EXPECT_THAT(complaint("driver simulatd box"),
              HasSubstr("not expected: simulatd box; did you mean 'simulated'? See nextview driver --help"));
  write("part.stl", "");
  EXPECT_THAT(complaint("info " + in("prat.stl")), HasSubstr("; did you mean '" + in("part.stl") + "'?"));
  ASSERT_EQ(nextview("scan box --no-pictures --no-surfaces --views 1 --sensor.width 40 --sensor.height 30 "
                     "--map.resolution 0.04 --out " +
                     in("mine"))
                .exit_code,
            0);
  for (const std::string command : {"score ", "scan --resume "})
    EXPECT_EQ(complaint(command + in("mien")),
              line(in("mien") + ": there is no such folder; did you mean '" + in("mine") + "'?"));
}

TEST_F(Messages, ANameThatIsTooLongAndAFolderThatIsLockedAreToldAsSuch) {
  EXPECT_THAT(complaint("scan box --no-pictures --out " + in(std::string(300, 'a'))),
              HasSubstr("cannot be made a folder: File name too long; give a shorter one\n"));
  EXPECT_EQ(nextview("scan box --no-pictures --out /dev/null/f").out, "") << "before the object is prepared";
  const std::string locked = in("locked");
  fs::create_directory(locked);
  fs::permissions(locked, fs::perms::none);
  fs::permissions(folder_.path(), fs::perms::all);
  const std::string user = ::geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups" : "";
  for (const std::string& command :
       {std::string("scan --resume "), std::string("score "), "study --out " + in("out") + " --merge ",
        "figure gap_closed --out " + in("out") + " --study "}) {
    const Result run = nextview_behind(user, command + locked);
    EXPECT_EQ(run.exit_code, 2) << command;
    EXPECT_EQ(run.err,
              line(locked + ": cannot be read: Permission denied; its owner can let you read it (chmod a+rX)"));
  }
  fs::permissions(locked, fs::perms::owner_all);
}

TEST_F(Messages, AStudyIsToldFromAConfiguration) {
  const std::string study = NEXTVIEW_SOURCE_DIR "/assets/studies/smoke.toml",
                    configuration = write("c.toml", "[sensor]\nwidth = 80\n[map]\nresolution = 0.04\n");
  const std::string is_study = line(study + ": is a study, not a configuration; use `nextview study " + study + "`");
  EXPECT_EQ(complaint(scan() + "--config " + study), is_study);
  EXPECT_EQ(complaint("scan " + study + " --out " + in("out")), is_study);
  EXPECT_EQ(
      complaint("study " + configuration + " --out " + in("out")),
      line(configuration + ": is a configuration, not a study; use `nextview scan --config " + configuration + "`"));
  EXPECT_FALSE(fs::exists(in("out")));
}

TEST_F(Messages, AStudyThatIsNotThereIsToldWithThoseThatAre) {
  EXPECT_EQ(complaint("study mine --out " + in("out")),
            line("mine: there is no such file; studies that come with the program are nextview, smoke"));
  EXPECT_EQ(complaint("study smok --out " + in("out")), line("smok: there is no such file; did you mean 'smoke'?"));
  EXPECT_FALSE(fs::exists(in("out")));
}

TEST_F(Messages, WhatHasNoRecordingIsToldByItsOption) {
  EXPECT_EQ(complaint("scan box --truth box"),
            line("--truth (recorded.truth): only recorded scans are compared with a mesh; give the recording, too "
                 "(--recorded), or leave it out"));
}

TEST_F(Messages, AFigureOfAStudyIsNotOfSessions) {
  EXPECT_EQ(complaint("figure gap_closed coverage_by_view --out " + in("figures")),
            line("figure gap_closed: is one of a study (--study DIR), not of 'coverage_by_view'"));
  EXPECT_FALSE(fs::exists(in("figures")));
}

}  // namespace
}  // namespace nextview
