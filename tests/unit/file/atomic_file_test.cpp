#include "core/file/atomic_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <future>
#include <iterator>
#include <sstream>

#include "tests/unit/file/file_size_limit.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class AtomicFileTest : public testing::Test {
 protected:
  AtomicFileTest()
      : folder_(fs::temp_directory_path() / ("nextview_file_" + std::to_string(::getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~AtomicFileTest() override { fs::remove_all(folder_); }
  std::size_t files() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }

  fs::path folder_;
};

template <class Action>
std::string reason(Action action) {
  try {
    action();
    return "";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
}

std::string every_byte() {
  std::string bytes;
  for (int n = 0; n < 70'000; ++n) bytes += char(n * 7 + n / 256);
  return bytes;
}

TEST_F(AtomicFileTest, ReadsBackWhatWasWritten) {
  for (const std::string& content : {std::string(), std::string("x"), every_byte()}) {
    write_file(folder_ / "a", content);
    EXPECT_EQ(read_file(folder_ / "a"), content);
    EXPECT_EQ(files(), 1u);
  }
}

TEST_F(AtomicFileTest, ReplacesAnOlderFileOnlyOnCommit) {
  write_file(folder_ / "a", "old");
  {
    AtomicFile file(folder_ / "a");
    file.stream() << "new" << std::flush;
    EXPECT_EQ(read_file(folder_ / "a"), "old");
    file.commit();
    EXPECT_EQ(read_file(folder_ / "a"), "new");
  }
  EXPECT_EQ(read_file(folder_ / "a"), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, LeavesNothingBehindWithoutCommit) {
  write_file(folder_ / "a", "old");
  {
    AtomicFile file(folder_ / "a"), other(folder_ / "b");
    file.stream() << "half";
    other.stream() << "half";
  }
  EXPECT_EQ(read_file(folder_ / "a"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, NamesTheFileThatCannotBeWritten) {
  EXPECT_NE(reason([&] { write_file(folder_ / "no/such/a", "x"); }).find("no/such/a"), std::string::npos);
  fs::create_directories(folder_ / "taken");
  write_file(folder_ / "taken/inside", "x");
  EXPECT_NE(reason([&] { write_file(folder_ / "taken", "x"); }).find("taken"), std::string::npos);
  EXPECT_EQ(files(), 1u) << "a temporary file was left behind";
  EXPECT_EQ(read_file(folder_ / "taken/inside"), "x");
}

TEST_F(AtomicFileTest, AFullDiskLosesNothingAndIsReported) {
  write_file(folder_ / "a", "old");
  std::string why, why_small;
  {
    const FileSizeLimit limit(1000);
    why = reason([&] { write_file(folder_ / "a", every_byte()); });
    why_small = reason([&] { write_file(folder_ / "a", std::string(1001, 'x')); });  // fails in the last flush only
  }
  for (const std::string& text : {why, why_small})
    EXPECT_EQ(text, (folder_ / "a").string() + ": cannot be written: File too large");
  EXPECT_EQ(read_file(folder_ / "a"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, TwoWritersOfOneFileDoNotMix) {
  AtomicFile first(folder_ / "a"), second(folder_ / "a");
  first.stream() << std::string(5000, '1');
  second.stream() << std::string(3000, '2');
  first.commit();
  second.commit();
  EXPECT_EQ(read_file(folder_ / "a"), std::string(3000, '2'));
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, ReadingSaysWhatIsWrong) {
  EXPECT_NE(reason([&] { read_file(folder_ / "missing"); }).find("missing"), std::string::npos);
  EXPECT_NE(reason([&] { read_file(folder_); }), "");
  EXPECT_NE(reason([&] { read_file(""); }), "");
  write_file(folder_ / "a", std::string(100, 'x'));
  EXPECT_EQ(read_file(folder_ / "a", 100).size(), 100u);
  EXPECT_NE(reason([&] { read_file(folder_ / "a", 99); }).find("a"), std::string::npos);
}

TEST_F(AtomicFileTest, AFileWithoutASizeOfItsOwnIsReadAndADeviceRefused) {
  EXPECT_THAT(read_file("/proc/self/status"), HasSubstr("VmRSS"));  // claims size 0
  EXPECT_THAT(reason([] { read_file("/dev/zero"); }), HasSubstr("device"));
}

TEST_F(AtomicFileTest, APipeThatNobodyWritesToIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(reason([&] { read_file(folder_ / "pipe"); }), HasSubstr("pipe"));
}

TEST_F(AtomicFileTest, LinksInACircleAreSaidToBeThat) {
  fs::create_symlink("b", folder_ / "a");
  fs::create_symlink("a", folder_ / "b");
  EXPECT_THAT(reason([&] { read_file(folder_ / "a"); }), HasSubstr("symbolic links"));
  EXPECT_THAT(reason([&] { write_file(folder_ / "a", "x"); }), HasSubstr("symbolic links"));
  EXPECT_TRUE(is_there(folder_ / "a"));
  EXPECT_FALSE(is_there(folder_ / "c"));
}

TEST_F(AtomicFileTest, ALinkStaysAndWhatItPointsToIsWritten) {
  fs::create_directory(folder_ / "elsewhere");
  fs::create_symlink("elsewhere", folder_ / "folder");
  fs::create_symlink("folder/real", folder_ / "link");
  fs::create_symlink("link", folder_ / "link_to_link");
  for (const char* content : {"made by it", "replaced by it"}) {
    write_file(folder_ / "link_to_link", content);
    EXPECT_TRUE(fs::is_symlink(folder_ / "link_to_link"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    EXPECT_FALSE(fs::is_symlink(folder_ / "elsewhere/real"));
    EXPECT_EQ(read_file(folder_ / "elsewhere/real"), content);
  }
}

TEST_F(AtomicFileTest, AStreamIsWrittenToAndStays) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", folder_ / "link");
  for (const char* name : {"pipe", "link"}) {
    auto got = std::async(std::launch::async, [&] {
      std::ifstream in(folder_ / "pipe");
      return std::string(std::istreambuf_iterator<char>(in), {});
    });
    write_file(folder_ / name, every_byte());
    if (!fs::is_fifo(folder_ / "pipe")) std::ofstream(folder_ / "pipe", std::ios::app);  // lets the reader end
    EXPECT_EQ(got.get(), every_byte());
    EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  }
  EXPECT_EQ(files(), 2u);
}

TEST_F(AtomicFileTest, AFullDeviceIsReportedAndStays) {
  fs::create_symlink("/dev/full", folder_ / "full");  // not the device itself: who replaces it breaks the machine
  EXPECT_EQ(reason([&] { write_file(folder_ / "full", "x"); }),
            (folder_ / "full").string() + ": cannot be written: No space left on device");
  EXPECT_TRUE(fs::is_symlink(folder_ / "full"));
  EXPECT_TRUE(fs::is_character_file(folder_ / "full"));
}

TEST_F(AtomicFileTest, AnOpenFileOfThisProcessIsWrittenTo) {
  std::ofstream(folder_ / "a") << "before, ";
  const Descriptor open(::open((folder_ / "a").c_str(), O_WRONLY));
  fs::create_symlink("/proc/self/fd/" + std::to_string(open.get()), folder_ / "link");  // as /dev/stdout is one
  write_file(folder_ / "link", "and after");
  EXPECT_EQ(read_file(folder_ / "a"), "before, and after");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
}

TEST_F(AtomicFileTest, PermissionsOfAReplacedFileStayAndTheUmaskRulesANewOne) {
  const auto permissions = [&](const char* name) {
    struct stat status {};
    EXPECT_EQ(::stat((folder_ / name).c_str(), &status), 0);
    return status.st_mode & 07777;
  };
  const mode_t before = ::umask(027);
  write_file(folder_ / "new", "x");
  EXPECT_EQ(permissions("new"), 0640u);
  for (const mode_t mode : {0600u, 0666u, 0755u}) {
    ::chmod((folder_ / "new").c_str(), mode);
    write_file(folder_ / "new", "y");
    EXPECT_EQ(permissions("new"), mode);
  }
  ::umask(before);
}

TEST_F(AtomicFileTest, WhatAKilledWriterLeavesIsRemovedAndNothingElse) {
  const fs::path mine = folder_ / "mine";
  fs::create_directory(mine);
  const auto abandon_one = [&] {
    const pid_t child = ::fork();
    if (child == 0) {
      AtomicFile file(mine / "a");
      file.stream() << "half" << std::flush;
      ::kill(::getpid(), SIGKILL);
    }
    ::waitpid(child, nullptr, 0);
  };
  const auto names = [&] {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(mine)) all.push_back(entry.path().filename());
    return all;
  };
  abandon_one();
  ASSERT_EQ(names().size(), 1u);
  const fs::path abandoned = mine / names().front();
  EXPECT_EQ(reason([&] { read_file(abandoned); }), "");
  // Names that look alike, and a link of the very name, are somebody else's.
  const std::string letters(32, 'a');
  for (const std::string& name :
       {std::string(".nextview-123.part"), ".nextview-" + letters + ".par", std::string("b.part")})
    std::ofstream(mine / name) << "kept";
  std::ofstream(folder_ / "victim") << "kept";
  fs::create_symlink(folder_ / "victim", mine / (".nextview-" + letters + ".part"));
  AtomicFile being_written(mine / "c");
  being_written.stream() << "c" << std::flush;
  EXPECT_FALSE(fs::exists(abandoned));
  const auto others = names().size();
  remove_abandoned_temporary_files(mine);
  EXPECT_EQ(names().size(), others) << "of what is being written, and of others, nothing goes";
  EXPECT_EQ(others, 5u);
  being_written.commit();
  EXPECT_EQ(read_file(mine / "c"), "c");
  EXPECT_EQ(read_file(folder_ / "victim"), "kept");
}

TEST_F(AtomicFileTest, AFolderIsTriedWithoutTouchingWhatIsInIt) {
  ASSERT_EQ(::mkfifo((folder_ / "writable").c_str(), 0600), 0);  // a name that was once tried
  EXPECT_EQ(reason([&] { require_writable_folder(folder_); }), "");
  EXPECT_EQ(files(), 1u);
  EXPECT_THAT(reason([&] { require_writable_folder(folder_ / "none"); }), HasSubstr("No such file or directory"));
}

}  // namespace
}  // namespace nextview
