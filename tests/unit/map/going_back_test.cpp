// What is stopped, or undone, leaves a map as it was, to the bit.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/map/ground_truth.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/progress/stopped.hpp"
#include "tests/unit/map/closed_meshes.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

constexpr double resolution = 0.01, max_range = 1.5, reach = 0.1;

std::vector<Scan> some_scans() {
  std::mt19937 random(17);
  std::vector<Scan> scans;
  for (const Vector3& origin : random_scans::origins()) {
    scans.push_back(random_scans::scan(random, origin, resolution, 4000));
    random_scans::add_passes(scans.back(), random, max_range, 500);
  }
  return scans;
}

OccupancyMap empty_map() { return {region_of_interest(Vector3::Zero(), 0.44, resolution), {}}; }

bool same(const OccupancyMap& a, const OccupancyMap& b) {
  return std::ranges::equal(a.log_odds(), b.log_odds()) &&
         std::ranges::equal(a.voxels(), b.voxels(), [](const Voxel& x, const Voxel& y) {
           return x.probability == y.probability && x.entropy == y.entropy && x.voxel_class == y.voxel_class &&
                  x.measured == y.measured && x.occlusion_distance == y.occlusion_distance;
         });
}

TEST(GoingBack, UndoesInsertionAndOcclusions) {
  for (const bool by_local_map : {false, true}) {
    OccupancyMap map = empty_map();
    std::size_t marked = 0, changed = 0;
    for (const Scan& scan : some_scans()) {
      const OccupancyMap before = map;
      MapChanges undo;
      const auto add = [&](MapChanges* changes) {
        if (by_local_map) {
          OccupancyMap local = empty_map();
          local.insert(scan, max_range);
          map.register_local(local, scan.origin, changes);
        } else {
          map.insert(scan, max_range, {}, changes);
        }
        map.mark_occlusions(scan, max_range, reach, {}, changes);
      };
      add(&undo);
      const OccupancyMap after = map;
      changed += !same(map, before);  // a scan from afar may not reach the region
      map.go_back(undo);
      EXPECT_TRUE(same(map, before));
      add(nullptr);
      EXPECT_TRUE(same(map, after)) << "something was left behind";
      marked += std::ranges::count_if(map.voxels(), [](const Voxel& v) { return v.occlusion_distance > 0; });
    }
    EXPECT_GT(marked, 100u);
    EXPECT_GE(changed, 3u);
  }
}

TEST(GoingBack, AStoppedInsertionChangesNothing) {
  std::stop_source stop;
  stop.request_stop();
  const std::vector<Scan> scans = some_scans();
  OccupancyMap map = empty_map(), never_stopped = empty_map();
  for (const Scan& scan : scans) {
    EXPECT_THROW(map.insert(scan, max_range, stop.get_token()), Stopped);
    EXPECT_TRUE(same(map, never_stopped));
    map.insert(scan, max_range);
    never_stopped.insert(scan, max_range);
    EXPECT_TRUE(same(map, never_stopped)) << "touches of the stopped insertion were left behind";
  }
}

TEST(GoingBack, TheTruthCanBeStopped) {
  std::stop_source stop;
  stop.request_stop();
  const VoxelGrid grid = region_of_interest(Vector3::Zero(), 1.0, 0.02);
  EXPECT_THROW(ground_truth(closed_meshes::octahedron(Vector3::Zero(), 0.3), grid, stop.get_token()), Stopped);
}

TEST(GoingBack, AMapThatCannotFitIsRefusedBeforeItIsMade) {
  VoxelGrid grid = region_of_interest(Vector3::Zero(), 1.0, 0.01);
  grid.size.setConstant(100'000);
  try {
    const OccupancyMap map(grid, {});
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("a map of 100000 x 100000 x 100000 voxels needs 17000000.0 GB, ")) << text;
  }
}

}  // namespace
}  // namespace nextview
