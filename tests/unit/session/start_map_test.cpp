#include "core/session/start_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/config/opened_input.hpp"
#include "core/map/octree_file.hpp"
#include "core/session/session.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

class StartMap : public InTemporaryFolder {
 protected:
  void SetUp() override {
    Session session(small_scan());
    session.step();
    session.step();
    write_octree(session.map(), file_);
    voxels_ = session.map().voxels().dense();
    grid_ = session.map().grid();
  }

  std::filesystem::path file_ = folder_ / "start_map.ot";
  std::vector<Voxel> voxels_;
  VoxelGrid grid_;
};

/// Log-odds of what is measured, by the voxel's centre.
float log_odds_at(const OccupancyMap& map, const Vector3& point) {
  const Eigen::Vector3i cell = map.grid().cell_at(point);
  return map.grid().contains(cell) ? map.log_odds(map.grid().index(cell)) : 0.0f;
}

TEST_F(StartMap, IsWhatTheScanBeginsWith) {
  Configuration c = small_scan();
  c.map.start = file_.string();
  Session session(c);
  for (std::uint32_t v = 0; v < voxels_.size(); ++v)
    ASSERT_EQ(session.map().log_odds(v), voxels_[v].measured ? voxels_[v].log_odds : 0.0f);
  const auto measured = std::ranges::count_if(voxels_, &Voxel::measured);
  EXPECT_EQ(session.setup().start_entropy.unmeasured, double(voxels_.size()) - double(measured)) << "a bit each";
  EXPECT_LT(session.setup().start_entropy.total, double(voxels_.size()));
  EXPECT_GT(session.setup().start_entropy.total, session.setup().start_entropy.unmeasured);
  session.step();
  EXPECT_LT(session.records().front().new_voxels, session.records().front().points) << "most was known";
}

TEST_F(StartMap, OfAnotherRegionGivesWhatBothHave) {
  Configuration c = small_scan();
  c.map.start = file_.string();
  c.map.region = "-0.28 -0.32 -0.28 0.32 0.36 0.32";
  Session session(c);
  const OccupancyMap& map = session.map();
  std::size_t measured = 0;
  for (std::uint32_t v = 0; v < voxels_.size(); ++v) {
    const Vector3 centre = grid_.centre(v);
    if (!map.grid().contains(map.grid().cell_at(centre))) continue;
    measured += voxels_[v].measured;
    ASSERT_EQ(log_odds_at(map, centre), voxels_[v].measured ? voxels_[v].log_odds : 0.0f);
  }
  EXPECT_GT(measured, 500u);
}

TEST_F(StartMap, SetsTheResolutionUnlessAnotherIsGiven) {
  Configuration c = small_scan();
  c.map.resolution = Configuration().map.resolution;
  c.map.start = file_.string();
  EXPECT_DOUBLE_EQ(Session(c).configuration().map.resolution, 0.04);
  c.map.resolution = 0.03;
  try {
    Session session(c);
    FAIL() << "voxels of 3 cm do not hold those of 4";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("must be that of the map to begin with, 40 mm"));
  }
}

TEST_F(StartMap, AloneIsShownAndNothingIsScanned) {
  Configuration c;
  c.object.file = file_.string();
  Session session(c);
  EXPECT_THAT(session.finished(), testing::HasSubstr("map alone"));
  EXPECT_EQ(session.name(), "start_map.ot");
  EXPECT_FALSE(session.mesh() || session.known_object());
  EXPECT_TRUE(session.candidates().empty());
  EXPECT_DOUBLE_EQ(session.map().grid().resolution, 0.04);
  for (std::uint32_t v = 0; v < voxels_.size(); ++v) {
    if (!voxels_[v].measured) continue;
    ASSERT_EQ(log_odds_at(session.map(), grid_.centre(v)), voxels_[v].log_odds);
  }
}

TEST_F(StartMap, AloneLeavesNothingForWhatIsOpenedNext) {
  Configuration c;
  c.object.file = file_.string();
  const Configuration next = with_input(Session(c).configuration(), "box");
  EXPECT_EQ(next.map.start, "");
  EXPECT_EQ(next.map.region, "");
  EXPECT_EQ(next.map.resolution, Configuration().map.resolution);
}

}  // namespace
}  // namespace nextview
