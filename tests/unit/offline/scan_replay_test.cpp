// What is refined of a scan that was kept: a simulation is known to its truth, a live scanner's captures alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/file/atomic_file.hpp"
#include "core/offline/refinement.hpp"
#include "core/session/session_folder.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

class ScanReplay : public testing::Test {
 protected:
  ScanReplay() : session_(small_scan()) {
    SessionFolder kept = SessionFolder::begin(OutputFolder(path(), {}), session_);
    for (int k = 0; k < 2; ++k) EXPECT_TRUE(kept.step(session_));
  }
  std::filesystem::path path() const { return folder_ / "session"; }
  void expect_its_scans(const RefinementJob& job) const {
    ASSERT_EQ(job.scans.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(job.scans[k].hits, session_.scans()[k]->hits) << k;
      EXPECT_EQ(job.scans[k].misses, session_.scans()[k]->misses) << k;
      EXPECT_EQ(job.scans[k].origin, session_.scans()[k]->origin) << k;
    }
    EXPECT_EQ(job.candidates.size(), 10u);
  }
  void expect_simulated(const RefinementJob& job) const {
    EXPECT_EQ(job.name, "box");
    ASSERT_TRUE(job.object && job.truth);
    EXPECT_EQ(job.truth->samples.points.size(), 2000u);
    EXPECT_EQ(job.truth->visited.size(), job.grid.voxel_count());
  }
  TemporaryFolder folder_;
  Session session_;
};

TEST_F(ScanReplay, AKeptSimulationHasItsScansAndItsTruth) {
  const RefinementJob job = refinement_job(path(), {});
  expect_its_scans(job);
  expect_simulated(job);
}

TEST_F(ScanReplay, WithoutItsCapturesItIsSensedAgain) {
  std::filesystem::remove(path() / journal_name);
  std::filesystem::remove_all(path() / scans_name);
  std::string csv = "step,view,x[m],y[m],z[m],qx,qy,qz,qw\n";
  for (const StepRecord& r : session_.records()) {
    const Vector3 p = r.T_world_camera.translation();
    const Eigen::Quaterniond q(r.T_world_camera.linear());
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", r.step, r.view, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  }
  write_file(path() / "views.csv", csv);
  const RefinementJob job = refinement_job(path(), {});
  expect_its_scans(job);
  expect_simulated(job);
}

TEST_F(ScanReplay, OfALiveScannerThereAreTheCapturesAlone) {
  const RefinementJob job = refinement_job(path(), [](Configuration& c) { c.driver.name = "scanner"; });
  expect_its_scans(job);
  EXPECT_EQ(job.name, "scanner");
  EXPECT_FALSE(job.truth || job.object) << "nobody knows what it scans";
}

TEST_F(ScanReplay, ASettingThatIsOverriddenCounts) {
  const RefinementJob job = refinement_job(path(), [](Configuration& c) { c.gibbs.sampler.chains = 3; });
  EXPECT_EQ(job.sampler.chains, 3);
  EXPECT_THROW(refinement_job(path(), [](Configuration& c) { c.gibbs.sampler.chains = 0; }), std::invalid_argument);
}

}  // namespace
}  // namespace nextview
