#include <gtest/gtest.h>

#include "core/mesh/parts.hpp"
#include "core/progress/stopped.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {
namespace {

TEST(StoppingTheCamera, NothingIsGivenByHalves) {
  std::stop_source stop;
  stop.request_stop();
  const TriangleMesh mesh = sphere_part().mesh;
  EXPECT_THROW(MeshRayCaster(mesh, stop.get_token()), Stopped);
  DepthCameraConfig config;
  EXPECT_THROW(DepthCamera(config, stop.get_token()), Stopped);
  const MeshRayCaster scene(mesh);
  const DepthCamera camera(config);
  const Pose view = look_at({0.9, 0.0, 0.0}, Vector3::Zero());
  EXPECT_THROW(camera.sense(scene, view, 1, 1, stop.get_token()), Stopped);
  EXPECT_THROW(camera.sense_ideal(scene, view, stop.get_token()), Stopped);
  EXPECT_EQ(camera.sense(scene, view, 1, 1).range.size(), 640u * 480u);
}

}  // namespace
}  // namespace nextview
