#include "core/evaluation/missed_surface.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "tests/unit/map/closed_meshes.hpp"

namespace nextview {
namespace {

TriangleMesh box() { return closed_meshes::box({-0.2, -0.1, -0.05}, {0.2, 0.1, 0.05}); }

PointCloud points_near(const TriangleMesh& mesh, unsigned seed, int count) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.0f, 0.003f);
  std::uniform_real_distribution<float> share(0.0f, 1.0f);
  PointCloud points;
  for (int i = 0; i < count; ++i) {
    const auto& [a, b, c] = mesh.triangles[random() % (mesh.triangles.size() / 2)];  // half of the surface only
    const float u = share(random), v = share(random) * (1.0f - u);
    points.push_back((1.0f - u - v) * mesh.vertices[a] + u * mesh.vertices[b] + v * mesh.vertices[c] +
                     Eigen::Vector3f(noise(random), noise(random), noise(random)));
  }
  return points;
}

TEST(MissedSurface, AgreesWithAllPairs) {
  for (const double d_reg : {0.005, 0.02}) {
    MissedSurface surface(box(), d_reg);
    EXPECT_EQ(surface.d_reg(), d_reg);
    EXPECT_LE(surface.longest_edge(), 1.5 * d_reg);
    ASSERT_EQ(surface.observed().size(), surface.mesh()->vertices.size());
    PointCloud all;
    for (unsigned view = 1; view <= 3; ++view) {
      const PointCloud points = points_near(box(), view, 400);
      surface.add(points);
      all.insert(all.end(), points.begin(), points.end());
      std::size_t seen = 0;
      for (std::size_t v = 0; v < surface.observed().size(); ++v) {
        bool near = false;
        for (const auto& p : all)
          near |= (p.cast<double>() - surface.mesh()->vertices[v].cast<double>()).squaredNorm() <= d_reg * d_reg;
        ASSERT_EQ(surface.observed()[v] != 0, near) << v;
        seen += near;
      }
      EXPECT_GT(seen, 50u);
      EXPECT_LT(seen, surface.observed().size());
    }
  }
}

TEST(MissedSurface, IsAsFineAsItsBoundAllows) {
  const MissedSurface fine(box(), 0.002), coarse(box(), 0.002, 5000), finest(box(), 1e-6);
  EXPECT_NEAR(fine.longest_edge(), 0.003, 1e-12);
  EXPECT_LE(coarse.mesh()->triangles.size(), 5000u);
  EXPECT_GT(coarse.mesh()->triangles.size(), 1200u) << "four times as many would be too many";
  EXPECT_GT(coarse.longest_edge(), 0.003);
  EXPECT_LE(finest.mesh()->triangles.size(), 400'000u);
  EXPECT_GT(finest.mesh()->triangles.size(), 100'000u);
  const TriangleMesh large = closed_meshes::sphere(Vector3::Zero(), 0.2, 5);
  EXPECT_EQ(MissedSurface(large, 1e-4, 1000).mesh()->triangles, large.triangles) << "over the bound: as it is";
  for (const MissedSurface* s : {&fine, &coarse, &finest})
    for (const auto& t : s->mesh()->triangles)
      for (int k = 0; k < 3; ++k)
        ASSERT_LE(
            (s->mesh()->vertices[t[k]].cast<double>() - s->mesh()->vertices[t[(k + 1) % 3]].cast<double>()).norm(),
            s->longest_edge() * (1.0 + 1e-6));
}

TEST(MissedSurface, RefusesNothingToLookAt) {
  EXPECT_THROW(MissedSurface({}, 0.005), std::invalid_argument);
  for (const double bad : {0.0, -1.0, std::nan(""), double(INFINITY)})
    EXPECT_THROW(MissedSurface(box(), bad), std::invalid_argument) << bad;
}

}  // namespace
}  // namespace nextview
