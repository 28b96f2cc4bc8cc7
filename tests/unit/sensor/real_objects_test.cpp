#include <gtest/gtest.h>

#include <chrono>
#include <iostream>

#include "core/mesh/mesh_file.hpp"
#include "core/sensor/depth_camera.hpp"

namespace nextview {
namespace {

class RealObjects : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(RealObjects, areSeenWithoutHoles) {
  const auto& [file, package] = GetParam();
  if (!std::filesystem::exists(file))
    FAIL() << file << " is not there; it comes with Debian's package " << package << ", which app/setup installs";
  const TriangleMesh mesh = load_mesh(file);
  const MeshRayCaster scene(mesh);
  const DepthCamera camera{DepthCameraConfig{}};
  const auto start = std::chrono::steady_clock::now();
  const DepthImage image = camera.sense_ideal(scene, look_at({0.5, 0.6, 0.45}, Vector3::Zero()));
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  int seen = 0, pinholes = 0;
  const int width = image.camera.width;
  const auto hit = [&](int pixel) { return DepthImage::is_range(image.range[pixel]); };
  for (int pixel = width + 1; pixel < width * (image.camera.height - 1) - 1; ++pixel) {
    seen += hit(pixel);
    pinholes += !hit(pixel) && hit(pixel - 1) && hit(pixel + 1) && hit(pixel - width) && hit(pixel + width);
  }
  std::cout << std::filesystem::path(file).filename().string() << ": " << mesh.triangles.size() << " triangles, "
            << seen << " pixels in " << took.count() << " ms\n";
  EXPECT_GT(seen, 20'000);
  EXPECT_EQ(pinholes, 0);
}

INSTANTIATE_TEST_SUITE_P(All, RealObjects,
                         testing::Values(std::pair{"/usr/share/opencascade/data/stl/TR12J_OCC.stl", "occt-misc"},
                                         std::pair{"/usr/share/glmark2/models/bunny.obj", "glmark2-data"}));

}  // namespace
}  // namespace nextview
