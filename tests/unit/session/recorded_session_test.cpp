// Sessions on recorded data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "core/config/opened_input.hpp"
#include "core/export/scan_files.hpp"
#include "core/recording/dataset_guess.hpp"
#include "core/session/recording_setup.hpp"
#include "core/session/session.hpp"
#include "core/session/session_folder.hpp"
#include "tests/unit/recording/made_walls.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

class RecordedSession : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("nextview_recorded_session_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    Session session(small_scan());
    while (session.finished().empty()) session.step();
    OutputFolder out(folder_, {});
    out.begin("scan");
    write_scan(session, out);
    original_ = std::make_unique<ScanState>(session.state());
  }
  static void TearDownTestSuite() {
    original_.reset();
    fs::remove_all(folder_);
  }

  static Configuration replay() {
    Configuration c;
    c.recorded.folder = folder_.string();
    return c;
  }

  static inline fs::path folder_;
  static inline std::unique_ptr<ScanState> original_;
};

bool same_maps(const OccupancyMap& a, const OccupancyMap& b) {
  if (a.grid().size != b.grid().size || a.grid().first != b.grid().first) return false;
  for (std::size_t v = 0; v < a.grid().voxel_count(); ++v)
    if (a.voxels()[v].measured != b.voxels()[v].measured || a.log_odds(v) != b.log_odds(v)) return false;
  return true;
}

/// Of a recording, and of a part of its region.
void expect_lengths_that_stay(const Configuration& c, const std::string& part) {
  const Session first(c), again(first.configuration());
  EXPECT_EQ(to_toml(again.configuration()), to_toml(first.configuration()));
  Configuration own = first.configuration();
  give(own, "map.region", part, "map.region");
  const Session smaller(own);
  EXPECT_LT(smaller.configuration().map.resolution, first.configuration().map.resolution)
      << "it follows a given region";
}

/// A window starts a session over with the configuration of the one before. What followed from the recording, a region
/// with a margin among it, once made its voxels and lengths coarser each time that a setting was changed.
TEST(RecordedLengths, AreTheSameWhenItStartsOver) {
  const TemporaryFolder folder;
  made_walls::write_3dmatch(folder);
  Configuration c;
  c.recorded.folder = folder.path().string();
  expect_lengths_that_stay(c, "-0.2 -0.2 1.8 0.2 0.2 2.2");
  c.recorded.folder = std::string(NEXTVIEW_SHARED_DIR) + "/data/scans/visp_castle_sim";
  c.recorded.every = 10;
  if (!fs::exists(c.recorded.folder))
    GTEST_SKIP() << "an addition: " << c.recorded.folder
                 << " is not there, so a made recording was opened, but no real";
  expect_lengths_that_stay(c, "-0.05 0.03 -0.1 0.05 0.13 0");
}

// A session's file names all settings. The next object once had to lie in the recording's region, if a window had gone
// on with that.
TEST(RecordedLengths, AreNotThoseOfTheNextObjectAfterASessionThatWasOpened) {
  const TemporaryFolder folder;
  made_walls::write_3dmatch(folder);
  Configuration c;
  c.recorded.folder = folder.path().string();
  folder.write("config.toml", to_toml(Session(c).configuration()));
  Configuration of_file = read_configuration(folder.path() / "config.toml");
  of_file.planner.gain = "occlusion-aware";
  Session opened(of_file);
  opened.recognise_fitted();
  const Configuration next = with_next_input(opened.configuration(), "sphere"), usual;
  EXPECT_NE(opened.configuration().map.region, "");
  EXPECT_EQ(next.map.region, "");
  EXPECT_EQ(next.map.resolution, usual.map.resolution);
  EXPECT_EQ(next.sensor.intrinsics, usual.sensor.intrinsics);
  EXPECT_EQ(next.termination, usual.termination);
  EXPECT_EQ(next.planner.gain, "occlusion-aware") << "that was set";
}

// Of depths in millimetres that are read as metres follow lengths that no setting may have.
TEST(RecordedLengths, AWrongUnitIsToldWhereItIsRefused) {
  const TemporaryFolder folder;
  made_walls::write_3dmatch(folder);
  DatasetDescription description = guess_dataset(folder / "")->description;
  description.depth.scale = 1.0;
  folder.write("dataset.toml", to_toml(description));
  Configuration c;
  c.recorded.folder = folder.path().string();
  try {
    open_configured_recording(c, {}, {});
    ADD_FAILURE() << "a wall 2 km away is scanned";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("in millimetres, not metres? Then depth.scale = 0.001 in"));
  }
}

TEST_F(RecordedSession, AScanReplayedInItsOrderGivesItsMapToTheBit) {
  Configuration c = replay();
  c.planner.gain = "fixed-order";
  Session session(c);
  finish(session);
  EXPECT_TRUE(same_maps(session.map(), original_->known.map));
  ASSERT_EQ(session.scans().size(), original_->scans.size());
  for (std::size_t k = 0; k < session.scans().size(); ++k) {
    EXPECT_EQ(session.records()[k].view, int(k));
    EXPECT_EQ(session.scans()[k]->hits, original_->scans[k]->hits);
  }
  EXPECT_DOUBLE_EQ(*session.records().back().coverage_recorded, 1.0);
}

TEST_F(RecordedSession, AnyPlannerTakesEachFrameOnce) {
  for (const char* gain : {"new-surface", "occlusion-aware", "random", "oracle"}) {
    Configuration c = replay();
    c.planner.gain = gain;
    Session session(c);
    finish(session);
    std::vector<int> frames;
    double before = 0.0;
    for (const StepRecord& r : session.records()) {
      frames.push_back(r.view);
      EXPECT_GE(*r.coverage_recorded, before);
      before = *r.coverage_recorded;
    }
    EXPECT_THAT(frames, testing::UnorderedElementsAre(0, 1, 2, 3)) << gain;
    EXPECT_FALSE(session.known_object());
  }
}

TEST_F(RecordedSession, TheOracleIsTheGreedyOrderOfWhatFramesShow) {
  Configuration c = replay();
  c.planner.gain = "oracle";
  Session session(c);
  const RecordedSurface& surface = *session.setup().recorded;
  finish(session);
  ASSERT_EQ(session.records().size(), surface.frames());
  std::vector<std::size_t> taken = {0};
  for (std::size_t k = 1; k < session.records().size(); ++k) {
    const auto with = [&](std::size_t frame) {
      std::vector<std::size_t> more = taken;
      more.push_back(frame);
      return surface.coverage(more).back();
    };
    const auto chosen = std::size_t(session.records()[k].view);
    for (std::size_t frame = 0; frame < surface.frames(); ++frame) EXPECT_LE(with(frame), with(chosen) + 1e-12);
    taken.push_back(chosen);
  }
}

TEST_F(RecordedSession, BeginsWhereItIsToldAndTakesEachNth) {
  Configuration c = replay();
  c.recorded.start = "step 3";
  Session named(c);
  named.step();
  EXPECT_EQ(named.records().front().view, 2);
  c.recorded.start = "3";  // the number in its name, whatever is left out
  c.recorded.every = 2;
  Session numbered(c);
  EXPECT_EQ(numbered.candidates().size(), 2u);
  numbered.step();
  EXPECT_EQ(numbered.scans().front()->hits, original_->scans[2]->hits);
  for (const char* left_out : {"step 2", "2"}) {
    c.recorded.start = left_out;
    EXPECT_THROW(Session{c}, std::invalid_argument) << left_out;
  }
}

TEST_F(RecordedSession, WhatWasGivenEndsItEarlier) {
  Configuration c = replay();
  c.termination.views = 2;
  Session session(c);
  finish(session);
  EXPECT_EQ(session.records().size(), 2u);
}

TEST_F(RecordedSession, AnotherCameraIsRefused) {
  Configuration c = replay();
  give(c, "sensor.width", "100", "--sensor.width");
  try {
    Session session(c);
    FAIL() << "the recording has 80 pixels a row";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("--sensor.width: the recording has its own, 80; leave it out"));
  }
}

TEST_F(RecordedSession, CustomViewsCannotBeTaken) {
  Session session(replay());
  session.step();
  EXPECT_THROW(session.override_next_view(session.candidates().front()), std::invalid_argument);
  EXPECT_NO_THROW(session.override_next_view(std::size_t{3}));
}

TEST_F(RecordedSession, TheTruthIsFoundWhereverItLies) {
  Configuration c = replay();
  c.recorded.truth = "box";
  Session session(c);
  finish(session);
  ASSERT_TRUE(session.known_object() && session.truth_alignment());
  EXPECT_GT(session.truth_alignment()->overlap, 0.99);
  EXPECT_NEAR(session.truth_alignment()->residual, 0.002, 0.001);
  EXPECT_NEAR(session.records().back().coverage, original_->records.back()->coverage, 0.02);
}

TEST(AlignmentNote, DoubtsAMeshThatIsFarSmallerOrLargerThanTheScans) {
  PointCloud scans;
  TriangleMesh mesh;
  const auto note = [&](double of_scans, double of_mesh, double overlap) {
    scans = {Eigen::Vector3f::Zero(), float(of_scans) * Eigen::Vector3f::UnitX()};
    mesh.vertices = {Eigen::Vector3f::Zero(), float(of_mesh) * Eigen::Vector3f::UnitX()};
    return alignment_note({Pose::Identity(), 0.001, overlap}, "box.ply", scans, mesh);
  };
  EXPECT_THAT(note(0.12, 0.4, 1.0), testing::EndsWith("(root mean square)")) << "the scans are of a part of it";
  EXPECT_THAT(note(0.12, 8.0, 1.0), testing::HasSubstr("The scans are 120 mm long, the mesh 8 m"));
  EXPECT_THAT(note(0.12, 0.012, 0.1), testing::HasSubstr("The scans are 120 mm long, the mesh 12 mm"));
}

TEST_F(RecordedSession, ItsConfigurationRepeatsIt) {
  Session first(replay());
  finish(first);
  const fs::path out = fs::path(folder_).concat(".toml");
  std::ofstream(out) << to_toml(first.configuration());
  Session second(read_configuration(out));
  finish(second);
  EXPECT_EQ(to_toml(first.configuration()), to_toml(second.configuration()));
  EXPECT_TRUE(same_maps(first.map(), second.map()));
  fs::remove(out);
}

/// A journal may have been written for another recording, or by anyone.
TEST_F(RecordedSession, AFrameThatIsNotThereIsLeftOut) {
  const fs::path path = fs::path(folder_.string() + "_session");
  {
    Session session(replay());
    SessionFolder folder = SessionFolder::begin(OutputFolder(path, {}), session);
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(folder.step(session));
    folder.keep_state(session);
  }
  SavedSession saved = read_session(path);
  saved.journal->steps.at(2).wanted.frame = 1000;
  fs::remove(path / "state");
  Session again(saved.configuration);
  ASSERT_TRUE(restore(again, saved, nullptr));
  EXPECT_EQ(again.records().size(), 2u);
  EXPECT_THAT(saved.notices, testing::ElementsAre(testing::HasSubstr("it is of frame 1001, and the recording has")));
  fs::remove_all(path);
}

TEST_F(RecordedSession, GoesBackToAnyView) {
  Session session(replay());
  session.step();
  const ScanState early = session.state();
  session.step();
  const int second = session.records().back().view;
  session.restore(early);
  session.step();
  EXPECT_EQ(session.records().back().view, second);
}

}  // namespace
}  // namespace nextview
