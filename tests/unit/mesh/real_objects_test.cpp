#include <gtest/gtest.h>

#include <chrono>
#include <iostream>

#include "core/mesh/mesh_file.hpp"

namespace nextview {
namespace {

TriangleMesh load_and_report(const std::filesystem::path& file) {
  const auto start = std::chrono::steady_clock::now();
  TriangleMesh mesh = load_mesh(file);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  std::cout << file.filename().string() << ": " << mesh.triangles.size() << " triangles, " << topology(mesh).summary()
            << ", loaded in " << took.count() << " ms\n";
  return mesh;
}

TEST(RealObjects, theGearboxHousing) {
  const std::filesystem::path file = "/usr/share/opencascade/data/stl/TR12J_OCC.stl";
  if (!std::filesystem::exists(file))
    FAIL() << file << " is not there; it comes with Debian's package occt-misc, which app/setup installs";
  const TriangleMesh mesh = load_and_report(file);
  EXPECT_EQ(mesh.triangles.size(), 26966u);  // as its header says
  EXPECT_TRUE(topology(mesh).watertight());
  EXPECT_NEAR(mesh.bounding_box().sizes().maxCoeff(), 0.5, 1e-7);
}

TEST(RealObjects, theBunny) {
  const std::filesystem::path file = "/usr/share/glmark2/models/bunny.obj";
  if (!std::filesystem::exists(file))
    FAIL() << file << " is not there; it comes with Debian's package glmark2-data, which app/setup installs";
  const TriangleMesh mesh = load_and_report(file);
  EXPECT_EQ(mesh.triangles.size(), 69666u);  // the number of its lines that begin with f
  EXPECT_NEAR(mesh.bounding_box().sizes().maxCoeff(), 0.5, 1e-7);
}

}  // namespace
}  // namespace nextview
