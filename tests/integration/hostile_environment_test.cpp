// No path, no variable and no file in the working folder decides what code runs.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// One view with its picture, which is drawn headless: the program starts itself again for it.
const char* const drawn_scan =
    "scan box --views 1 --no-surfaces --sensor.width 80 --sensor.height 60 --map.resolution 0.04 --overwrite --out ";

class HostileEnvironment : public ::testing::Test {
 protected:
  /// The program, its library and its files, in a folder of this name.
  fs::path installed_in(const std::string& name) {
    const fs::path program = NEXTVIEW_PROGRAM, folder = folder_.path() / name;
    fs::create_directories(folder);
    for (const fs::path& file : {program, program.parent_path() / "libnextview_headless_gl.so"}) {
      std::error_code other_disk;
      fs::create_hard_link(file, folder / file.filename(), other_disk);
      if (other_disk) fs::copy(file, folder / file.filename());
    }
    if (!fs::exists(folder / "share")) fs::create_directory_symlink(program.parent_path() / "share", folder / "share");
    return folder / program.filename();
  }
  void plant(const fs::path& name) {
    fs::create_directories((working_folder() / name).parent_path());
    fs::copy(NEXTVIEW_PLANTED, working_folder() / name);
  }
  fs::path working_folder() {
    fs::create_directories(folder_.path() / "work");
    return folder_.path() / "work";
  }
  Result scan(const std::string& program, const std::string& variables = "") {
    return nextview_behind(
        fmt::format(R"(sh -c 'cd "{}" && {} exec "{}" "$@"')", working_folder().string(), variables, program),
        drawn_scan + (folder_.path() / "out").string());
  }
  bool planted_was_loaded() { return fs::exists(working_folder() / "planted_was_loaded"); }

  TemporaryFolder folder_;
};

TEST_F(HostileEnvironment, FoldersOfAnyNameDoForTheProgram) {
  for (const char* name : {"two words", "a:b", "b c:d", "Größe 部品 🐇", "new\nline", "/"}) {
    const Result run = scan(installed_in(std::string("install ") + name));
    EXPECT_EQ(run.exit_code, 0) << name << run.err;
    EXPECT_EQ(run.err, "") << name;
    EXPECT_TRUE(fs::exists(folder_.path() / "out/step_01.png")) << name;
    fs::remove_all(folder_.path() / "out");
  }
}

TEST_F(HostileEnvironment, NothingIsLoadedFromTheWorkingFolder) {
  // Split at the blank or the colon, the rest of either path is relative.
  const std::string library = "libnextview_headless_gl.so";
  plant("planted/" + library);
  for (const char* name : {"a planted", "a:planted"}) {
    const Result run = scan(installed_in(name));
    EXPECT_FALSE(planted_was_loaded()) << name;
    EXPECT_EQ(run.exit_code, 0) << name << run.err;
  }
  plant(library);
  EXPECT_EQ(scan(installed_in("b .")).exit_code, 0);
  EXPECT_FALSE(planted_was_loaded());
}

TEST_F(HostileEnvironment, ThePlantedLibraryWouldTell) {
  plant("planted.so");
  const Result run = scan(NEXTVIEW_PROGRAM, "LD_PRELOAD=./planted.so");  // that is asked for
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(planted_was_loaded());
}

TEST_F(HostileEnvironment, VariablesOfAnotherRunMeanNothing) {
  plant("planted.so");
  for (const char* guard : {"1", "1 3", "", "999999999 3"}) {
    const Result run =
        scan(NEXTVIEW_PROGRAM, fmt::format("NEXTVIEW_HEADLESS=\"{}\" NEXTVIEW_SAVED_LD_PRELOAD=./planted.so", guard));
    EXPECT_EQ(run.exit_code, 0) << guard << run.err;
    EXPECT_EQ(run.err, "") << guard;
    EXPECT_FALSE(planted_was_loaded());
  }
}

TEST_F(HostileEnvironment, WhatItStartsHasTheEnvironmentThatWasThere) {
  const fs::path seen = folder_.path() / "seen", driver = folder_.path() / "driver.sh";
  write_file(driver, "env > '" + seen.string() + "'\n");
  const std::string out = (folder_.path() / "out").string();
  const Result run =
      nextview_behind("env ASAN_OPTIONS=detect_leaks=0", "scan --driver 'sh " + driver.string() + "' --out " + out);
  EXPECT_EQ(run.exit_code, 2) << "that is no driver";
  const std::string variables = read_file(seen);
  EXPECT_THAT(variables, HasSubstr("ASAN_OPTIONS=detect_leaks=0\n"));
  for (const char* own : {"LD_PRELOAD", "NEXTVIEW_HEADLESS", "NEXTVIEW_SAVED"})
    EXPECT_THAT(variables, ::testing::Not(HasSubstr(own)));
}

TEST_F(HostileEnvironment, AMissingLibraryIsNamed) {
  const fs::path program = installed_in("bare");
  fs::remove(program.parent_path() / "libnextview_headless_gl.so");
  const Result run = scan(program);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("bare/libnextview_headless_gl.so: No such file or directory"));
}

}  // namespace
}  // namespace nextview
