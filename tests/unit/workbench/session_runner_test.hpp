#pragma once
#include <gtest/gtest.h>

#include "tests/unit/map/in_temporary_folder.hpp"
#include "tests/unit/workbench/job_control.hpp"
#include "tests/unit/workbench/small_scan.hpp"

namespace nextview {

inline bool same_candidates(const std::vector<Candidate>& a, const std::vector<Candidate>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Candidate& x, const Candidate& y) {
    return x.available == y.available && x.gain == y.gain && x.cost == y.cost && x.utility == y.utility;
  });
}

/// All that a snapshot says of the scan, to the bit; seconds aside.
inline void expect_same_scan(const SessionSnapshot& a, const SessionSnapshot& b) {
  EXPECT_EQ(to_toml(a.configuration), to_toml(b.configuration));
  EXPECT_EQ(a.object_name, b.object_name);
  EXPECT_EQ(a.finished, b.finished);
  EXPECT_EQ(a.next_candidate, b.next_candidate);
  EXPECT_EQ(a.next_view.matrix(), b.next_view.matrix());
  EXPECT_EQ(a.custom_next_view, b.custom_next_view);
  EXPECT_EQ(a.explanation != nullptr, b.explanation != nullptr);
  if (a.explanation && b.explanation) {
    EXPECT_EQ(a.explanation->value, b.explanation->value);
  }
  ASSERT_EQ(a.records.size(), b.records.size());
  for (std::size_t k = 0; k < a.records.size(); ++k) {
    const StepRecord &x = a.records[k], &y = b.records[k];
    EXPECT_EQ(x.view, y.view) << k;
    EXPECT_EQ(x.overridden, y.overridden) << k;
    EXPECT_EQ(x.T_world_camera.matrix(), y.T_world_camera.matrix()) << k;
    EXPECT_EQ(x.gain, y.gain) << k;
    EXPECT_EQ(x.entropy, y.entropy) << k;
    EXPECT_EQ(x.coverage, y.coverage) << k;
    EXPECT_EQ(x.realised_gain, y.realised_gain) << k;
    EXPECT_TRUE(same_candidates(x.candidates, y.candidates)) << k;
    EXPECT_EQ(a.scans[k]->hits, b.scans[k]->hits) << k;
    EXPECT_EQ(a.scans[k]->misses, b.scans[k]->misses) << k;
  }
  EXPECT_TRUE(std::equal(a.voxels->begin(), a.voxels->end(), b.voxels->begin(), b.voxels->end(),
                         [](const Voxel& x, const Voxel& y) {
                           return x.probability == y.probability && x.measured == y.measured &&
                                  x.occlusion_distance == y.occlusion_distance;
                         }));
  EXPECT_TRUE(std::ranges::equal(a.state.known.planning_voxels(), b.state.known.planning_voxels(), {},
                                 &Voxel::probability, &Voxel::probability));
  ASSERT_EQ(a.state.evaluation != nullptr, b.state.evaluation != nullptr);
  if (a.state.evaluation && b.state.evaluation) {
    EXPECT_EQ(a.state.evaluation->seen, b.state.evaluation->seen);
    EXPECT_EQ(a.state.evaluation->visited_voxels, b.state.evaluation->visited_voxels);
  }
  EXPECT_EQ(a.cloud->points, b.cloud->points);
  EXPECT_EQ(a.cloud->views, b.cloud->views);
  EXPECT_EQ(a.cloud->distances, b.cloud->distances);
  if (a.missed && b.missed) {
    EXPECT_EQ(a.missed->observed, b.missed->observed);
  }
}

inline Configuration long_scan() {
  Configuration c = small_scan();
  c.termination.views = 50;
  return c;
}

class SessionRunnerTest : public InTemporaryFolder {
 protected:
  const SessionSnapshot& now() { return *runner_.snapshot(); }
  void steps(int count) {
    for (int i = 0; i < count; ++i) runner_.step(job_control());
  }
  /// What the user sees who never did anything else than this.
  static std::shared_ptr<const SessionSnapshot> fresh(int steps, const Configuration& configuration = small_scan()) {
    SessionRunner runner;
    runner.load(configuration, job_control());
    for (int i = 0; i < steps; ++i) runner.step(job_control());
    return runner.snapshot();
  }

  SessionRunner runner_;
};

}  // namespace nextview
