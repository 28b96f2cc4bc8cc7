// What the numbers of a file that keeps its own size are taken for.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/mesh/mesh_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/mesh/tetrahedron_files.hpp"

namespace nextview {
namespace {

namespace files = tetrahedron_files;

PlacedMesh at_own_size(const std::filesystem::path& file, LengthUnit unit = LengthUnit::automatic) {
  return load_placed_mesh(file, {.longest_side = 0.0, .unit = unit, .up = UpAxis::z});
}
double longest(const PlacedMesh& placed) { return placed.mesh.bounding_box().sizes().maxCoeff(); }

/// One triangle, so many units long.
std::string obj_of(double units) { return fmt::format("v 0 0 0\nv {} 0 0\nv 0 1 0\nf 1 2 3\n", units); }

// By their specifications: glTF is in metres, 3MF in millimetres. The others have no unit, and 4 of them are metres.
TEST(OwnSize, IsThatOfTheTypesUnit) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : files::all()) {
    const PlacedMesh placed = at_own_size(folder.write(name, bytes));
    const bool is_3mf = name.ends_with(".3mf");
    EXPECT_NEAR(longest(placed), is_3mf ? 0.004 : 4.0, 1e-6) << name;
    EXPECT_EQ(placed.unit, is_3mf ? LengthUnit::millimetres : LengthUnit::metres) << name;
    EXPECT_EQ(placed.is_unit_guessed, !is_3mf && !name.ends_with(".gltf") && !name.ends_with(".glb")) << name;
    EXPECT_FALSE(at_own_size(folder.path() / name, LengthUnit::metres).is_unit_guessed) << "it was said";
  }
}

// 3MF and AMF name theirs, FBX has it in centimetres; where they do not, it is that of the type.
TEST(OwnSize, IsInTheUnitThatTheFileDeclares) {
  const TemporaryFolder folder;
  const auto amf = [](const std::string& unit) {
    std::string text = "<?xml version=\"1.0\"?>\n<amf " + unit + "><object id=\"0\"><mesh><vertices>";
    for (const auto& c : files::corners)
      text += fmt::format("<vertex><coordinates><x>{}</x><y>{}</y><z>{}</z></coordinates></vertex>", c[0], c[1], c[2]);
    text += "</vertices><volume>";
    for (const auto& f : files::faces)
      text += fmt::format("<triangle><v1>{}</v1><v2>{}</v2><v3>{}</v3></triangle>", f[0], f[1], f[2]);
    return text + "</volume></mesh></object></amf>";
  };
  for (const auto& [unit, taken] : {std::pair{"unit=\"inch\"", LengthUnit::inches},
                                    {"unit='meter'", LengthUnit::metres},
                                    {"unit = \"micron\"", LengthUnit::micrometres},
                                    {"", LengthUnit::millimetres}})
    for (const auto& file : {folder.write("t.3mf", files::three_mf(unit)), folder.write("t.amf", amf(unit))}) {
      EXPECT_EQ(at_own_size(file).unit, taken) << file << unit;
      EXPECT_NEAR(longest(at_own_size(file)) / metres_per(taken), 4.0, 1e-5) << file << unit;
      EXPECT_NEAR(longest(at_own_size(file, LengthUnit::centimetres)), 0.04, 1e-6) << "asked for";
    }
}

TEST(OwnSize, OfAnStlOrPlyIsInTheUnitThatItsHeadNames) {
  const TemporaryFolder folder;
  const auto stl = [&](std::string head) {
    head.resize(80, '\0');
    std::string bytes = files::stl_binary();
    return folder.write("t.stl", bytes.replace(0, 80, head));
  };
  EXPECT_NEAR(longest(at_own_size(stl("nextview, unit mm; what was seen"))), 0.004, 1e-9);
  EXPECT_NEAR(longest(at_own_size(stl("by another, UNITS=inch"))), 4 * 0.0254, 1e-6);
  EXPECT_NEAR(longest(at_own_size(stl("a unit of mine"))), 4.0, 1e-6);
  const auto ply = [&](const std::string& remark) {
    return folder.write("t.ply",
                        "ply\nformat ascii 1.0\ncomment " + remark +
                            "\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
                            "1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n30 0 0\n0 1 0\n3 0 1 2\n");
  };
  EXPECT_NEAR(longest(at_own_size(ply("reconstructed surface, nextview; unit m"))), 30.0, 1e-6);
  EXPECT_NEAR(longest(at_own_size(ply("made by hand"))), 0.03, 1e-6);
}

TEST(OwnSize, InGltfIsInMetresHoweverLong) {
  const TemporaryFolder folder;
  folder.write("buffer.bin", files::gltf_buffer());
  const auto file =
      folder.write("large.gltf", files::gltf(R"("uri": "buffer.bin", )", R"([{"mesh": 0, "scale": [20, 20, 20]}])"));
  EXPECT_NEAR(longest(at_own_size(file)), 80.0, 1e-4);
  EXPECT_EQ(at_own_size(file).unit, LengthUnit::metres);
}

TEST(OwnSize, WithoutAUnitOverTenAreMillimetres) {
  const TemporaryFolder folder;
  for (const auto& [units, metres] : {std::pair(9.75, 9.75), {10.0, 10.0}, {10.25, 0.01025}, {80.0, 0.08}}) {
    const PlacedMesh placed = at_own_size(folder.write("t.obj", obj_of(units)));
    EXPECT_NEAR(longest(placed), metres, 1e-6 * metres) << units;
    EXPECT_EQ(placed.unit, units > 10.0 ? LengthUnit::millimetres : LengthUnit::metres);
  }
}

TEST(OwnSize, IsInTheUnitThatIsAskedForWhateverTheTypeSays) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : {std::pair{"t.glb", files::glb()}, {"t.3mf", files::three_mf()}})
    for (const auto& [unit, metres] : {std::pair{LengthUnit::metres, 4.0},
                                       {LengthUnit::millimetres, 0.004},
                                       {LengthUnit::centimetres, 0.04},
                                       {LengthUnit::inches, 0.1016}})
      EXPECT_NEAR(longest(at_own_size(folder.write(name, bytes), unit)), metres, 1e-6) << name;
  const PlacedMesh scaled = load_placed_mesh(folder.write("t.glb", files::glb()), {.unit = LengthUnit::inches});
  EXPECT_NEAR(longest(scaled), 0.5, 1e-6) << "a longest side says all";
  EXPECT_EQ(scaled.unit, LengthUnit::automatic);
}

TEST(OwnSize, IsAtMostAKilometre) {
  const TemporaryFolder folder;
  EXPECT_NEAR(longest(at_own_size(folder.write("t.obj", obj_of(1000.0)), LengthUnit::metres)), 1000.0, 1e-3);
  EXPECT_THROW(at_own_size(folder.write("t.obj", obj_of(1001.0)), LengthUnit::metres), std::runtime_error);
  EXPECT_NEAR(longest(at_own_size(folder.write("t.obj", obj_of(1001.0)))), 1.001, 1e-6) << "of millimetres it is";
}

}  // namespace
}  // namespace nextview
