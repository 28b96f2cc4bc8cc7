// What a journal's records say, and what is refused as one.
#include "core/journal/journal_records.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nextview {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Pose pose_at(double x) {
  return make_pose({x, -2.0 * x, 0.5}, Eigen::Quaterniond(Eigen::AngleAxisd(x, Vector3::UnitY())));
}

/// Of a number of its own in each field: none can be taken for another.
JournalStep full_step() {
  JournalStep step;
  step.number = 1;
  step.wanted = {pose_at(0.1), 7u};
  step.candidate = 17;
  step.is_custom = true;
  step.gain = 1.5, step.utility = 2.5;
  step.reached = pose_at(0.2), step.believed = pose_at(0.3), step.T_world_camera = pose_at(0.4);
  step.max_range = 3.5;
  step.camera = {64, 48, 61.5, 62.5, 31.5, 23.5};
  step.motion = {4.5, 5.5, 6.5};
  step.registration = {pose_at(0.5), 0.01, 0.02, 0.03, 0.04, 0.05, 3, true, "of no shape"};
  step.scan = "0001.npy";
  step.hash = {123, "89abcdef"};
  return step;
}

Journal begun() {
  Journal journal;
  EXPECT_TRUE(read_record(beginning_record({"box.ply", FileHash{77, "01234567"}}, "seed = 4\n"), journal));
  return journal;
}

JournalStep read_again(const JournalStep& step) {
  Journal journal = begun();
  EXPECT_FALSE(read_record(step_record(step), journal)) << "it does not begin a session";
  EXPECT_EQ(journal.at, step.number);
  return journal.steps.at(step.number);
}

TEST(JournalRecords, ASessionsBeginningSaysOfWhatItIs) {
  const Journal journal = begun();
  EXPECT_THAT(journal.program, testing::StartsWith("nextview "));
  EXPECT_EQ(journal.input.path, "box.ply");
  EXPECT_TRUE(journal.input.hash == (FileHash{77, "01234567"}));
  EXPECT_THAT(journal.settings, testing::ElementsAre("seed = 4\n"));
  Journal of_a_folder;
  read_record(beginning_record({"recording"}, ""), of_a_folder);
  EXPECT_FALSE(of_a_folder.input.hash);
}

TEST(JournalRecords, AStepComesBackWithEachOfItsFields) {
  const JournalStep was = full_step(), is = read_again(was);
  EXPECT_EQ(is.after, 0u);
  EXPECT_EQ(is.wanted, was.wanted);
  EXPECT_EQ(is.candidate, was.candidate);
  EXPECT_TRUE(is.is_custom && !is.overridden);
  EXPECT_EQ(std::pair(is.gain, is.utility), std::pair(1.5, 2.5));
  EXPECT_EQ(is.reached.matrix(), was.reached.matrix());
  EXPECT_EQ(is.believed.matrix(), was.believed.matrix());
  EXPECT_EQ(is.T_world_camera.matrix(), was.T_world_camera.matrix());
  EXPECT_EQ(is.max_range, 3.5);
  EXPECT_EQ(std::pair(is.camera.width, is.camera.height), std::pair(64, 48));
  EXPECT_EQ(Eigen::Vector4d(is.camera.fx, is.camera.fy, is.camera.cx, is.camera.cy),
            Eigen::Vector4d(61.5, 62.5, 31.5, 23.5));
  EXPECT_EQ(Vector3(is.motion.distance, is.motion.rotation, is.motion.seconds), Vector3(4.5, 5.5, 6.5));
  EXPECT_EQ(is.scan, "0001.npy");
  EXPECT_TRUE(is.hash == was.hash);
  EXPECT_EQ(is.settings, 1u) << "texts of settings before it";
}

TEST(JournalRecords, ARegistrationComesBackWithEachOfItsFields) {
  for (const bool reliable : {true, false}) {
    JournalStep step = full_step();
    step.registration->reliable = reliable;
    const ScanRegistration is = read_again(step).registration.value();
    EXPECT_EQ(is.T_corrected_believed.matrix(), pose_at(0.5).matrix());
    EXPECT_EQ(Eigen::Vector3d(is.shift, is.rotation, is.overlap), Eigen::Vector3d(0.01, 0.02, 0.03));
    EXPECT_EQ(std::pair(is.residual_before, is.residual_after), std::pair(0.04, 0.05));
    EXPECT_EQ(is.constrained, 3);
    EXPECT_EQ(is.reliable, reliable);
    EXPECT_EQ(is.why_not, "of no shape");
  }
  JournalStep without = full_step();
  without.registration.reset(), without.candidate.reset(), without.wanted.frame.reset();
  without.is_custom = false, without.overridden = true;
  const JournalStep is = read_again(without);
  EXPECT_FALSE(is.registration || is.candidate || is.wanted.frame || is.is_custom);
  EXPECT_TRUE(is.overridden);
}

TEST(JournalRecords, NumbersThatAreNotFiniteComeBackToo) {
  for (const double number : {infinity, -infinity}) {
    JournalStep step = full_step();
    step.gain = number;
    EXPECT_EQ(read_again(step).gain, number);
  }
  for (const double number : {std::nan(""), -std::nan("")}) {
    JournalStep step = full_step();
    step.gain = number;
    EXPECT_TRUE(std::isnan(read_again(step).gain));
  }
}

TEST(JournalRecords, ACameraHasPixelsAndFiniteNumbers) {
  const auto is_taken = [](const PinholeCamera& camera) {
    JournalStep step = full_step();
    step.camera = camera;
    Journal journal = begun();
    try {
      read_record(step_record(step), journal);
    } catch (const std::exception&) {
      EXPECT_TRUE(journal.steps.empty());
      return false;
    }
    return true;
  };
  constexpr int most = 65536;  // a side, as the program's images have at most
  for (const auto& [width, height] : {std::pair(1, 1), {most, 1}, {1, most}})
    EXPECT_TRUE(is_taken({width, height, 1, 1, 0, 0})) << width << " x " << height;
  for (const auto& [width, height] : {std::pair(0, 9), {9, 0}, {-1, 9}, {9, -1}, {most + 1, 9}, {9, most + 1}, {0, 0}})
    EXPECT_FALSE(is_taken({width, height, 1, 1, 0, 0})) << width << " x " << height;
  for (const double bad : {infinity, -infinity, std::nan("")}) {
    EXPECT_FALSE(is_taken({2, 2, bad, 1, 0, 0}));
    EXPECT_FALSE(is_taken({2, 2, 1, bad, 0, 0}));
    EXPECT_FALSE(is_taken({2, 2, 1, 1, bad, 0}));
    EXPECT_FALSE(is_taken({2, 2, 1, 1, 0, bad}));
  }
}

TEST(JournalRecords, AStepComesAfterAnEarlierOneAtARigidPose) {
  const auto refused = [](auto change) {
    JournalStep step = full_step();
    change(step);
    Journal journal = begun();
    EXPECT_ANY_THROW(read_record(step_record(step), journal));
    EXPECT_TRUE(journal.steps.empty());
  };
  refused([](auto& step) { step.number = 0, step.scan = "0000.npy"; });
  refused([](auto& step) { step.after = 1; });
  refused([](auto& step) { step.after = 2; });
  refused([](auto& step) { step.wanted.T_world_camera.linear() *= 2.0; });
  refused([](auto& step) { step.reached.linear().col(0) *= -1.0; });
  refused([](auto& step) { step.believed.translation().x() = infinity; });
  refused([](auto& step) { step.T_world_camera.linear()(1, 2) = std::nan(""); });
  refused([](auto& step) { step.scan = "0001.txt"; });
  JournalStep points = full_step();
  points.scan = "0001.ply";
  EXPECT_EQ(read_again(points).scan, "0001.ply");
}

TEST(JournalRecords, OneStandsAtStepsThatThereAre) {
  Journal journal = begun();
  read_record(step_record(full_step()), journal);
  read_record(position_record(0), journal);
  EXPECT_EQ(journal.at, 0u);
  read_record(position_record(1), journal);
  EXPECT_EQ(journal.at, 1u);
  EXPECT_ANY_THROW(read_record(position_record(2), journal));
  EXPECT_EQ(journal.at, 1u);
  EXPECT_ANY_THROW(read_record(outcome_record(2, {{"coverage", 1.0}}), journal)) << "of no step";
}

TEST(JournalRecords, WhatARobotSaidOfCandidatesBelongsToItsStep) {
  Journal journal = begun();
  read_record(step_record(full_step()), journal);
  const double far = std::numeric_limits<double>::infinity();
  read_record(reach_record(1, {{"", {0.25, 0.0, 2.0}}, {"below the table", {}}, {"", {far, 0.0, 1.0}}}), journal);
  const std::vector<Reach>& reach = journal.steps.at(1).reach;
  ASSERT_EQ(reach.size(), 3u);
  EXPECT_EQ(reach[0].cost.distance, 0.25);
  EXPECT_EQ(reach[0].cost.seconds, 2.0);
  EXPECT_EQ(reach[0].unreachable, "");
  EXPECT_EQ(reach[1].unreachable, "below the table");
  EXPECT_EQ(reach[2].cost.distance, far);
  EXPECT_ANY_THROW(read_record(reach_record(2, {}), journal)) << "of no step";
}

TEST(JournalRecords, SettingsCountFromTheStepThatOneStandsAt) {
  Journal journal = begun();
  read_record(step_record(full_step()), journal);
  EXPECT_EQ(journal.settings_at.at(1), 1u);
  read_record(settings_record("seed = 5\n"), journal);
  EXPECT_THAT(journal.settings, testing::ElementsAre("seed = 4\n", "seed = 5\n"));
  EXPECT_EQ(journal.settings_at.at(1), 2u);
}

TEST(JournalRecords, OnlyTheLastRecordCloses) {
  Journal journal = begun();
  EXPECT_NO_THROW(EXPECT_FALSE(read_record(closing_record(), journal)));
  EXPECT_TRUE(journal.closed);
  read_record(position_record(0), journal);
  EXPECT_FALSE(journal.closed);
}

TEST(JournalRecords, WhatIsNoneIsRefused) {
  Journal journal = begun();
  for (const char* bad : {"", "{}", "[]", "7", R"({"record":7})", R"({"record":"opened"})", R"({"record":""})",
                          R"({"record":"step"})", R"({"record":"at"})", R"({"record":"settings"})"})
    EXPECT_ANY_THROW(read_record(bad, journal)) << bad;
  EXPECT_EQ(journal.settings.size(), 1u);
}

// Each of these would be taken for another number: for 0, for instance.
TEST(JournalRecords, NumbersThatAreNoWholeOnesOrTooLargeAreRefused) {
  Journal journal = begun();
  for (const char* number : {"0.5", "1e71", "-1", "4294967296", "18446744073709551616", "true", "null"})
    EXPECT_ANY_THROW(read_record(fmt::format(R"({{"record":"at","number":{}}})", number), journal)) << number;
  for (const char* version : {"1e71", "-1e71", "1.0", "18446744073709551615"})
    EXPECT_ANY_THROW(read_record(
        fmt::format(R"({{"record":"session","version":{},"program":"nextview","input":"","toml":""}})", version),
        journal))
        << version;
  EXPECT_EQ(journal.settings.size(), 1u);
}

}  // namespace
}  // namespace nextview
