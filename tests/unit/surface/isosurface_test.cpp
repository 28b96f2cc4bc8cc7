#include "core/surface/isosurface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tests/unit/surface/surface_checks.hpp"

namespace nextview {
namespace {

using surface_checks::closed;
using surface_checks::euler_characteristic;
using surface_checks::signed_volume;
using surface_checks::with_threads;

/// A field on a lattice that is longer along x than along y, and along y than along z: `value(point)` [m].
template <class Value>
ScalarField sampled(double spacing, const Vector3& lower, const Vector3& upper, Value value) {
  ScalarField field;
  field.size = ((upper - lower) / spacing).array().ceil().matrix().cast<int>() + Eigen::Vector3i::Ones();
  field.origin = lower;
  field.spacing = spacing;
  for (int z = 0; z < field.size.z(); ++z)
    for (int y = 0; y < field.size.y(); ++y)
      for (int x = 0; x < field.size.x(); ++x) field.values.push_back(float(value(lower + spacing * Vector3(x, y, z))));
  return field;
}

const Vector3 lower(-0.213, -0.171, -0.142), upper(0.205, 0.18, 0.139);
const Vector3 centre(0.0131, -0.0074, 0.0037);

double sphere(const Vector3& p) { return 0.1 - (p - centre).norm(); }
double torus(const Vector3& p) {
  const Vector3 q = p - centre;
  return 0.04 - std::hypot(std::hypot(q.x(), q.y()) - 0.11, q.z());
}
const Vector3 half_box(0.1517, 0.1032, 0.0721);
double box(const Vector3& p) {
  const Vector3 q = (p - centre).cwiseAbs() - half_box;
  return -q.cwiseMax(0.0).norm() - std::min(0.0, q.maxCoeff());
}

double farthest(const TriangleMesh& mesh, double (*distance)(const Vector3&)) {
  double most = 0.0;
  for (const auto& v : mesh.vertices) most = std::max(most, std::abs(distance(v.cast<double>())));
  return most;
}

// A signed distance has second derivatives of at most 1 / (radius of curvature); between two points `h` apart a
// straight line is at most h^2 / 8 times that off, and the field itself says how far off a vertex is.
TEST(Isosurface, VerticesOfASphereLieWithinTheErrorOfStraightLines) {
  for (const double h : {0.02, 0.01, 0.005}) {
    const TriangleMesh mesh = isosurface(sampled(h, lower, upper, sphere), 0.0f);
    EXPECT_TRUE(closed(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 2);
    EXPECT_LE(farthest(mesh, sphere), h * h / 8.0 / (0.1 - h) + 1e-7) << h;
    const double volume = 4.0 / 3.0 * std::numbers::pi * 1e-3, area = 4.0 * std::numbers::pi * 1e-2;
    EXPECT_NEAR(signed_volume(mesh) / volume, 1.0, 60.0 * h * h) << h;
    EXPECT_NEAR(mesh.surface_area() / area, 1.0, 60.0 * h * h) << h;
  }
}

TEST(Isosurface, VerticesOfATorusLieWithinTheErrorOfStraightLines) {
  for (const double h : {0.02, 0.01, 0.005}) {
    const TriangleMesh mesh = isosurface(sampled(h, lower, upper, torus), 0.0f);
    EXPECT_TRUE(closed(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 0);
    EXPECT_LE(farthest(mesh, torus), h * h / 8.0 / (0.04 - h) + 1e-7) << h;
    const double volume = 2.0 * std::numbers::pi * std::numbers::pi * 0.11 * 0.04 * 0.04;
    EXPECT_NEAR(signed_volume(mesh) / volume, 1.0, 400.0 * h * h) << h;
  }
}

TEST(Isosurface, OnlyEdgesOfABoxAreCut) {
  for (const double h : {0.02, 0.01, 0.005}) {
    const TriangleMesh mesh = isosurface(sampled(h, lower, upper, box), 0.0f);
    EXPECT_TRUE(closed(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 2);
    for (const auto& v : mesh.vertices) {
      const Vector3 beside = half_box - (v.cast<double>() - centre).cwiseAbs();
      const int near = int((beside.array() < 1.01 * h).count());
      if (near == 1) {
        ASSERT_LT(std::abs(box(v.cast<double>())), 1e-6) << "in the middle of a face, spacing " << h;
      }
    }
    EXPECT_LT(farthest(mesh, box), 0.5 * h);
    const Vector3 s = 2.0 * half_box;
    const double edges = 4.0 * s.sum();
    EXPECT_NEAR(signed_volume(mesh), s.prod(), 0.5 * h * h * edges) << h;  // what is cut off along the edges
  }
}

TEST(Isosurface, LargerValuesAreInsideAtAnyLevel) {
  const ScalarField field = sampled(0.01, lower, upper, [](const Vector3& p) { return 0.5 + 2.0 * sphere(p); });
  const TriangleMesh small = isosurface(field, 0.54f), large = isosurface(field, 0.46f);
  EXPECT_NEAR(signed_volume(small), 4.0 / 3.0 * std::numbers::pi * std::pow(0.08, 3), 4e-5);
  EXPECT_NEAR(signed_volume(large), 4.0 / 3.0 * std::numbers::pi * std::pow(0.12, 3), 8e-5);
  ScalarField outside_in = field;
  for (float& v : outside_in.values) v = 1.0f - v;
  EXPECT_LT(signed_volume(isosurface(outside_in, 0.5f)), 0.0);
}

ScalarField random_field(std::mt19937& random, const Eigen::Vector3i& size, double share_inside) {
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  ScalarField field;
  field.size = size;
  field.spacing = 1.0;
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x) {
        const Eigen::Vector3i p(x, y, z);
        const bool border = (p.array() == 0).any() || (p.array() == size.array() - 1).any();
        const bool inside = !border && uniform(random) < share_inside;
        field.values.push_back((inside ? 0.501f : 0.0f) + 0.499f * uniform(random));
      }
  return field;
}

TEST(Isosurface, RandomFieldsAreWatertightWithEveryVertexOnceOnAnEdgeOfTheLattice) {
  std::mt19937 random(1);
  for (int n = 0; n < 400; ++n) {
    const ScalarField field = random_field(random, {9, 8, 7}, 0.1 + 0.2 * (n % 5));
    const TriangleMesh mesh = isosurface(field, 0.5f);
    if (mesh.triangles.empty()) continue;
    ASSERT_TRUE(closed(mesh)) << "field " << n;
    std::set<std::array<float, 3>> places;
    for (const auto& v : mesh.vertices) {
      places.insert({v.x(), v.y(), v.z()});
      const Eigen::Array3f off = (v.array() - v.array().round()).abs();
      ASSERT_GE((off < 1e-5f).count(), 2) << v.transpose();
    }
    ASSERT_EQ(places.size(), mesh.vertices.size()) << "field " << n;
  }
}

TEST(Isosurface, EveryEdgeOfTheLatticeThatCrossesTheLevelHasItsVertexWhereTheLineIsAtTheLevel) {
  std::mt19937 random(2);
  const ScalarField field = random_field(random, {11, 9, 8}, 0.5);
  std::set<std::array<int, 3>> expected, found;  // in thousandths of the spacing
  for (int z = 0; z < field.size.z(); ++z)
    for (int y = 0; y < field.size.y(); ++y)
      for (int x = 0; x < field.size.x(); ++x)
        for (int axis = 0; axis < 3; ++axis) {
          const Eigen::Vector3i p(x, y, z), q = p + Eigen::Vector3i::Unit(axis);
          if (q[axis] == field.size[axis]) continue;
          const double a = field.values[field.index(p)], b = field.values[field.index(q)];
          if ((a < 0.5) == (b < 0.5)) continue;
          const Vector3 at = p.cast<double>() + (0.5 - a) / (b - a) * Vector3::Unit(axis);
          expected.insert(
              {int(std::lround(1e3 * at.x())), int(std::lround(1e3 * at.y())), int(std::lround(1e3 * at.z()))});
        }
  const TriangleMesh mesh = isosurface(field, 0.5f);
  std::size_t strange = 0;
  for (const auto& v : mesh.vertices) {
    const std::array<int, 3> at{int(std::lround(1e3f * v.x())), int(std::lround(1e3f * v.y())),
                                int(std::lround(1e3f * v.z()))};
    found.insert(at);
    strange += !expected.contains(at);
  }
  EXPECT_LE(strange, mesh.vertices.size() / 100);  // rounding to the next thousandth
  EXPECT_EQ(mesh.vertices.size(), expected.size());
}

TEST(Isosurface, EndsAtTheLatticesBorderWherePointsThereAreInside) {
  const TriangleMesh mesh = isosurface(sampled(0.01, Vector3(0.0131, -0.2, -0.2), upper, sphere), 0.0f);
  const MeshTopology t = topology(mesh);
  EXPECT_GT(t.boundary_edges, 0u);
  EXPECT_EQ(t.misoriented_edges + t.non_manifold_edges, 0u);
}

TEST(Isosurface, NothingCrossesTheLevelNothingIsMade) {
  ScalarField field;
  field.size = {4, 5, 6};
  field.values.assign(120, 1.0f);
  EXPECT_TRUE(isosurface(field, 0.5f).triangles.empty());
  EXPECT_TRUE(isosurface(field, 0.5f).vertices.empty());
  EXPECT_TRUE(isosurface(ScalarField{}, 0.5f).triangles.empty()) << "a lattice without points";
}

TEST(Isosurface, RefusesValuesThatAreNotTheLattices) {
  ScalarField field;
  field.size = {4, 5, 6};
  field.values.assign(119, 1.0f);
  EXPECT_THROW(isosurface(field, 0.5f), std::invalid_argument);
  field.values.assign(121, 1.0f);
  EXPECT_THROW(isosurface(field, 0.5f), std::invalid_argument);
}

TEST(Isosurface, RefusesANegativeNumberOfPoints) {
  ScalarField field;
  field.size = {-4, -5, 6};
  field.values.assign(120, 1.0f);
  EXPECT_THROW(isosurface(field, 0.5f), std::invalid_argument);
}

TEST(Isosurface, SameBytesOnOneAndTwoThreads) {
  std::mt19937 random(3);
  const ScalarField field = random_field(random, {70, 60, 50}, 0.4);
  const auto make = [&] { return isosurface(field, 0.5f); };
  const TriangleMesh one = with_threads(1, make), two = with_threads(2, make);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.triangles, two.triangles);
}

}  // namespace
}  // namespace nextview
