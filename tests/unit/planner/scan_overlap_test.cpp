#include "core/planner/scan_overlap.hpp"

#include <gtest/gtest.h>

namespace nextview {
namespace {

/// A plate of 0.2 m in the plane z = 0 that was scanned from 0.5 m above.
struct ScanOverlap : ::testing::Test {
  ScanOverlap() : known{OccupancyMap(region_of_interest(Vector3::Zero(), 1.0, 0.01), {})} {
    Scan scan;
    scan.origin = {0, 0, 0.5};
    for (int x = -50; x < 50; ++x)
      for (int y = -50; y < 50; ++y) scan.hits.emplace_back(float((x + 0.5) * 0.002), float((y + 0.5) * 0.002), 0.0f);
    fuse(known, scan, {});
    known.taken.push_back({above, above.T_world_camera});
  }
  double with(const View& view) const {
    return scan_overlap(known, *planning_rays(known, 2.0), bundle, {&view, 1}).front();
  }

  Knowledge known;
  View above = {look_at({0, 0, 0.5}, Vector3::Zero())};
  RayBundle bundle = RayBundle::regular(PinholeCamera::from_field_of_view(320, 240, 1.0), 40, 30);
};

TEST_F(ScanOverlap, IsWholeWhereAViewWasTakenAndLessBesideIt) {
  EXPECT_EQ(with(above), 1.0);
  EXPECT_GT(with({look_at({0.25, 0, 0.43}, Vector3::Zero())}), 0.7) << "30 degrees beside it";
  const double half = with({look_at({0, 0, 0.5}, {0.26, 0, 0})});  // half of it is in the image
  EXPECT_NEAR(half, 0.5, 0.15);
}

TEST_F(ScanOverlap, OfWhatIsSeenFromBehindOrNotAtAllThereIsNone) {
  EXPECT_EQ(with({look_at({0, 0, -0.5}, Vector3::Zero())}), 0.0);
  EXPECT_EQ(with({look_at({0, 0, 0.5}, {0, 0, 2})}), 0.0);
  known.taken.clear();
  EXPECT_EQ(with(above), 0.0) << "nothing was taken";
}

}  // namespace
}  // namespace nextview
