#include "core/driver/driver_process.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <csignal>

#include "tests/unit/driver/fake_scanner.hpp"

namespace nextview {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using Received = DriverProcess::Received;

std::vector<std::string> shell(const std::string& script) { return {"sh", "-c", script}; }

std::optional<DriverProcess::Clock::time_point> in(double seconds) {
  return DriverProcess::Clock::now() +
         std::chrono::duration_cast<DriverProcess::Clock::duration>(std::chrono::duration<double>(seconds));
}

std::string line_of(DriverProcess& process) {
  std::string line;
  EXPECT_EQ(process.receive(line, in(5.0), {}), Received::line);
  return line;
}

std::string reason(const std::vector<std::string>& words) {
  try {
    DriverProcess process(words, {}, 0.1);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "it was started";
}

TEST(DriverProcess, AnswersByTheLine) {
  DriverProcess process(shell("while read -r line; do echo \"<$line>\"; done"), {}, 0.5);
  process.send("one");
  process.send("two words");
  EXPECT_EQ(line_of(process), "<one>");
  EXPECT_EQ(line_of(process), "<two words>");
  std::string line;
  EXPECT_EQ(process.receive(line, in(0.05), {}), Received::timed_out);
}

TEST(DriverProcess, LongLinesGoBothWays) {
  DriverProcess process({"cat"}, {}, 0.5);
  const std::string whole(5 << 20, 'x');
  process.send(whole);
  EXPECT_EQ(line_of(process), whole);
}

TEST(DriverProcess, WhatCannotBeStartedIsSaid) {
  const TemporaryFolder folder;
  EXPECT_THAT(reason({"no-such-scanner"}),
              AllOf(HasSubstr("no-such-scanner"), HasSubstr("no such program on the PATH")));
  EXPECT_THAT(reason({"/no/such/scanner"}), HasSubstr("there is no such file"));
  EXPECT_THAT(reason({folder.write("plain", "#!/bin/sh\n").string()}), HasSubstr("chmod +x"));
  const auto script = [&](const char* text) {
    const auto file = folder.write("script", text);
    ::chmod(file.c_str(), 0755);
    return file.string();
  };
  EXPECT_THAT(reason({script("#!/no/such/interpreter\n")}), HasSubstr("first line"));
  const std::string path = std::getenv("PATH");
  std::filesystem::copy_file(folder / "script", folder / "scanner-without-interpreter");
  ::setenv("PATH", (folder.path().string() + ":" + path).c_str(), 1);
  EXPECT_THAT(reason({"scanner-without-interpreter"}), HasSubstr("first line")) << "its name is right";
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(reason({script("echo hello\n")}), HasSubstr("no program"));
  EXPECT_THAT(reason({script("#!/bin/sh\n")}), HasSubstr("it was started"));
}

TEST(DriverProcess, ItsErrorsAreLoggedByTheLine) {
  std::mutex mutex;
  std::vector<std::string> lines;
  const auto log = [&](const std::string& line) {
    const std::lock_guard lock(mutex);
    lines.push_back(line);
  };
  {
    DriverProcess process(shell("echo one >&2; printf 't\\033wo\\n\\nthree' >&2; read line; exit 5"), log, 0.5);
    process.send("go");
    std::string line;
    EXPECT_EQ(process.receive(line, in(5.0), {}), Received::closed);
    EXPECT_THAT(process.end_reason(), HasSubstr("exit code 5; it last said: three"));
  }
  EXPECT_THAT(lines, ElementsAre("one", "t\\x1bwo", "three"));
}

TEST(DriverProcess, MayComplainAsMuchAsItLikes) {
  DriverProcess process(shell("yes complaint | head -c 3000000 >&2; echo done"), {}, 0.5);
  EXPECT_EQ(line_of(process), "done");
}

TEST(DriverProcess, InheritsNoFilesAndNoSignals) {
  const int open = ::open("/dev/null", O_RDONLY);  // without O_CLOEXEC
  ASSERT_GE(open, 0);
  auto* const before = std::signal(SIGUSR1, SIG_IGN);
  DriverProcess process(shell("echo $(ls /proc/$$/fd); kill -USR1 $$; echo alive"), {}, 0.5);
  EXPECT_THAT(line_of(process), HasSubstr("0 1 2"));
  std::string line;
  EXPECT_EQ(process.receive(line, in(5.0), {}), Received::closed);
  EXPECT_THAT(process.end_reason(), HasSubstr("signal 10"));
  std::signal(SIGUSR1, before);
  ::close(open);
}

TEST(DriverProcess, AStopWakesWithin50Milliseconds) {
  DriverProcess process({"cat"}, {}, 0.5);
  std::stop_source stop;
  const std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.request_stop();
  });
  const Seconds seconds;
  std::string line;
  EXPECT_EQ(process.receive(line, {}, stop.get_token()), Received::stopped);
  EXPECT_LT(seconds.passed(), 0.3);
}

TEST(DriverProcess, WhoDoesNotReadIsNoSignalOfOurs) {
  DriverProcess process(shell("exec 0<&-; echo deaf; sleep 30"), {}, 0.05);
  EXPECT_EQ(line_of(process), "deaf");
  process.send("hello?");
  std::string line;
  EXPECT_EQ(process.receive(line, in(5.0), {}), Received::closed);
  EXPECT_THAT(process.end_reason(), HasSubstr("closed its standard input"));
}

/// Whether a process is there and no zombie.
bool lives(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/stat");
  std::string number, name, state;
  return bool(status >> number >> name >> state) && state != "Z" && state != "X";
}

TEST(DriverProcess, EndsWithAllThatItStarted) {
  for (const std::string script :
       {"sleep 60 & echo $$ $!; wait", "trap '' TERM; sleep 60 & echo $$ $!; sleep 60; sleep 60",
        "sleep 60 >/dev/null & echo $$ $!"}) {
    pid_t parent = 0, child = 0;
    const Seconds seconds;
    {
      DriverProcess process(shell(script), {}, 0.1);
      std::istringstream(line_of(process)) >> parent >> child;
      ASSERT_GT(child, 0);
      EXPECT_TRUE(lives(child));
    }
    EXPECT_LT(seconds.passed(), 2.0);
    EXPECT_FALSE(lives(parent)) << script;
    for (int i = 0; i < 100 && lives(child); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_FALSE(lives(child)) << script;
  }
}

/// What has left the process group is not ours to end; its complaints are not waited for.
TEST(DriverProcess, DoesNotWaitForWhoHasLeft) {
  const Seconds seconds;
  {
    DriverProcess process(shell("setsid timeout 3 yes >&2 & echo started; sleep 60"), {}, 0.05);
    EXPECT_EQ(line_of(process), "started");
  }
  EXPECT_LT(seconds.passed(), 2.0);
}

TEST(DriverProcess, SaysByeBeforeItEnds) {
  const TemporaryFolder folder;
  const std::string file = (folder / "said").string();
  DriverProcess process(shell("read -r line; echo \"$line\" > '" + file + "'"), {}, 1.0);
  const Seconds seconds;
  process.end("bye");
  EXPECT_LT(seconds.passed(), 0.9) << "who goes at once is not waited for";
  std::string said;
  std::getline(std::ifstream(file) >> std::ws, said);
  EXPECT_EQ(said, "bye");
  EXPECT_TRUE(process.has_ended());
}

}  // namespace
}  // namespace nextview
