// What a view shows for the first time is told apart from what was scanned before, however noisy the sensor is.
#include <gtest/gtest.h>

#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

/// Areas that four views show for the first time [cm^2]: each sees other faces of the box.
std::vector<double> new_surfaces(double range_noise, double d_reg) {
  Configuration c = small_scan();
  c.sensor.width = 320;
  c.sensor.height = 240;
  c.sensor.range_noise = range_noise;
  c.planner.gain = "farthest";  // the same views, whatever is seen
  c.evaluation.d_reg = d_reg;
  Session session(c);
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

}  // namespace
}  // namespace nextview
