#include "core/mesh/parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/mesh/mesh_file.hpp"
#include "tests/unit/mesh/own_objects.hpp"

namespace nextview {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file << " is missing; make_objects writes it";
  return {std::istreambuf_iterator<char>(in), {}};
}

double volume(const TriangleMesh& mesh) {
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    six_volumes +=
        mesh.vertices[a].cast<double>().dot(mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>()));
  return six_volumes / 6.0;
}

double bores_area(double corners) {
  double area = 0.0;
  for (const double radius : {0.005, 0.010, 0.015, 0.020})
    area += corners / 2 * radius * radius * std::sin(2 * std::numbers::pi / corners);
  return area;
}

struct Expected {
  Part part;
  Eigen::Vector3d size;  // [m]
  double volume;         // [m^3]
};

class Parts : public testing::TestWithParam<Expected> {};

TEST_P(Parts, theCommittedFileIsWhatTheGeneratorMakes) {
  const Part& part = GetParam().part;
  EXPECT_EQ(content(own_objects / (part.name + ".ply")), ply_bytes(part.mesh));
  if (part.openings.empty()) return;
  EXPECT_EQ(content(own_objects / (part.name + ".json")), openings_json(part));
}

TEST_P(Parts, loadsUnchangedAtItsTrueSize) {
  const Part& part = GetParam().part;
  for (const double longest_side : {0.5, 0.0}) {
    const TriangleMesh loaded = load_mesh(own_objects / (part.name + ".ply"), {.longest_side = longest_side});
    ASSERT_EQ(loaded.triangles.size(), part.mesh.triangles.size());
    for (std::size_t t = 0; t < loaded.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i)
        ASSERT_EQ(loaded.vertices[loaded.triangles[t][i]], part.mesh.vertices[part.mesh.triangles[t][i]]);
    EXPECT_EQ(loaded.vertices.size(), part.mesh.vertices.size());
    EXPECT_EQ(topology(loaded).summary(), "watertight");
  }
}

TEST_P(Parts, sizeAndVolumeAreExact) {
  const auto& [part, size, expected_volume] = GetParam();
  const Eigen::AlignedBox3d box = part.mesh.bounding_box();
  EXPECT_LT((box.sizes() - size).norm(), 1e-7);
  EXPECT_EQ(box.sizes().maxCoeff(), 0.5);
  EXPECT_EQ(box.center(), Eigen::Vector3d(0, 0, 0));
  EXPECT_NEAR(volume(part.mesh) / expected_volume, 1.0, 1e-6);
}

const double plate_holes = 0.12 * (0.01 + 0.02 + 0.03 + 0.04) + bores_area(64);
const double housing_holes = 0.15 * (0.01 + 0.02 + 0.03 + 0.04) + bores_area(64);
INSTANTIATE_TEST_SUITE_P(
    All, Parts,
    testing::Values(Expected{slotted_plate(), {0.5, 0.306, 0.03}, (0.5 * 0.306 - plate_holes) * 0.03},
                    Expected{slotted_housing(),
                             {0.5, 0.367, 0.314},
                             0.5 * 0.367 * 0.314 - 0.46 * 0.327 * 0.294 - housing_holes * 0.02},
                    Expected{box_part(), {0.5, 0.331, 0.247}, 0.5 * 0.331 * 0.247}),
    [](const auto& each) { return each.param.part.name; });

TEST(SpherePart, isWithinItsFacetsOfASphere) {
  const Part part = sphere_part();
  EXPECT_EQ(content(own_objects / "sphere.ply"), ply_bytes(part.mesh));
  EXPECT_EQ(part.mesh.triangles.size(), 20u * 4 * 4 * 4 * 4 * 4);
  EXPECT_EQ(topology(part.mesh).summary(), "watertight");
  EXPECT_EQ(part.mesh.bounding_box().sizes(), Eigen::Vector3d(0.5, 0.5, 0.5));
  for (const Eigen::Vector3f& vertex : part.mesh.vertices) ASSERT_NEAR(vertex.cast<double>().norm(), 0.25, 1e-7);
  double nearest = 1.0;
  for (const auto& [a, b, c] : part.mesh.triangles)
    nearest =
        std::min<double>(nearest, ((part.mesh.vertices[a] + part.mesh.vertices[b] + part.mesh.vertices[c]) / 3).norm());
  // The largest triangles have their corners 6 mm from the middle: 0.006^2 / (2 * 0.25) below the sphere.
  EXPECT_GT(nearest, 0.25 - 7.2e-5);
  EXPECT_NEAR(volume(part.mesh), 4.0 / 3.0 * std::numbers::pi * 0.25 * 0.25 * 0.25,
              7.2e-5 * 4.0 * std::numbers::pi * 0.25 * 0.25);
}

/// How many triangles the segment crosses (Moeller-Trumbore).
int crossings(const TriangleMesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  int count = 0;
  const Eigen::Vector3d d = to - from;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[ia].cast<double>(), ab = mesh.vertices[ib].cast<double>() - a,
                          ac = mesh.vertices[ic].cast<double>() - a, p = d.cross(ac), s = from - a, q = s.cross(ab);
    const double determinant = ab.dot(p);
    if (std::abs(determinant) < 1e-15) continue;
    const double u = s.dot(p) / determinant, v = d.dot(q) / determinant, t = ac.dot(q) / determinant;
    count += u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1;
  }
  return count;
}

class Openings : public testing::TestWithParam<Part> {};

TEST_P(Openings, areWhereTheDescriptionSaysAndNowhereElse) {
  const Part part = GetParam();
  const auto description = nlohmann::json::parse(content(own_objects / (part.name + ".json")));
  ASSERT_EQ(description["openings"].size(), 8u);
  EXPECT_EQ(description["unit"], "m");
  std::map<std::string, std::vector<double>> widths;
  for (const auto& opening : description["openings"]) {
    const auto vector = [&](const char* key) {
      return Eigen::Vector3d(opening[key][0].get<double>(), opening[key][1].get<double>(),
                             opening[key][2].get<double>());
    };
    const Eigen::Vector3d centre = vector("centre"), axis = vector("axis"), along = vector("along"),
                          across = axis.cross(along);
    const double width = opening["width"], length = opening["length"], depth = opening["depth"];
    widths[opening["kind"]].push_back(width);
    const Eigen::Vector3d through = (0.5 * depth + 1e-3) * axis;
    const auto walls = [&](const Eigen::Vector3d& offset) {
      return crossings(part.mesh, centre + offset - through, centre + offset + through);
    };
    for (const double side : {-1.0, 1.0}) {
      // A polygon's edges come as near as cos(pi/64) of its radius.
      EXPECT_EQ(walls(0.498 * side * width * across), 0) << opening;
      EXPECT_EQ(walls(0.498 * side * length * along), 0) << opening;
      EXPECT_EQ(walls(0.502 * side * width * across), 2) << opening;
      EXPECT_EQ(walls(0.502 * side * length * along), 2) << opening;
    }
  }
  for (const char* kind : {"slot", "bore"}) EXPECT_EQ(widths[kind], (std::vector<double>{0.01, 0.02, 0.03, 0.04}));
}

TEST_P(Openings, areNotAlignedWithVoxelsOfACentimetre) {
  for (const Opening& opening : GetParam().openings) {
    const double edge = 100.0 * (opening.centre.x() - 0.5 * opening.width);
    EXPECT_GT(std::abs(edge - std::round(edge)), 0.1) << opening.centre.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(All, Openings, testing::Values(slotted_plate(), slotted_housing()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace nextview
