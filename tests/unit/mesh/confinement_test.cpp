#include "core/mesh/confinement.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <functional>
#include <new>

#include "core/mesh/scene_transfer.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using namespace std::chrono_literals;

/// What a child has to say after confining itself.
std::string confined(const std::function<std::string()>& tries) {
  ReadingProcess process(
      [&](int pipe) {
        send_message(pipe, confine(pipe) ? tries() : "not confined");
        ::_exit(0);
      },
      60s, {});
  return receive_scene(process).message;
}

TEST(Confinement, aConfinedProcessReadsBelowItsFolderAndNothingElse) {
  if (!can_confine) GTEST_SKIP() << "built with sanitizers";
  const TemporaryFolder folder;
  const std::string victim = folder.write("victim.txt", "untouched"), fresh = folder / "fresh.txt";
  const int below = ::open(victim.substr(0, victim.rfind('/')).c_str(), O_PATH | O_DIRECTORY);
  ASSERT_GE(below, 0);
  const int writable = ::open(victim.c_str(), O_WRONLY);  // somebody left it open
  const pid_t parent = ::getpid();
  const std::string said = confined([&] {
    std::string list;
    const auto attempt = [&](const char* what, auto result) {
      list += std::string(what) + (result >= 0 ? " done; " : errno == EPERM ? " denied; " : " failed; ");
    };
    const auto path = victim.c_str();
    attempt("read below", ::openat(below, "victim.txt", O_RDONLY | O_NOFOLLOW));
    attempt("read", ::open(path, O_RDONLY));
    attempt("write below", ::openat(below, "victim.txt", O_WRONLY));
    attempt("change below", ::openat(below, "victim.txt", O_RDWR));
    attempt("cut below", ::openat(below, "victim.txt", O_RDONLY | O_TRUNC));
    attempt("create below", ::openat(below, "fresh.txt", O_RDONLY | O_CREAT, 0600));
    attempt("create", ::open(fresh.c_str(), O_WRONLY | O_CREAT, 0600));
    attempt("write into what is open", ::write(writable, "x", 1));
    attempt("truncate", ::truncate(path, 0));
    attempt("unlink", ::unlink(path));
    attempt("rename", ::rename(path, fresh.c_str()));
    attempt("link", ::link(path, fresh.c_str()));
    attempt("symlink", ::symlink(path, fresh.c_str()));
    attempt("mkdir", ::mkdir(fresh.c_str(), 0700));
    attempt("chmod", ::chmod(path, 0));
    attempt("socket", ::socket(AF_INET, SOCK_STREAM, 0));
    attempt("local socket", ::socket(AF_UNIX, SOCK_STREAM, 0));
    attempt("fork", ::fork());
    char* const none[] = {nullptr};
    attempt("exec", ::execve("/bin/true", none, none));
    attempt("signal", ::kill(parent, 0));
    attempt("make code",
            ::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED ? -1 : 0);
    return list;
  });
  ::close(below);
  ::close(writable);
  EXPECT_EQ(
      said,
      "read below done; read denied; write below denied; change below denied; cut below denied; create below "
      "denied; create denied; write into what is open denied; truncate denied; unlink denied; rename denied; link "
      "denied; symlink denied; mkdir denied; chmod denied; socket denied; local socket denied; fork denied; exec "
      "denied; signal denied; make code denied; ");
  std::ifstream in(victim);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "untouched");
  EXPECT_FALSE(std::filesystem::exists(fresh));
}

// Which holds without a filter of calls, too.
TEST(Confinement, aConfinedProcessOpensFewFilesAndMakesNoneLarger) {
  const TemporaryFolder folder;
  folder.write("one.txt", "1");
  const int below = ::open(folder.path().c_str(), O_PATH | O_DIRECTORY);
  ASSERT_GE(below, 0);
  ReadingProcess process(
      [&](int pipe) {
        confine(pipe);
        int opened = 0;
        while (opened < 1000 && ::openat(below, "one.txt", O_RDONLY) >= 0) ++opened;
        const int why = errno;
        rlimit largest{1, 1};
        ::getrlimit(RLIMIT_FSIZE, &largest);
        send_message(pipe, std::string(opened < 64 ? "few, " : "many, ") + (opened > 40 ? "enough, " : "too few, ") +
                               (why == EMFILE ? "then no more; " : "otherwise; ") + std::to_string(largest.rlim_cur));
        ::_exit(0);
      },
      60s, {});
  EXPECT_EQ(receive_scene(process).message, "few, enough, then no more; 0");
  ::close(below);
}

TEST(Confinement, abortIsStillADeathThatSaysWhat) {
  if (!can_confine) GTEST_SKIP() << "built with sanitizers";
  ReadingProcess process(
      [](int pipe) {
        ::signal(SIGABRT, SIG_DFL);
        confine(pipe);
        std::abort();
      },
      60s, {});
  EXPECT_EQ(receive_scene(process).kind, ReceivedScene::Kind::nothing);
  EXPECT_EQ(process.end().reason, "Aborted");
}

TEST(Confinement, memoryIsBoundedAndWidensWithWhatIsRead) {
  if (!can_confine) GTEST_SKIP() << "built with sanitizers";
  ReadingProcess process(
      [](int pipe) {
        limit_memory({.memory = 100u << 20, .companions = 100u << 20});
        confine(pipe);
        const auto takes = [](std::size_t megabytes) {
          void* memory = ::mmap(nullptr, megabytes << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
          if (memory == MAP_FAILED) return " no";
          ::munmap(memory, megabytes << 20);
          return " yes";
        };
        std::string said = std::string("90:") + takes(90) + ", 110:" + takes(110);
        allow_memory_for(1u << 20);
        said += std::string("; then 110:") + takes(110) + ", 500:" + takes(500);
        send_message(pipe, said);
        ::_exit(0);
      },
      60s, {});
  EXPECT_EQ(receive_scene(process).message, "90: yes, 110: no; then 110: yes, 500: no");
}

/// What a child that was taken over could send.
ReceivedScene::Kind received(const std::vector<std::uint64_t>& header, const std::string& rest = "") {
  ReadingProcess process(
      [&](int pipe) {
        [[maybe_unused]] ssize_t sent = ::write(pipe, header.data(), header.size() * sizeof(std::uint64_t));
        sent = ::write(pipe, rest.data(), rest.size());
        ::_exit(0);
      },
      60s, {});
  return receive_scene(process).kind;
}

TEST(SceneTransfer, whatComesIsNotBelieved) {
  using Kind = ReceivedScene::Kind;
  const std::string vertices(3 * 24, '\0');
  const auto triangle = [](std::uint32_t last) {
    const std::array<std::uint32_t, 3> corners = {0, 1, last};
    return std::string(reinterpret_cast<const char*>(corners.data()), sizeof(corners));
  };
  EXPECT_EQ(received({0, 0, 3, 1, 0}, vertices + triangle(2)), Kind::scene);
  EXPECT_EQ(received({0, 0, 3, 1, 99}, vertices + triangle(2)), Kind::nothing) << "no such unit";
  EXPECT_EQ(received({0, 0, 3, 1, 0}, vertices + triangle(3)), Kind::nothing) << "no such vertex";
  EXPECT_EQ(received({0, 0, 3, 1, 0}, vertices), Kind::nothing) << "cut short";
  EXPECT_EQ(received({0, 0}), Kind::nothing);
  EXPECT_EQ(received({}), Kind::nothing);
  EXPECT_EQ(received({0, 5, 0, 0, 0}, "hello"), Kind::message);
  EXPECT_EQ(received({0, ~0ull, 0, 0, 0}, "hello"), Kind::nothing);
  EXPECT_EQ(received({0, 0, ~0ull, 0, 0}), Kind::nothing);
  EXPECT_EQ(received({0, 0, 3, ~0ull, 0}, vertices), Kind::nothing);
  EXPECT_EQ(received({1, 0, 0, 0, 0}), Kind::out_of_memory);
}

TEST(SceneTransfer, whatIsAnnouncedAndDoesNotComeTakesNoMemory) {
  const auto peak_memory = [] {  // at once, so far [KiB]
    rusage usage;
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const long before = peak_memory();
  ReadingProcess process(
      [&](int pipe) {
        const std::uint64_t header[] = {0, 0, 0, max_triangles, 0};
        [[maybe_unused]] const ssize_t sent = ::write(pipe, header, sizeof(header));
        ::pause();
      },
      2s, {});
  EXPECT_THROW(receive_scene(process), ReadingProcess::TooSlow);
  EXPECT_LT(peak_memory() - before, 300 * 1024);  // announced are 768 MiB
}

}  // namespace
}  // namespace nextview
