#include <gtest/gtest.h>

#include "core/mesh/mesh_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/mesh/tetrahedron_files.hpp"

namespace nextview {
namespace {

namespace files = tetrahedron_files;

std::string summary(const std::string& obj) {
  const TemporaryFolder folder;
  return load_placed_mesh(folder.write("t.obj", obj)).topology.summary();
}

/// The tetrahedron with the face 1 3 2 cut in two at the middle 5 of its edge 1 2; the face on the other side is not.
std::string with_t_junction() {
  std::string text = files::obj() + "v 1 0 0\n";
  return text.replace(text.find("f 1 3 2"), 7, "f 1 3 5\nf 5 3 2");
}

TEST(FileTopology, trianglesWithoutAnAreaCloseWhatTheyClose) {
  EXPECT_EQ(summary(files::obj()), "watertight");
  EXPECT_EQ(summary(with_t_junction()), "not watertight: 3 boundary edges");
  EXPECT_EQ(summary(with_t_junction() + "f 1 5 2\n"), "watertight (1 triangle without an area left out)");
}

TEST(FileTopology, trianglesWithoutAnAreaCountWithTheirOpenEdges) {
  // Sixty slivers that touch nothing: a closed part around them is not all that the file has.
  std::string text = files::obj();
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 3; ++k)
      text += "v 0.5 " + std::to_string(0.01 * (i + 1)) + " " + std::to_string(0.5 + k) + "\n";
    text += "f -3 -2 -1\n";
  }
  EXPECT_EQ(summary(text), "not watertight: 180 boundary edges (60 triangles without an area left out)");
}

TEST(FileTopology, foldedTrianglesOpenNothingAndAreLeftOut) {
  EXPECT_EQ(summary(files::obj() + "f 1 1 2\nf 3 3 3\n"), "watertight (2 triangles without an area left out)");
}

/// Placing rounds: what is apart in the file may fall together, and an opening with it.
TEST(FileTopology, isThatOfTheFilesOwnNumbers) {
  std::string text = files::obj() + "v 1e-9 0 0\n";  // beside corner 1
  text.replace(text.find("f 1 4 3"), 7, "f 5 4 3");
  const TemporaryFolder folder;
  const PlacedMesh placed = load_placed_mesh(folder.write("t.obj", text));
  EXPECT_TRUE(topology(placed.mesh).watertight()) << "the slit is narrower than a step of single precision there";
  EXPECT_EQ(placed.topology.summary(), "not watertight: 4 boundary edges");
}

TEST(FileTopology, whatIsLeftOutIsNotInTheMesh) {
  const TemporaryFolder folder;
  const PlacedMesh placed = load_placed_mesh(folder.write("t.obj", with_t_junction() + "f 1 5 2\n"));
  EXPECT_EQ(placed.mesh.triangles.size(), 5u);
  EXPECT_EQ(placed.topology.left_out, 1u);
}

}  // namespace
}  // namespace nextview
