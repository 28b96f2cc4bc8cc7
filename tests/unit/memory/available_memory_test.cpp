#include "core/memory/available_memory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/unit/memory/in_child.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::MatchesRegex;

std::string complaint(std::uint64_t bytes) {
  try {
    require_memory(bytes, "a map of 9 x 9 x 9 voxels", "use coarser voxels");
  } catch (const OutOfMemory& error) {
    return error.what();
  }
  return "";
}

TEST(AvailableMemory, WhatIsNotThereIsRefusedInOneLineThatSaysHowMuch) {
  EXPECT_THAT(
      complaint(std::uint64_t{5'000'000} << 30),
      MatchesRegex("a map of 9 x 9 x 9 voxels needs [0-9]+\\.[0-9] GB, [0-9.]+ [GM]B are available: use coarser "
                   "voxels"));
  EXPECT_EQ(complaint(1), "");
}

TEST(AvailableMemory, IsAtMostWhatTheMachineHas) {
  std::ifstream meminfo("/proc/meminfo");
  std::string key;
  std::uint64_t kilobytes = 0;
  meminfo >> key >> kilobytes;
  ASSERT_EQ(key, "MemTotal:");
  const auto total = kilobytes * 1024;
  for (std::uint64_t swap = 0; meminfo >> key; meminfo.ignore(100, '\n'))
    if (key == "SwapTotal:" && meminfo >> swap) kilobytes += swap;
  EXPECT_GT(available_memory(), 0u);
  EXPECT_LE(available_memory(), kilobytes * 1024);
  EXPECT_GT(total, 0u);
}

/// A machine as these files have it.
class AvailableMemoryOf : public testing::Test {
 protected:
  AvailableMemoryOf() {
    write("proc/meminfo",
          "MemTotal: 900000 kB\nMemFree: 1 kB\nMemAvailable:  400000 kB\nBuffers: 2 kB\nSwapFree: 100000 kB\n");
  }
  void write(const std::string& name, const std::string& text) {
    const std::filesystem::path file = root_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  std::uint64_t left() const { return available_memory(root_.path()); }

  TemporaryFolder root_;
};

TEST_F(AvailableMemoryOf, AMachineIsWhatItCanGiveAndItsSwap) { EXPECT_EQ(left(), 500'000u * 1024); }

TEST_F(AvailableMemoryOf, AMachineThatDoesNotTellIsThatOfTheLimits) {
  write("proc/meminfo", "MemTotal: 900000 kB\n");
  EXPECT_GT(left(), 900'000u * 1024);
}

TEST_F(AvailableMemoryOf, AMachineWithoutSwapOrWithEmptyFilesIsReadToo) {
  write("proc/meminfo", "MemAvailable:  300000 kB\n");
  EXPECT_EQ(left(), 300'000u * 1024);
  write("proc/meminfo", "SwapFree: 100000 kB\nMemAvailable: 0 kB\n");
  EXPECT_EQ(left(), 100'000u * 1024) << "in any order";
  write("proc/self/cgroup", "\n7\n0::\n");
  EXPECT_EQ(left(), 100'000u * 1024);
}

TEST_F(AvailableMemoryOf, AGroupIsWhatItAndThoseAroundItLeave) {
  write("proc/self/cgroup", "0::/outer/inner\n");
  write("sys/fs/cgroup/outer/inner/memory.max", "max\n");
  EXPECT_EQ(left(), 500'000u * 1024);
  write("sys/fs/cgroup/outer/memory.max", "300000000\n");
  write("sys/fs/cgroup/outer/memory.current", "200000000\n");
  EXPECT_EQ(left(), 100'000'000u);
  write("sys/fs/cgroup/outer/memory.stat", "anon 7\nfile 50\ninactive_file 40000000\n");
  EXPECT_EQ(left(), 140'000'000u) << "pages of files are given back";
  write("sys/fs/cgroup/outer/inner/memory.max", "30000000\n");
  write("sys/fs/cgroup/outer/inner/memory.current", "40000000\n");
  EXPECT_EQ(left(), 0u);
}

TEST_F(AvailableMemoryOf, AGroupOfTheFirstKindToo) {
  write("proc/self/cgroup", "4:cpu:/other\n5:memory:/jobs\n");
  write("sys/fs/cgroup/memory/jobs/memory.limit_in_bytes", "70000000\n");
  write("sys/fs/cgroup/memory/jobs/memory.usage_in_bytes", "20000000\n");
  EXPECT_EQ(left(), 50'000'000u);
}

TEST(AvailableMemory, FollowsTheLimitsOfTheProcess) {
  if (!memory_can_be_limited) GTEST_SKIP() << "built with sanitizers";
  constexpr std::uint64_t left = std::uint64_t{100} << 20, slack = std::uint64_t{8} << 20;
  const auto limited = [&](auto resource) {
    return holds_in_child([&] {
      return leave(resource, left) && available_memory() <= left && available_memory() >= left - slack &&
             !complaint(left).empty() && complaint(left / 3).empty();
    });
  };
  EXPECT_TRUE(limited(RLIMIT_AS));
  EXPECT_TRUE(limited(RLIMIT_DATA));
}

/// Of this process [bytes].
std::uint64_t resident_memory() {
  std::uint64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * std::uint64_t(::sysconf(_SC_PAGESIZE));
}

TEST(FreedMemory, IsTheSystemsAgain) {
  if (!memory_can_be_limited) GTEST_SKIP() << "built with sanitizers, which have an allocator of their own";
  constexpr std::size_t block = 64 << 10, count = 1024;
  std::vector<std::vector<char>> blocks, kept;
  for (std::size_t i = 0; i < count; ++i) {
    blocks.emplace_back(block, 'x');
    if (i % 64 == 0) kept.emplace_back(block, 'x');  // between the others: the allocator keeps what lies before them
  }
  blocks.clear();
  const std::uint64_t before = resident_memory();
  return_freed_memory();
  EXPECT_LT(resident_memory() + (std::uint64_t{block} * count) / 2, before);
}

}  // namespace
}  // namespace nextview
