#include "core/evaluation/accuracy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace nextview {
namespace {

/// Triangles thrown at random, of all sizes, some of them degenerate (two or three corners in one place, or on a line).
TriangleMesh random_triangles(unsigned seed, int count) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> side(-0.5f, 0.5f);
  TriangleMesh mesh;
  for (int t = 0; t < count; ++t) {
    const Eigen::Vector3f a(side(generator), side(generator), side(generator));
    const float size = std::pow(10.0f, 2.0f * side(generator) - 1.0f);
    const auto corner = [&]() -> Eigen::Vector3f {
      return a + size * Eigen::Vector3f(side(generator), side(generator), side(generator));
    };
    const Eigen::Vector3f b = t % 10 == 0 ? a : corner();
    const Eigen::Vector3f c = t % 20 == 0 ? a : t % 7 == 0 ? Eigen::Vector3f(2.0f * b - a) : corner();
    const auto first = std::uint32_t(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// The least squared distance from p to a point of the triangle, by the seven Voronoi regions solved as a small
/// quadratic programme: the best of all combinations of corners that may be active.
double twin_distance(const Vector3& p, const std::array<Vector3, 3>& corners) {
  double best = INFINITY;
  for (int active = 1; active < 8; ++active) {  // minimise |sum w_i c_i - p|^2 over the active corners, sum w_i = 1
    std::vector<Vector3> c;
    for (int k = 0; k < 3; ++k)
      if (active >> k & 1) c.push_back(corners[std::size_t(k)]);
    Eigen::VectorXd w = Eigen::VectorXd::Zero(Eigen::Index(c.size()));
    w[0] = 1.0;
    if (c.size() > 1) {
      Eigen::MatrixXd edges(3, Eigen::Index(c.size()) - 1);
      for (std::size_t k = 1; k < c.size(); ++k) edges.col(Eigen::Index(k) - 1) = c[k] - c[0];
      w.tail(Eigen::Index(c.size()) - 1) = edges.colPivHouseholderQr().solve(p - c[0]);
      w[0] -= w.tail(Eigen::Index(c.size()) - 1).sum();
    }
    if (!(w.minCoeff() >= 0.0)) continue;
    Vector3 at = Vector3::Zero();
    for (std::size_t k = 0; k < c.size(); ++k) at += w[Eigen::Index(k)] * c[k];
    best = std::min(best, (at - p).norm());
  }
  return best;
}

double twin_distance(const Vector3& p, const TriangleMesh& mesh) {
  double best = INFINITY;
  for (const auto& [a, b, c] : mesh.triangles)
    best = std::min(best, twin_distance(p, {mesh.vertices[a].cast<double>(), mesh.vertices[b].cast<double>(),
                                            mesh.vertices[c].cast<double>()}));
  return best;
}

TEST(MeshDistance, AgreesWithEveryTriangleTriedInTurn) {
  std::mt19937 generator(21);
  std::uniform_real_distribution<float> side(-0.8f, 0.8f);
  for (const int triangles : {1, 2, 5, 300}) {
    const TriangleMesh mesh = random_triangles(unsigned(triangles), triangles);
    const MeshDistance distance(mesh);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3f p(side(generator), side(generator), side(generator));
      ASSERT_NEAR(distance(p), twin_distance(p.cast<double>(), mesh), 1e-7)
          << triangles << " triangles, point " << p.transpose();
    }
    EXPECT_NEAR(distance(mesh.vertices[0]), 0.0, 1e-12);
  }
}

TEST(MeshDistance, ManyTrianglesInOnePlaceAndPointsFarAway) {
  TriangleMesh mesh = random_triangles(5, 1);
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.assign(1000, {0, 1, 2});
  const MeshDistance distance(mesh);
  EXPECT_NEAR(distance({0.2f, 0.2f, -0.75f}), 0.75, 1e-12);
  EXPECT_NEAR(distance({1.0f, 1.0f, 0.0f}), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(distance({-1e6f, 0.0f, 0.0f}), 1e6, 1e-6);
  EXPECT_THROW(MeshDistance{TriangleMesh{}}, std::invalid_argument);
}

TEST(Accuracy, SummarisesAsDefined) {
  std::vector<double> distances;
  for (int i = 1; i <= 40; ++i) distances.push_back(0.001 * ((7 * i) % 41));  // 1 to 40 mm, shuffled
  const Accuracy a = summarise(distances);
  EXPECT_EQ(a.points, 40u);
  EXPECT_NEAR(a.mean, 0.0205, 1e-12);
  EXPECT_NEAR(a.rms, 0.001 * std::sqrt(41.0 * 81.0 / 6.0), 1e-12);
  EXPECT_NEAR(a.percentile_95, 0.038, 1e-12);  // 38 of 40 are 95 %
  EXPECT_DOUBLE_EQ(summarise(std::vector<double>{0.3}).percentile_95, 0.3);
  EXPECT_DOUBLE_EQ(summarise(std::vector<double>(21, 0.2)).percentile_95, 0.2);
}

TEST(Accuracy, OfPointsBesideASquare) {
  TriangleMesh square;
  square.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const PointCloud cloud = {{0.1f, 0.2f, 0.25f}, {0.5f, -0.5f, -0.5f}, {1.75f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
  const MeshDistance surface(square);
  EXPECT_EQ(distances(cloud, surface), (std::vector<double>{0.25, 0.5, 0.75, 0.0}));
  const Accuracy a = accuracy(cloud, surface);
  EXPECT_DOUBLE_EQ(a.mean, 0.375);
  EXPECT_DOUBLE_EQ(a.rms, std::sqrt(0.21875));
  EXPECT_DOUBLE_EQ(a.percentile_95, 0.75);
}

TEST(Accuracy, OfNoPointsIsUndefined) {
  const Accuracy a = summarise({});
  EXPECT_EQ(a.points, 0u);
  EXPECT_TRUE(std::isnan(a.mean) && std::isnan(a.rms) && std::isnan(a.percentile_95));
}

}  // namespace
}  // namespace nextview
