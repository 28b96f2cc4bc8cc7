// What a view shows for the first time is told apart from what was scanned before, however noisy the sensor is.
#include <gtest/gtest.h>

#include "core/planner/open_border.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

/// Four views: each sees other faces of the box.
Configuration noisy_scan(double range_noise, double d_reg) {
  Configuration c = small_scan();
  c.sensor.width = 320;
  c.sensor.height = 240;
  c.sensor.range_noise = range_noise;
  c.planner.gain = "farthest";  // the same views, whatever is seen
  c.evaluation.d_reg = d_reg;
  return c;
}

/// Areas that they show for the first time [cm^2].
std::vector<double> new_surfaces(double range_noise, double d_reg) {
  Session session(noisy_scan(range_noise, d_reg));
  finish(session);
  std::vector<double> areas;
  for (const auto& record : session.state().records) areas.push_back(record->new_surface);
  return areas;
}

TEST(NoisyScan, ShowsAsMuchNewSurfaceAsAnExactOne) {
  const std::vector<double> exact = new_surfaces(0.0, 0.008);
  ASSERT_EQ(exact.size(), 4u);
  for (const double noise : {0.003, 0.005, 0.01}) {
    const std::vector<double> noisy = new_surfaces(noise, 0.005);  // told apart by up to 1.6 times as much
    for (std::size_t view = 0; view < exact.size(); ++view)
      EXPECT_NEAR(noisy[view], exact[view], 0.05 * exact[0]) << "view " << view << ", noise " << noise << " m";
  }
}

/// How much of the surface ends where it may go on, after four views [m].
double open_length(double range_noise, double d_reg) {
  Configuration c = noisy_scan(range_noise, d_reg);
  c.object.file = NEXTVIEW_SOURCE_DIR "/assets/objects/slotted_housing.ply";
  c.sensor.width = 640;
  c.sensor.height = 480;
  c.map.resolution = 0.01;
  c.views.count = 48;
  Session session(c);
  finish(session);
  return open_border(session.state().known).length;
}

TEST(NoisyScan, EndsWhereAnExactOneDoes) {
  const double exact = open_length(0.0, 0.006);
  EXPECT_NEAR(open_length(0.002, 0.005), exact, 0.2 * exact)
      << "likewise told apart by 6 mm; 30 % more if not smoothed";
}

}  // namespace
}  // namespace nextview
