#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/parts.hpp"
#include "tests/unit/mesh/own_objects.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;

void expect_same(const std::vector<Opening>& read, const std::vector<Opening>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].kind, written[i].kind);
    EXPECT_EQ(read[i].width, written[i].width);
    EXPECT_EQ(read[i].length, written[i].length);
    EXPECT_EQ(read[i].depth, written[i].depth);
    EXPECT_EQ(read[i].centre, written[i].centre);
    EXPECT_EQ(read[i].axis, written[i].axis);
    EXPECT_EQ(read[i].along, written[i].along);
  }
}

/// What read_openings says of a file, after checking that it is one line that begins with the file's name.
std::string openings_complaint(const std::filesystem::path& file) {
  try {
    read_openings(file);
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(message.rfind(file.string() + ": ", 0), 0u) << message;
    return message.substr(std::min(message.size(), file.string().size() + 2));
  }
  return "no complaint";
}

TEST(OpeningsFile, theFilesBesideOurPartsAreReadBack) {
  for (const Part& part : {slotted_plate(), slotted_housing()})
    expect_same(read_openings(own_objects / (part.name + ".json")), part.openings);
}

TEST(OpeningsFile, whatIsWrittenIsReadToTheLastBit) {
  const Eigen::AngleAxisd turn(0.9, Eigen::Vector3d(0.3, 1.0, 0.2).normalized());
  Part part = slotted_plate();
  for (Opening& opening : part.openings) {
    opening.width /= 3.0;
    opening.length *= 1.0 / 7.0;
    opening.centre = turn * opening.centre * 1e-5;
    opening.axis = turn * opening.axis;
    opening.along = turn * opening.along;
  }
  const TemporaryFolder folder;
  expect_same(read_openings(folder.write("turned.json", openings_json(part))), part.openings);
  part.openings.clear();
  EXPECT_TRUE(read_openings(folder.write("none.json", openings_json(part))).empty());
}

TEST(OpeningsFile, whatIsNoFileSaysWhy) {
  const TemporaryFolder folder;
  EXPECT_THAT(openings_complaint(folder / "nowhere.json"), HasSubstr("No such file"));
  std::filesystem::create_directory(folder / "folder.json");
  EXPECT_THAT(openings_complaint(folder / "folder.json"), HasSubstr("directory"));
  EXPECT_THAT(openings_complaint(folder.write("large.json", std::string(2 << 20, ' '))), HasSubstr("bytes"));
}

TEST(OpeningsFile, truncatedAnywhereItIsRefused) {
  const TemporaryFolder folder;
  std::string text = openings_json(slotted_housing());
  text.erase(text.find_last_of('}') + 1);
  for (std::size_t size = 0; size < text.size(); ++size)
    ASSERT_THAT(openings_complaint(folder.write("cut.json", text.substr(0, size))), HasSubstr("truncated")) << size;
  EXPECT_EQ(openings_complaint(folder.write("whole.json", text)), "no complaint");
}

TEST(OpeningsFile, whatIsNoJsonSaysWhere) {
  const TemporaryFolder folder;
  EXPECT_EQ(openings_complaint(folder.write("a.json", "{\"unit\": m}")), "is no JSON from byte 10 on");
  EXPECT_THAT(openings_complaint(folder.write("b.json", "ply\nformat ascii 1.0\n")),
              HasSubstr("no JSON from byte 1 on"));
  EXPECT_THAT(openings_complaint(folder.write("c.json", "{\"\xff\n\x01\": 1}")), HasSubstr("no JSON"));
  EXPECT_THAT(openings_complaint(folder.write("d.json", std::string(1 << 20, '['))), HasSubstr("truncated"));
}

/// The plate's file with one piece of its text replaced, the first time that it appears.
std::string with(const std::string& piece, const std::string& replacement) {
  std::string text = openings_json(slotted_plate());
  const std::size_t at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  return text.replace(at, piece.size(), replacement);
}

TEST(OpeningsFile, wrongTypesAndValuesAreNamed) {
  const TemporaryFolder folder;
  struct Case {
    std::string text;
    std::vector<std::string> says;
  };
  const std::vector<Case> cases = {
      {"[]", {"object", "array"}},
      {"{}", {"'unit'"}},
      {R"({"unit": "m"})", {"'openings'"}},
      {R"({"unit": "m", "openings": 3})", {"'openings'", "number"}},
      {R"({"unit": "m", "openings": ["slot"]})", {"opening 0", "object", "string"}},
      {with("\"unit\": \"m\"", "\"unit\": \"mm\""), {"'unit'"}},
      {with("\"unit\": \"m\"", "\"unit\": 1"), {"'unit'"}},
      {with("\"slot\"", "\"gap\""), {"opening 0", "'kind'"}},
      {with("\"kind\": \"bore\", ", ""), {"opening 4", "'kind'"}},
      {with("\"bore\"", "2"), {"opening 4", "'kind'"}},
      {with("\"width\": 0.02", "\"width\": \"0.02\""), {"opening 1", "'width'", "string"}},
      {with("\"width\": 0.02", "\"width\": 0"), {"opening 1", "'width'", "over 0"}},
      {with("\"width\": 0.02", "\"width\": -1"), {"opening 1", "'width'", "over 0"}},
      {with("\"width\": 0.02", "\"width\": 1e5"), {"opening 1", "'width'", "beyond"}},
      {with("\"width\": 0.02", "\"width\": 1e999"), {"too large"}},
      {with("\"length\": 0.12", "\"length\": null"), {"opening 0", "'length'", "null"}},
      {with("\"depth\": 0.03, ", ""), {"opening 0", "'depth'"}},
      {with("0.0716, 0]", "0.0716]"), {"opening 0", "'centre'", "three"}},
      {with("0.0716, 0]", "0.0716, 0, 0]"), {"opening 0", "'centre'", "three"}},
      {with("0.0716, 0]", "true, 0]"), {"opening 0", "'centre'", "boolean"}},
      {with("0.0716, 0]", "-1e4, 0]"), {"opening 0", "'centre'", "beyond"}},
      {with("[0, 0, 1]", "{}"), {"opening 0", "'axis'", "three"}},
      {with("[0, 0, 1]", "[0, 0, 2]"), {"opening 0", "unit"}},
      {with("[0, 1, 0]", "[0, 0, 1]"), {"opening 0", "right angles"}},
  };
  for (const Case& each : cases) {
    const std::string said = openings_complaint(folder.write("wrong.json", each.text));
    for (const std::string& part : each.says) EXPECT_THAT(said, HasSubstr(part)) << each.text;
  }
}

double distance_to_nearest_vertex(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  double nearest = 1e9;
  for (const Eigen::Vector3f& vertex : mesh.vertices)
    nearest = std::min(nearest, (vertex.cast<double>() - point).norm());
  return nearest;
}

/// The rims of the openings have corners in the mesh: they must lie where the openings say.
void expect_rims(const std::vector<Opening>& openings, const TriangleMesh& mesh) {
  for (const Opening& o : openings)
    for (const double through : {-0.5, 0.5}) {
      const Eigen::Vector3d mouth = o.centre + through * o.depth * o.axis;
      const Eigen::Vector3d across = o.axis.cross(o.along);
      if (o.kind == Opening::Kind::bore) {
        for (const double side : {-0.5, 0.5}) {
          EXPECT_LT(distance_to_nearest_vertex(mesh, mouth + side * o.length * o.along), 1e-6);
          EXPECT_LT(distance_to_nearest_vertex(mesh, mouth + side * o.width * across), 1e-6);
        }
      } else {
        for (const double a : {-0.5, 0.5})
          for (const double b : {-0.5, 0.5})
            EXPECT_LT(distance_to_nearest_vertex(mesh, mouth + a * o.length * o.along + b * o.width * across), 1e-6);
      }
    }
}

TEST(PlacedMesh, openingsGoWhereTheirMeshGoes) {
  const Eigen::Vector3d offset(1.25, -0.75, 3.5);
  constexpr double size = 2.5;
  for (const Part& part : {slotted_plate(), slotted_housing()}) {
    // A file that lies elsewhere and is larger, with the openings in its own frame.
    Part moved = part;
    for (Eigen::Vector3f& vertex : moved.mesh.vertices) vertex = (vertex.cast<double>() * size + offset).cast<float>();
    for (Opening& opening : moved.openings) opening = placed(opening, {-offset / size, size});
    expect_rims(moved.openings, moved.mesh);
    const TemporaryFolder folder;
    const auto file = folder.write("moved.ply", ply_bytes(moved.mesh));
    const auto json = folder.write("moved.json", openings_json(moved));

    for (const auto& [longest_side, up] :
         {std::pair{0.5, UpAxis::z}, {0.0, UpAxis::z}, {0.8, UpAxis::z}, {0.5, UpAxis::y}, {0.8, UpAxis::minus_x}}) {
      const MeshFileOptions options{.longest_side = longest_side, .up = up};
      const PlacedMesh loaded = load_placed_mesh(file, options);
      EXPECT_LT((loaded.placement.centre - offset).norm(), 1e-6);
      EXPECT_NEAR(loaded.placement.scale, longest_side > 0.0 ? longest_side / (0.5 * size) : 1.0, 1e-6);
      std::vector<Opening> openings = read_openings(json);
      for (Opening& opening : openings) opening = placed(opening, loaded.placement);
      expect_rims(openings, loaded.mesh);
      EXPECT_EQ(load_mesh(file, options).vertices, loaded.mesh.vertices);
    }
  }
}

TEST(PlacedMesh, ourPartsStayWhereTheyAre) {
  for (const char* name : {"slotted_plate.ply", "slotted_housing.ply"}) {
    const MeshPlacement placement = load_placed_mesh(own_objects / name).placement;
    EXPECT_EQ(placement.centre, Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(placement.scale, 1.0);
  }
}

TEST(PlacedMesh, thePlacementTurnsTheFilesPointsIntoTheMeshs) {
  const TemporaryFolder folder;
  const auto file = folder.write("one.obj", "v 3 1 7\nv 7 1 7\nv 3 3 7\nf 1 2 3\n");
  const PlacedMesh loaded = load_placed_mesh(file);
  EXPECT_EQ(loaded.placement.centre, Eigen::Vector3d(5, 2, 7));
  EXPECT_EQ(loaded.placement.scale, 0.125);
  EXPECT_EQ(loaded.placement(Eigen::Vector3d(7, 1, 7)), Eigen::Vector3d(0.25, -0.125, 0.0));
}

}  // namespace
}  // namespace nextview
