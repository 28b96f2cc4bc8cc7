#include "core/source/inaccurate_source.hpp"

#include <gtest/gtest.h>

#include "core/source/simulated_source.hpp"

namespace nextview {
namespace {

const Pose looking = look_at({0.9, 0.1, 0.2}, Vector3::Zero());

std::unique_ptr<SimulatedSource> simulated() {
  static const auto world = [] {
    auto box = std::make_shared<PlacedMesh>();
    box->mesh = load_mesh(NEXTVIEW_SOURCE_DIR "/assets/objects/box.ply");
    DepthCameraConfig sensor;
    sensor.width = 64;
    sensor.height = 48;
    return std::make_shared<const SimulatedWorld>(box, sensor);
  }();
  return std::make_unique<SimulatedSource>(world, 3);
}

Capture captured(ScanSource& source, const Pose& from, std::uint32_t step) {
  return std::get<Capture>(source.capture({from}, step, {}));
}
std::vector<float> ranges(const Capture& capture) { return std::get<DepthImage>(capture.measured).range; }

bool same(const std::vector<float>& a, const std::vector<float>& b) {  // NaN is as good as itself here
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(InaccurateSource, SensesFromTheTruePoseAndBelievesTheOther) {
  const RobotConfig errors{0.02, 3.0};
  InaccurateSource source(simulated(), errors, 3);
  const Capture capture = captured(source, looking, 5);
  EXPECT_EQ(capture.T_world_camera.matrix(), looking.matrix());
  const Pose truth = looking * pose_error(errors, 3, 5);
  EXPECT_TRUE(same(ranges(capture), ranges(captured(*simulated(), truth, 5))));
  EXPECT_FALSE(same(ranges(capture), ranges(captured(*simulated(), looking, 5))));
}

TEST(InaccurateSource, ErrsAgainAsItDidAfterGoingBack) {
  InaccurateSource source(simulated(), {0.02, 3.0}, 3);
  const Capture first = captured(source, looking, 2);
  captured(source, looking, 3);
  EXPECT_TRUE(same(ranges(first), ranges(captured(source, looking, 2))));
}

TEST(InaccurateSource, RefusesErrorsThatAreNone) {
  EXPECT_THROW(InaccurateSource(simulated(), {-0.001, 0.0}, 3), std::invalid_argument);
  EXPECT_THROW(InaccurateSource(simulated(), {0.0, std::nan("")}, 3), std::invalid_argument);
}

TEST(InaccurateSource, WithoutErrorsIsTheSimulation) {
  InaccurateSource source(simulated(), {}, 3);
  EXPECT_TRUE(same(ranges(captured(source, looking, 2)), ranges(captured(*simulated(), looking, 2))));
  EXPECT_EQ(source.describe().max_range, simulated()->describe().max_range);
}

}  // namespace
}  // namespace nextview
