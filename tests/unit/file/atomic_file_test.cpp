#include "core/file/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <iterator>

namespace nextview {
namespace {

namespace fs = std::filesystem;

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

/// Files cannot grow over `bytes` while it lives: what a full disk does, without filling one.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_{};
  void (*old_handler_)(int);
};

TEST_F(AtomicFileTest, AFullDiskLosesNothingAndIsReported) {
  write_file(folder_ / "a", "old");
  std::string why, why_small;
  {
    const FileSizeLimit limit(1000);
    why = reason([&] { write_file(folder_ / "a", every_byte()); });
    why_small = reason([&] { write_file(folder_ / "a", std::string(1001, 'x')); });  // fails in the last flush only
  }
  EXPECT_NE(why.find((folder_ / "a").string()), std::string::npos) << why;
  EXPECT_NE(why_small, "");
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

TEST_F(AtomicFileTest, FilesWithoutASizeOfTheirOwnAreReadOrRefused) {
  // Files under /proc claim size 0; a device never ends.
  const std::string why = reason([&] { EXPECT_FALSE(read_file("/proc/self/status").empty()); });
  EXPECT_NE(reason([&] { read_file("/dev/zero", 1 << 20); }), "") << why;
}

}  // namespace
}  // namespace nextview
