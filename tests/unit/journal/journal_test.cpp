// What a session's journal says, and that its captures are there to the bit.
#include "core/journal/journal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include "core/file/atomic_file.hpp"
#include "core/file/read_file.hpp"
#include "tests/unit/file/file_size_limit.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using ::testing::HasSubstr;

JournalStep step(std::uint32_t number, std::uint32_t after) {
  JournalStep step;
  step.number = number;
  step.after = after;
  step.wanted = {make_pose({0.1, 1.0 / 3.0, -2e-9}, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3::UnitX()))), 7u};
  step.candidate = 17;
  step.gain = std::numbers::pi;
  step.utility = std::nan("");
  step.reached = step.wanted.T_world_camera;
  step.T_world_camera = make_pose({0.2, 0.0, 0.0}, Eigen::Quaterniond::Identity());
  step.max_range = std::numeric_limits<double>::infinity();
  step.camera = {2, 2, 1.1, 1.2, 0.5, 0.5};
  step.motion = {0.5, 0.25, 3.0};
  step.registration.emplace();
  step.registration->shift = 0.004;
  step.registration->why_not = "it is \"flat\"\n";
  return step;
}

Capture image() {
  return {DepthImage{{2, 2, 1.1, 1.2, 0.5, 0.5}, {1.0f / 3.0f, 2e-7f, DepthImage::beyond_range, DepthImage::invalid}},
          step(1, 0).T_world_camera, std::numeric_limits<double>::infinity()};
}

class JournalTest : public testing::Test {
 protected:
  void write(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& tree) const {
    JournalWriter writer = JournalWriter::begin(folder_ / "", {"box.ply"}, "seed = 1\n");
    for (const auto& [number, after] : tree) {
      JournalStep s = step(number, after);
      writer.add(s, image());
    }
  }
  std::vector<std::uint32_t> line() const {
    std::vector<std::uint32_t> numbers;
    for (const JournalStep& s : read_journal(folder_ / "").line()) numbers.push_back(s.number);
    return numbers;
  }
  TemporaryFolder folder_;
};

TEST_F(JournalTest, AStepIsReadAsItWas) {
  write({{1, 0}});
  const Journal journal = read_journal(folder_ / "");
  EXPECT_TRUE(journal.damage.empty());
  EXPECT_EQ(journal.input.path, "box.ply");
  const JournalStep is = journal.steps.at(1), was = step(1, 0);
  EXPECT_EQ(is.wanted, was.wanted) << "to the bit";
  EXPECT_EQ(is.candidate, was.candidate);
  EXPECT_EQ(is.gain, was.gain);
  EXPECT_TRUE(std::isnan(is.utility));
  EXPECT_EQ(is.reached.matrix(), was.reached.matrix());
  EXPECT_EQ(is.T_world_camera.matrix(), was.T_world_camera.matrix());
  EXPECT_EQ(is.max_range, was.max_range);
  EXPECT_EQ(is.camera.fy, 1.2);
  EXPECT_EQ(is.motion.seconds, 3.0);
  ASSERT_TRUE(is.registration);
  EXPECT_EQ(is.registration->shift, 0.004);
  EXPECT_EQ(is.registration->why_not, was.registration->why_not);
}

TEST_F(JournalTest, ACaptureIsReadToTheBit) {
  JournalWriter writer = JournalWriter::begin(folder_ / "", {}, "");
  JournalStep ranges = step(1, 0), points = step(2, 1);
  writer.add(ranges, image());
  const std::vector<Vector3> cloud = {{1.0 / 3.0, -2e-300, 4.0}, {0.0, 1.0, std::numbers::e}};
  writer.add(points, {cloud, points.T_world_camera, 2.0});
  const Capture again = read_capture(ranges, folder_ / "");
  const auto& is = std::get<DepthImage>(again.measured).range;
  EXPECT_EQ(is[0], 1.0f / 3.0f);
  EXPECT_EQ(is[1], 2e-7f);
  EXPECT_TRUE(std::isinf(is[2]) && std::isnan(is[3]));
  EXPECT_EQ(std::get<std::vector<Vector3>>(read_capture(points, folder_ / "").measured), cloud);
}

TEST_F(JournalTest, IsATreeThatOneStandsIn) {
  {
    JournalWriter writer = JournalWriter::begin(folder_ / "", {}, "");
    for (std::uint32_t k = 1; k <= 3; ++k) {
      JournalStep s = step(k, k - 1);
      writer.add(s, image());
    }
    writer.stand_at(1);
    JournalStep s = step(4, 1);
    writer.add(s, image());
  }
  EXPECT_THAT(line(), testing::ElementsAre(1, 4));
  Journal journal;
  {
    JournalWriter writer = JournalWriter::go_on(folder_ / "", journal);
    EXPECT_EQ(journal.at, 4u);
    writer.stand_at(3);
  }
  EXPECT_THAT(line(), testing::ElementsAre(1, 2, 3));
  JournalWriter::go_on(folder_ / "", journal).stand_at(0);
  EXPECT_THAT(line(), testing::IsEmpty());
}

TEST_F(JournalTest, ALostStepLeavesTheOthers) {
  write({{1, 0}, {2, 1}, {3, 2}});
  std::ifstream in(folder_ / "journal");
  std::string all, text;
  for (int k = 0; std::getline(in, text); ++k)
    if (k != 2) all += text + "\n";
  write_file(folder_ / "journal", all);
  EXPECT_THAT(line(), testing::ElementsAre(1, 3));
}

TEST_F(JournalTest, IsClosedUntilItGoesOn) {
  write({{1, 0}});
  Journal journal;
  JournalWriter::go_on(folder_ / "", journal).close();
  EXPECT_FALSE(journal.closed);
  { const JournalWriter lock = JournalWriter::go_on(folder_ / "", journal); }
  EXPECT_TRUE(journal.closed);
  JournalWriter::go_on(folder_ / "", journal).stand_at(0);
  EXPECT_FALSE(read_journal(folder_ / "").closed);
}

/// It is only ever appended to.
TEST_F(JournalTest, IsReadAgainOnlyIfItHasGrown) {
  write({{1, 0}, {2, 1}});
  Journal journal = read_journal(folder_ / "");
  const auto size = std::filesystem::file_size(folder_ / "journal");
  EXPECT_EQ(journal.bytes, size);
  write_file(folder_ / "journal", std::string(size, '?'));
  { const JournalWriter lock = JournalWriter::go_on(folder_ / "", journal); }
  EXPECT_EQ(journal.last_number(), 2u) << "it was read again, and nothing is there any more";
  write_file(folder_ / "journal", std::string(size + 1, '?'));
  EXPECT_THROW(JournalWriter::go_on(folder_ / "", journal), std::runtime_error);
}

TEST_F(JournalTest, ACaptureThatChangedIsRefused) {
  write({{1, 0}});
  const JournalStep s = read_journal(folder_ / "").steps.at(1);
  const auto file = folder_ / "scans/0001.npy";
  std::string bytes = read_file(file);
  bytes[bytes.size() - 3] ^= 1;
  write_file(file, bytes);
  EXPECT_THROW(read_capture(s, folder_ / ""), std::runtime_error);
}

TEST_F(JournalTest, WhatIsReadOfACaptureIsWhatWasLookedAt) {
  write({{1, 0}});
  const JournalStep s = read_journal(folder_ / "").steps.at(1);
  const Descriptor watch(::inotify_init1(IN_NONBLOCK));
  ASSERT_GE(::inotify_add_watch(watch.get(), (folder_ / "scans/0001.npy").c_str(), IN_OPEN | IN_CLOSE), 0);
  read_capture(s, folder_ / "");
  std::array<inotify_event, 8> events;
  EXPECT_EQ(::read(watch.get(), events.data(), sizeof(events)), ssize_t(2 * sizeof(inotify_event)))
      << "it is opened and closed once";
}

TEST_F(JournalTest, OnAFullDiskNoneIsBegun) {
  const auto begin = [&] { JournalWriter::begin(folder_ / "", {"box.ply"}, "seed = 1\n"); };
  {
    const FileSizeLimit full(10);
    EXPECT_THAT(begin, testing::ThrowsMessage<std::runtime_error>(HasSubstr("journal: cannot be written: ")));
  }
  EXPECT_FALSE(has_journal(folder_ / "")) << "an empty one would be taken for one that is damaged";
  begin();
  EXPECT_TRUE(read_journal(folder_ / "").steps.empty());
  EXPECT_THROW(begin(), std::runtime_error) << "there is one";
  EXPECT_TRUE(has_journal(folder_ / "")) << "which stays";
}

TEST_F(JournalTest, LeadsNowhereElse) {
  write({{1, 0}});
  const std::vector<std::string> records = read_journal_file(folder_ / "journal").records;
  for (const char* scan : {"../0001.npy", "/etc/passwd", "0002.npy", ""}) {
    std::filesystem::remove(folder_ / "journal");
    std::string record = records.at(1);
    record.replace(record.find("0001.npy"), 8, scan);
    JournalFile file = JournalFile::begin(folder_ / "journal");
    file.append(records.at(0));
    file.append(record);
    EXPECT_TRUE(read_journal(folder_ / "").steps.empty()) << scan;
  }
}

TEST_F(JournalTest, OfANewerVersionIsSaidToBe) {
  JournalFile::begin(folder_ / "journal")
      .append(R"({"record":"session","version":2,"program":"nextview 9.0.0","input":""})");
  try {
    read_journal(folder_ / "");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("newer version (nextview 9.0.0)"));
  }
}

}  // namespace
}  // namespace nextview
