// What is stopped, and what is done to a copy, leaves a map as it was, to the bit.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/map/ground_truth.hpp"
#include "core/map/occupancy_map.hpp"
#include "core/progress/stopped.hpp"
#include "tests/unit/map/closed_meshes.hpp"
#include "tests/unit/map/random_scans.hpp"

namespace nextview {
namespace {

constexpr double resolution = 0.01, reach = 0.1;

std::vector<Scan> some_scans() {
  std::mt19937 random(17);
  std::vector<Scan> scans;
  for (const Vector3& origin : random_scans::origins()) {
    scans.push_back(random_scans::scan(random, origin, resolution, 4000));
    random_scans::add_passes(scans.back(), random, 500);
  }
  return scans;
}

OccupancyMap empty_map() { return OccupancyMap(region_of_interest(Vector3::Zero(), 0.44, resolution)); }

bool same(const OccupancyMap& a, const OccupancyMap& b) {
  return std::ranges::equal(a.voxels(), b.voxels(), [](const Voxel& x, const Voxel& y) {
    return x.log_odds == y.log_odds && x.probability == y.probability && x.entropy == y.entropy &&
           x.voxel_class == y.voxel_class && x.measured == y.measured && x.occlusion_distance == y.occlusion_distance;
  });
}

void add(OccupancyMap& map, const Scan& scan, bool by_local_map) {
  if (by_local_map) {
    OccupancyMap local = empty_map();
    local.insert(scan);
    map.register_local(local, scan.origin);
  } else {
    map.insert(scan);
  }
  map.mark_occlusions(scan, reach);
}

/// What the first `count` scans make of a map that was never copied.
OccupancyMap map_of(const std::vector<Scan>& scans, std::size_t count, bool by_local_map) {
  OccupancyMap map = empty_map();
  for (std::size_t k = 0; k < count; ++k) add(map, scans[k], by_local_map);
  return map;
}

TEST(GoingBack, ACopyStaysAsItWasAndGoesOnAsTheMapDid) {
  const std::vector<Scan> scans = some_scans();
  for (const bool by_local_map : {false, true}) {
    std::vector<OccupancyMap> states = {empty_map()};
    std::size_t marked = 0, changed = 0;
    OccupancyMap map = empty_map();
    for (const Scan& scan : scans) {
      add(map, scan, by_local_map);
      states.push_back(map);
      changed += !same(map, states[states.size() - 2]);  // a scan from afar may not reach the region
      marked += std::ranges::count_if(map.voxels(), [](const Voxel& v) { return v.occlusion_distance > 0; });
    }
    EXPECT_GT(marked, 100u);
    EXPECT_GE(changed, 3u);
    for (std::size_t k = 0; k <= scans.size(); ++k) {
      EXPECT_TRUE(same(states[k], map_of(scans, k, by_local_map))) << "a later scan shows in the map of " << k;
      for (std::size_t next = k; next < scans.size(); ++next) add(states[k], scans[next], by_local_map);
      EXPECT_TRUE(same(states[k], map)) << "on from " << k << " scans it is another map";
    }
  }
}

TEST(GoingBack, AStoppedScanChangesNothing) {
  std::stop_source stop;
  stop.request_stop();
  OccupancyMap map = empty_map(), never_stopped = empty_map();
  for (const Scan& scan : some_scans()) {
    EXPECT_THROW(map.insert(scan, stop.get_token()), Stopped);
    EXPECT_THROW(map.insert(scan, Insertion::local_octree, stop.get_token()), Stopped);
    EXPECT_TRUE(same(map, never_stopped));
    map.insert(scan);
    never_stopped.insert(scan);
    EXPECT_TRUE(same(map, never_stopped)) << "touches of the stopped insertion were left behind";
    EXPECT_THROW(map.mark_occlusions(scan, reach, stop.get_token()), Stopped);
    EXPECT_TRUE(same(map, never_stopped));
    map.mark_occlusions(scan, reach);
    never_stopped.mark_occlusions(scan, reach);
    EXPECT_TRUE(same(map, never_stopped)) << "marks of the stopped one were left behind";
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
    EXPECT_TRUE(text.starts_with("a map of 100000 x 100000 x 100000 voxels needs 6000000.0 GB, ")) << text;
  }
}

}  // namespace
}  // namespace nextview
