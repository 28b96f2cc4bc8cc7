// Whatever name is given to read, the program neither waits for it nor takes all memory for it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>

#include "tests/integration/program.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class UnboundedInput : public ::testing::Test {
 protected:
  /// Every argument that takes a file, with this one.
  std::vector<std::string> readers(const std::string& file) const {
    const std::string out = " --no-pictures --out " + (folder_.path() / "out").string() + " ", scan = "scan box" + out;
    return {scan + "--views.layout file --views.file " + file,
            scan + "--config " + file,
            scan + "--sensor " + file,
            "scan" + out + file,
            "score --scene " + file,
            "refine" + out + file,
            "window box --script " + file};
  }
  void expect_refused(const fs::path& file, const std::string& words) {
    for (const std::string& arguments : readers(file.string())) {
      const Result run = nextview_behind("timeout --signal=KILL 60", arguments);
      EXPECT_EQ(run.exit_code, 2) << arguments;
      EXPECT_THAT(run.err, HasSubstr(words)) << arguments;
      EXPECT_THAT(run.err, HasSubstr(file.string())) << arguments;
      EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
  }

  TemporaryFolder folder_;
};

TEST_F(UnboundedInput, APipeIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo((folder_.path() / "pipe").c_str(), 0600), 0);
  expect_refused(folder_.path() / "pipe", "pipe");
}

TEST_F(UnboundedInput, ADeviceIsNotReadWithoutEnd) { expect_refused("/dev/zero", "device"); }

TEST_F(UnboundedInput, LinksInACircleAreSaidToBeThat) {
  fs::create_symlink("b", folder_.path() / "a");
  fs::create_symlink("a", folder_.path() / "b");
  expect_refused(folder_.path() / "a", "Too many levels of symbolic links");
}

TEST_F(UnboundedInput, AFileOfViewsMayNotBeEndless) {
  const fs::path file = folder_.path() / "views.txt";
  std::ofstream(file) << "1\n";
  fs::resize_file(file, std::uintmax_t{1} << 40);  // takes no room on the disk
  const Result run = nextview("scan box --no-pictures --views.layout file --views.file " + file.string() + " --out " +
                              (folder_.path() / "out").string());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("views.txt: has 1099511627776 bytes; at most"));
}

}  // namespace
}  // namespace nextview
