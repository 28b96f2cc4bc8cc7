// What a file's header says against what follows it.
#include "core/mesh/file_claims.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/mesh/tetrahedron_files.hpp"

namespace nextview {
namespace {

namespace files = tetrahedron_files;
using testing::HasSubstr;

TEST(FalseClaim, IsNoneOfWholeFiles) {
  for (const auto& [name, bytes] : files::all()) EXPECT_EQ(false_claim(name.substr(name.find('.')), bytes), "") << name;
}

TEST(FalseClaim, OfOffMayHaveCommentsAndEmptyLinesAnywhere) {
  std::string text = "OFF\n# made by hand\n\n4 4 6\n  # corners\n";
  const std::string plain = files::off(), lines = plain.substr(plain.find('\n', 4) + 1);
  for (std::size_t at = 0; at < lines.size(); at = lines.find('\n', at) + 1)
    text += lines.substr(at, lines.find('\n', at) + 1 - at) + "\n \t\r\n# 3 0 1 2\n";
  EXPECT_EQ(false_claim(".off", text), "");
}

TEST(FalseClaim, CommentsAndEmptyLinesAreNoVerticesAndNoFaces) {
  EXPECT_EQ(false_claim(".off", "OFF\n2 0 0\n0 0 0\n# 1 1 1\n\n"),
            "its OFF header claims 2 vertices, but only 1 line follows; it may be truncated");
  EXPECT_EQ(false_claim(".off", "OFF\n1 1 0\n0 0 0\n  # 1 0\n \n"),
            "its OFF header claims 1 face of 1 vertex, but face 0 is missing; it may be truncated");
}

TEST(FalseClaim, OfOffFacesAreListsOfItsVertices) {
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  for (const char* good : {"3 0 1 2", "1 0", " 3\t2 1 0\r", "3 0 1 2 255 0 0"})
    EXPECT_EQ(false_claim(".off", vertices + good), "") << good;
  for (const char* bad : {"3 0 1 3", "3 0 1 -1", "3 0 1", "0", "-3 0 1 2", "x"})
    EXPECT_THAT(false_claim(".off", vertices + bad), HasSubstr("face 0 is not a list of such vertices")) << bad;
  EXPECT_EQ(false_claim(".off", "FOO\n3 1 0\n"), "does not begin with OFF");
  for (const char* counts : {"3 1", "3 -1 0", "x", ""})
    EXPECT_THAT(false_claim(".off", std::string("OFF\n") + counts + "\n"), HasSubstr("must hold the numbers"))
        << counts;
}

TEST(FalseClaim, OfABinaryStlIsToTheByte) {
  const std::string whole = files::stl_binary();
  for (const std::string& bytes : {whole + "x", whole.substr(0, whole.size() - 1), files::stl_binary(5)})
    EXPECT_THAT(false_claim(".stl", bytes), HasSubstr("it may be truncated"));
  EXPECT_EQ(false_claim(".stl", whole.substr(0, 84).replace(80, 4, 4, '\0')), "") << "none, and none is claimed";
  EXPECT_THAT(false_claim(".stl", whole.substr(0, 83)), HasSubstr("nor long enough for a binary STL's header"));
}

TEST(FalseClaim, OfABinaryStlThatCallsItselfSolidToo) {
  std::string whole = files::stl_binary();
  whole.replace(0, 6, "solid ");
  EXPECT_EQ(false_claim(".stl", whole), "");
  EXPECT_THAT(false_claim(".stl", whole.substr(0, whole.size() - 50)), HasSubstr("claims 4 triangles"));
}

TEST(FalseClaim, OfAnStlTextIsThatItEnds) {
  const std::string whole = files::stl_text();
  EXPECT_THAT(false_claim(".stl", whole.substr(0, whole.rfind("endsolid"))), HasSubstr("must end with 'endsolid'"));
}

TEST(FalseClaim, OfAnStlIsThatItIsNoOtherText) {
  const std::string other(200, 'a');
  for (const std::string& text : {other, other.substr(0, 20)})
    EXPECT_EQ(false_claim(".stl", text), "is a text, but no STL text, which begins with 'solid'");
}

TEST(FalseClaim, OfNoMeshIsThatItIsAWebPage) {
  for (const char* page : {"<!DOCTYPE html>\n<html>Not found</html>", "\n <HTML lang=\"de\">", "\xEF\xBB\xBF<html>"})
    for (const char* extension : {".stl", ".obj", ".3mf"})
      EXPECT_THAT(false_claim(extension, page), HasSubstr("is a web page, not a mesh")) << extension;
}

TEST(FalseClaim, OfAnArchiveIsThatItIsAMesh) {
  for (const char* extension : {".stl", ".ply", ".obj", ".amf"})
    EXPECT_THAT(false_claim(extension, files::three_mf()), HasSubstr("is a ZIP archive, not a mesh")) << extension;
  EXPECT_THAT(false_claim(".stl", std::string("\x1f\x8b\x08\0 and more", 14)), HasSubstr("end it in .gz"));
}

TEST(FalseClaim, OfA3mfIsThatItIsAWholeArchive) {
  const std::string whole = files::three_mf();
  EXPECT_EQ(false_claim(".3mf", whole), "");
  EXPECT_THAT(false_claim(".3mf", whole.substr(0, 400)), HasSubstr("may be truncated"));
  EXPECT_EQ(false_claim(".3mf", files::stl_text()), "is no 3MF, which is a ZIP archive");
}

TEST(FalseClaim, OfGlbIsThatAllOfItIsThere) {
  const std::string whole = files::glb();
  EXPECT_EQ(false_claim(".glb", whole + "more"), "");
  EXPECT_THAT(false_claim(".glb", whole.substr(0, whole.size() - 1)),
              HasSubstr("claims " + std::to_string(whole.size()) + " bytes, but the file has"));
  std::string long_chunk = whole;
  long_chunk.replace(12, 4, files::raw(static_cast<std::uint32_t>(whole.size())));
  EXPECT_THAT(false_claim(".glb", long_chunk), HasSubstr("longer than the file"));
  EXPECT_EQ(false_claim(".glb", whole.substr(0, 19)), "is not a binary glTF");
  EXPECT_EQ(false_claim(".glb", "GLTF" + whole.substr(4)), "is not a binary glTF");
}

}  // namespace
}  // namespace nextview
