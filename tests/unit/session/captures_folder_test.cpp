#include "core/session/captures_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <ctime>

#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// What a process leaves that is killed with captures in hand.
fs::path left_behind(const fs::path& temporary) {
  const pid_t child = ::fork();
  if (child == 0) {
    CapturesFolder folder(temporary);
    fs::create_directories(folder.next());
    ::kill(::getpid(), SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  return fs::directory_iterator(temporary)->path();
}

void make_old(const fs::path& folder) {
  const timespec then{std::time(nullptr) - 3600, 0};
  const timespec times[2] = {then, then};
  ASSERT_EQ(::utimensat(AT_FDCWD, folder.c_str(), times, 0), 0);
}

TEST(CapturesFolder, GoesWithItsProcessAndWhatAKilledOneLeftGoesWithTheNext) {
  const TemporaryFolder temporary;
  const fs::path left = left_behind(temporary.path());
  {
    CapturesFolder folder(temporary.path()), another(temporary.path());
    const fs::path one = folder.next();
    EXPECT_NE(one, folder.next());
    EXPECT_NE(one, another.next());
    struct stat status {};
    ASSERT_EQ(::stat(one.parent_path().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0700u) << "nobody else sees captures";
    make_old(one.parent_path());
    const CapturesFolder next(temporary.path());
    EXPECT_TRUE(fs::exists(one.parent_path())) << "its process goes on";
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(temporary.path()), {}), 1);
  EXPECT_TRUE(fs::exists(left)) << "it may have been made just now";
  make_old(left);
  fs::create_directory(temporary / "other");
  fs::create_directory_symlink(temporary / "other", temporary / "nextview-captures-link");
  { const CapturesFolder next(temporary.path()); }
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(temporary / "other")) << "what a link leads to is no folder of ours";
}

}  // namespace
}  // namespace nextview
