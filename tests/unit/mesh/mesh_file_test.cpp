#include "core/mesh/mesh_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/mesh/tetrahedron_files.hpp"

namespace nextview {
namespace {

namespace files = tetrahedron_files;

/// Each triangle's corners as an unordered list of lists, starting with the smallest corner: order and numbering do not
/// matter.
std::vector<std::array<std::array<float, 3>, 3>> shape(const TriangleMesh& mesh) {
  std::vector<std::array<std::array<float, 3>, 3>> triangles;
  for (const auto& triangle : mesh.triangles) {
    std::array<std::array<float, 3>, 3> corners;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3f& v = mesh.vertices.at(triangle[i]);
      corners[i] = {v.x(), v.y(), v.z()};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.push_back(corners);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// The tetrahedron moved so that its box is centred, times `scale`.
TriangleMesh expected(float scale) {
  TriangleMesh mesh;
  for (const auto& c : files::corners)
    mesh.vertices.push_back(scale * Eigen::Vector3f(c[0] - 1, c[1] - 1.5f, c[2] - 2));
  mesh.triangles.assign(files::faces.begin(), files::faces.end());
  return mesh;
}

TEST(MeshFile, everyTypeGivesTheSameShape) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : files::all()) {
    const auto file = folder.write(name, bytes);
    // 3MF has millimetres in its header, yet Assimp hands the numbers on as they are.
    EXPECT_EQ(shape(load_mesh(file, {.up = UpAxis::z})), shape(expected(0.125f))) << name;
    EXPECT_EQ(shape(load_mesh(file, {.longest_side = 0.0, .unit = LengthUnit::metres, .up = UpAxis::z})),
              shape(expected(1.0f)))
        << name;
    EXPECT_EQ(load_mesh(file).vertices.size(), 4u) << name << ": corners at one place are one vertex";
    EXPECT_EQ(topology(load_mesh(file)).summary(), "watertight") << name;
  }
}

TEST(MeshFile, extensionsMayBeInCapitals) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_mesh(folder.write("A.STL", files::stl_binary())).triangles.size(), 4u);
}

TEST(MeshFile, theLongestSideIsAsAskedAndTheBoxIsCentred) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.obj", files::obj());
  const Eigen::AlignedBox3d box = load_mesh(file, {.longest_side = 0.7}).bounding_box();
  EXPECT_LT((box.sizes() - Eigen::Vector3d(0.35, 0.525, 0.7)).norm(), 1e-7);
  EXPECT_LT(box.center().norm(), 1e-8);
  for (const double wrong : {-1.0, std::nan(""), HUGE_VAL, 1e9})
    EXPECT_THROW(load_mesh(file, {.longest_side = wrong}), std::invalid_argument) << wrong;
}

TEST(MeshFile, itStaysWhereTheFileHasItIfAsked) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.obj", files::obj());
  TriangleMesh as_in_file;
  for (const auto& c : files::corners) as_in_file.vertices.emplace_back(c[0], c[1], c[2]);
  as_in_file.triangles.assign(files::faces.begin(), files::faces.end());
  const PlacedMesh kept = load_placed_mesh(file, {.longest_side = 0.0, .centred = false});
  EXPECT_EQ(shape(kept.mesh), shape(as_in_file));
  EXPECT_EQ(kept.placement(Eigen::Vector3d(1, 2, 3)), Eigen::Vector3d(1, 2, 3));
  for (Eigen::Vector3f& vertex : as_in_file.vertices) vertex *= 0.125f;  // scaled about the file's origin
  EXPECT_EQ(shape(load_mesh(file, {.centred = false})), shape(as_in_file));
}

TEST(MeshFile, theAxisThatPointsUpBecomesZ) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.obj", files::obj());
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  for (const auto& [up, axis] : {std::pair{UpAxis::automatic, z},
                                 {UpAxis::z, z},
                                 {UpAxis::y, y},
                                 {UpAxis::x, x},
                                 {UpAxis::minus_z, Vector3(-z)},
                                 {UpAxis::minus_y, Vector3(-y)},
                                 {UpAxis::minus_x, Vector3(-x)}}) {
    const PlacedMesh turned = load_placed_mesh(file, {.longest_side = 0.0, .up = up, .centred = false});
    const auto& to_world = turned.placement;
    EXPECT_EQ(to_world(axis), z);
    EXPECT_EQ(to_world(x).cross(to_world(y)), to_world(z)) << "nothing is mirrored";
    TriangleMesh by_hand = load_mesh(file, {.longest_side = 0.0, .centred = false});
    for (Eigen::Vector3f& vertex : by_hand.vertices) vertex = to_world(vertex.cast<double>()).cast<float>();
    EXPECT_EQ(shape(turned.mesh), shape(by_hand));
  }
}

TEST(MeshFile, inGltfAndX3dYIsUpUnlessSomeoneSaysOtherwise) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : files::all()) {
    const bool by_type = name.ends_with(".gltf") || name.ends_with(".glb") || name.ends_with(".x3d");
    const auto file = folder.write(name, bytes);
    EXPECT_EQ(shape(load_mesh(file)), shape(load_mesh(file, {.up = by_type ? UpAxis::y : UpAxis::z}))) << name;
    EXPECT_NE(shape(load_mesh(file, {.up = UpAxis::y})), shape(load_mesh(file, {.up = UpAxis::z}))) << name;
  }
}

TEST(MeshFile, theGroundLiesUnderTheLowestPointAndIsNoPartOfTheMesh) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.obj", files::obj());
  EXPECT_EQ(shape(load_placed_mesh(file).surroundings()), shape(expected(0.125f)));
  const PlacedMesh standing = load_placed_mesh(file, {.ground = true});
  EXPECT_EQ(shape(standing.mesh), shape(expected(0.125f)));
  const TriangleMesh all = standing.surroundings();
  ASSERT_EQ(all.triangles.size(), standing.mesh.triangles.size() + 2);
  EXPECT_TRUE(std::equal(standing.mesh.triangles.begin(), standing.mesh.triangles.end(), all.triangles.begin()));
  const Eigen::AlignedBox3d box = all.bounding_box();
  EXPECT_NEAR(box.min().z(), -0.25, 1e-7) << "the tetrahedron is 0.5 m high and centred";
  EXPECT_NEAR(box.max().z(), 0.25, 1e-7);
  EXPECT_GE(box.sizes().head<2>().minCoeff(), 2000.0);
}

TEST(MeshFile, transformsOfNodesAreJoined) {
  const TemporaryFolder folder;
  folder.write("buffer.bin", files::gltf_buffer());
  // Two copies: one moved by 10 along x, one mirrored in x. Both below a root that doubles everything.
  const auto file = folder.write("scene.gltf", files::gltf(R"("uri": "buffer.bin", )", R"([
    {"children": [1, 2], "scale": [2, 2, 2]}, {"mesh": 0, "translation": [10, 0, 0]}, {"mesh": 0, "scale": [-1, 1, 1]}])"));
  const TriangleMesh mesh = load_mesh(file, {.longest_side = 0.0, .up = UpAxis::z});
  EXPECT_EQ(mesh.triangles.size(), 8u);
  EXPECT_LT((mesh.bounding_box().sizes() - Eigen::Vector3d(2 * (12 + 2), 2 * 3, 2 * 4)).norm(), 1e-5);
  // The mirrored copy is not inside out.
  EXPECT_EQ(topology(mesh).summary(), "watertight");
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    six_volumes += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c]));
  EXPECT_NEAR(six_volumes, 2 * 8 * (2 * 3 * 4), 1e-3);
}

TEST(MeshFile, polygonsBecomeTrianglesPointsAndLinesGo) {
  const TemporaryFolder folder;
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nv 0.5 0.25 0\n";
  const TriangleMesh quad = load_mesh(folder.write("quad.obj", corners + "f 1 2 3 4\nl 1 5\np 5\n"));
  EXPECT_EQ(quad.triangles.size(), 2u);
  EXPECT_EQ(quad.vertices.size(), 4u) << "what no triangle uses does not count, not for the size either";
  EXPECT_NEAR(quad.surface_area(), 0.25, 1e-7);
  // A dent makes a concave polygon: a fan from its first corner would cover too much.
  const TriangleMesh dented = load_mesh(folder.write("dented.obj", corners + "f 2 3 4 1 6\n"));
  EXPECT_NEAR(dented.surface_area(), 0.25 * (1.0 - 0.5 * 0.25), 1e-6);
}

TEST(MeshFile, degenerateTrianglesAreDropped) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = load_mesh(folder.write("t.obj", files::obj() + "v 0 6 0\nf 1 1 2\nf 1 3 5\n"));
  EXPECT_EQ(shape(mesh), shape(expected(0.125f)));
}

TEST(MeshFile, oneTriangleIsEnough) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = load_mesh(folder.write("one.obj", "v 0 0 0\nv 4 0 0\nv 0 2 0\nf 1 2 3\n"));
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(topology(mesh).summary(), "not watertight: 3 boundary edges");
  EXPECT_NEAR(mesh.surface_area(), 0.5 * 0.5 * 0.25, 1e-9);
}

TEST(MeshFile, inwardAndMixedNormalsAreTolerated) {
  const TemporaryFolder folder;
  std::string inward = files::obj().substr(0, files::obj().find("f "));
  for (const auto& f : files::faces)
    inward += "f " + std::to_string(f[2] + 1) + " " + std::to_string(f[1] + 1) + " " + std::to_string(f[0] + 1) + "\n";
  EXPECT_EQ(topology(load_mesh(folder.write("inward.obj", inward))).summary(), "watertight: normals point inwards");
  std::string mixed = files::obj();
  mixed.replace(mixed.find("f 1 3 2"), 7, "f 1 2 3");
  EXPECT_EQ(topology(load_mesh(folder.write("mixed.obj", mixed))).misoriented_edges, 3u);
}

TEST(MeshFile, anySizeIsScaledAsLongAsTheShapeSurvives) {
  const TemporaryFolder folder;
  for (const char* exponent : {"e9", "e30", "e-30"}) {
    std::string text = "v 0 0 0\nv 2? 0 0\nv 0 3? 0\nv 0 0 4?\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    for (std::size_t at; (at = text.find('?')) != std::string::npos;) text.replace(at, 1, exponent);
    const TriangleMesh mesh = load_mesh(folder.write("t.obj", text));
    EXPECT_LT((mesh.bounding_box().sizes() - Eigen::Vector3d(0.25, 0.375, 0.5)).norm(), 1e-6) << exponent;
  }
}

}  // namespace
}  // namespace nextview
