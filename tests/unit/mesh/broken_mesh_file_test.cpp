#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/mesh/mesh_file.hpp"
#include "core/random/counter_random.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"
#include "tests/unit/mesh/tetrahedron_files.hpp"

namespace nextview {
namespace {

namespace files = tetrahedron_files;
using testing::HasSubstr;

/// What load_mesh says of a file, after checking that it is one line that begins with the file's name, and that nothing
/// was printed.
std::string quiet_complaint(const std::filesystem::path& file, const MeshFileOptions& options = {}) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::string message = "nothing";
  try {
    load_mesh(file, options);
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  if (message == "nothing") return "no complaint";
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_EQ(message.rfind(file.string() + ": ", 0), 0u) << message;
  EXPECT_GT(message.size(), file.string().size() + 5) << message;
  return message.substr(std::min(message.size(), file.string().size() + 2));
}

TEST(BrokenMeshFile, whatIsNoFileSaysWhy) {
  const TemporaryFolder folder;
  EXPECT_THAT(quiet_complaint(folder / "nowhere.ply"), HasSubstr("No such file"));
  std::filesystem::create_directory(folder / "folder.ply");
  EXPECT_THAT(quiet_complaint(folder / "folder.ply"), HasSubstr("directory"));
  ASSERT_EQ(::mkfifo((folder / "pipe.ply").c_str(), 0600), 0);
  EXPECT_THAT(quiet_complaint(folder / "pipe.ply"), HasSubstr("pipe"));
  EXPECT_THAT(quiet_complaint("/dev/zero"), HasSubstr("device"));
  std::filesystem::create_symlink(folder / "loop.ply", folder / "loop.ply");
  EXPECT_NE(quiet_complaint(folder / "loop.ply"), "no complaint");
}

TEST(BrokenMeshFile, withoutPermissionItSaysSo) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.ply", files::ply_text());
  ::chmod(file.c_str(), 0);
  // The superuser may read everything, so it becomes somebody else for a moment.
  const bool superuser = ::geteuid() == 0;
  ASSERT_TRUE(!superuser || ::seteuid(65534) == 0);
  const std::string said = quiet_complaint(file);
  ASSERT_TRUE(!superuser || ::seteuid(0) == 0);
  EXPECT_THAT(said, HasSubstr("ermission"));
}

TEST(BrokenMeshFile, emptyUnknownOrTooLarge) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : files::all()) {
    EXPECT_THAT(quiet_complaint(folder.write(name, "")), HasSubstr("empty")) << name;
    const auto file = folder.write(name, bytes);
    EXPECT_THAT(quiet_complaint(file, {.largest_file = bytes.size() - 1}), HasSubstr("bytes")) << name;
    EXPECT_EQ(quiet_complaint(file, {.largest_file = bytes.size()}), "no complaint") << name;
  }
  for (const char* name : {"mesh.txt", "mesh.ply.bak", "mesh."})
    EXPECT_THAT(quiet_complaint(folder.write(name, files::ply_text())), HasSubstr("no known mesh file type")) << name;
  EXPECT_THAT(quiet_complaint(folder.write("mesh", files::ply_text())), HasSubstr("has no ending that says its type"));
}

TEST(BrokenMeshFile, garbageOfAnyType) {
  const TemporaryFolder folder;
  const CounterRandom random(1, 0);
  for (const std::size_t size : {1, 10, 100, 5000})
    for (const auto& [name, bytes] : files::all()) {
      std::string garbage;
      for (std::size_t i = 0; i < size; ++i) garbage.push_back(char(int(256 * random.uniform(i)[0])));
      EXPECT_NE(quiet_complaint(folder.write(name, garbage)), "no complaint") << name << " of " << size << " bytes";
    }
}

TEST(BrokenMeshFile, truncatedAnywhere) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : files::all())
    for (int tenth = 1; tenth < 10; ++tenth) {
      const std::string part = bytes.substr(0, bytes.size() * tenth / 10);
      const std::string said = quiet_complaint(folder.write(name, part));
      // An OBJ announces nothing: what is cut between two lines is a mesh of its own.
      EXPECT_TRUE(name.ends_with(".obj") || said != "no complaint") << name << " after " << part.size() << " bytes";
    }
}

TEST(BrokenMeshFile, coordinatesThatAreNoNumbers) {
  const TemporaryFolder folder;
  for (const char* wrong : {"nan", "inf", "-inf", "1e39"}) {
    const std::string corner = std::string("v 0 ") + wrong + " 0\n";
    EXPECT_THAT(quiet_complaint(folder.write("t.obj", corner + files::obj())), HasSubstr("not finite")) << wrong;
  }
  std::string stl = files::stl_binary();
  stl.replace(84 + 12, 4, files::raw(std::nanf("")));
  EXPECT_EQ(
      quiet_complaint(folder.write("t.stl", stl)),
      "has coordinates that are not finite numbers, in 1 of 12 vertices: delete these in a mesh editor, close the "
      "holes that they leave, and save it again");
}

TEST(BrokenMeshFile, withoutFaces) {
  const TemporaryFolder folder;
  const std::string points = "1 2 3\n4 5 6\n7 8 8\n";
  for (const auto& [name, bytes] :
       std::map<std::string, std::string>{{"points.ply", files::ply_header("ascii", 3, 0) + points},
                                          {"points.off", "OFF\n3 0 0\n" + points},
                                          {"points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
                                          {"lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n"},
                                          {"none.stl", "solid none\nendsolid none\n"},
                                          {"none_binary.stl", files::stl_binary(0).substr(0, 84)}})
    EXPECT_NE(quiet_complaint(folder.write(name, bytes)), "no complaint") << name;
  EXPECT_THAT(quiet_complaint(folder.write("lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n")),
              HasSubstr("no faces"));
  EXPECT_THAT(quiet_complaint(folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n")),
              HasSubstr("degenerate"));
}

TEST(BrokenMeshFile, sizesThatCannotBeMeant) {
  const TemporaryFolder folder;
  const auto huge = folder.write("huge.obj", "v 0 0 0\nv 1e9 0 0\nv 0 1e9 0\nf 1 2 3\n");
  EXPECT_THAT(quiet_complaint(huge, {.longest_side = 0.0}), HasSubstr("longest side"));
  EXPECT_EQ(quiet_complaint(huge, {.longest_side = 0.5}), "no complaint");
  const auto far = folder.write("far.obj", "v 1e9 0 0\nv 1000000500 0 0\nv 1e9 500 0\nf 1 2 3\n");
  EXPECT_THAT(quiet_complaint(far), HasSubstr("precision"));
  const auto near = folder.write("near.obj", "v 1000 0 0\nv 1500 0 0\nv 1000 500 0\nf 1 2 3\n");
  EXPECT_EQ(quiet_complaint(near), "no complaint");
}

TEST(BrokenMeshFile, wrongIndices) {
  const TemporaryFolder folder;
  for (const char* index : {"4", "-7", "4000000000"}) {
    const std::string face = std::string("3 0 1 ") + index + "\n";
    const std::string corners = "0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_NE(quiet_complaint(folder.write("t.ply", files::ply_header("ascii", 3, 1) + corners + face)), "no complaint")
        << index;
    EXPECT_NE(quiet_complaint(folder.write("t.off", "OFF\n3 1 0\n" + corners + face)), "no complaint") << index;
  }
}

/// Headers that announce gigabytes in files of a few hundred bytes.
TEST(BrokenMeshFile, falseClaimsFailWithoutTakingMemory) {
  const TemporaryFolder folder;
  const std::string body = files::ply_binary(false).substr(files::ply_header("binary_little_endian", 4, 4).size());
  std::string glb = files::glb();
  glb.replace(8, 4, files::raw(std::uint32_t{2'000'000'000}));
  std::map<std::string, std::string> claims = {{"binary.stl", files::stl_binary(2'000'000'000)},
                                               {"most.stl", files::stl_binary(~0u)},
                                               {"vertices.off", "OFF\n2000000000 4 0\n0 0 0\n"},
                                               {"faces.off", "OFF\n1 2000000000 0\n0 0 0\n"},
                                               {"length.glb", glb}};
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
    for (const std::uint64_t many : {std::uint64_t{2'000'000'000}, ~std::uint64_t{0}}) {
      const std::string name = format + std::to_string(many);
      claims["vertices_" + name + ".ply"] = files::ply_header(format, many, 4) + body;
      claims["faces_" + name + ".ply"] = files::ply_header(format, 4, many) + body;
    }
  const auto memory = [](int whose) {  // largest resident size so far [KiB]
    rusage usage;
    ::getrusage(whose, &usage);
    return usage.ru_maxrss;
  };
  const long before = std::max(memory(RUSAGE_SELF), memory(RUSAGE_CHILDREN));
  for (const auto& [name, bytes] : claims)
    EXPECT_THAT(quiet_complaint(folder.write(name, bytes)), HasSubstr("claims")) << name;
  EXPECT_LT(std::max(memory(RUSAGE_SELF), memory(RUSAGE_CHILDREN)) - before, 100 * 1024);
}

TEST(BrokenMeshFile, whatCrashesTheReaderIsALineToo) {
  const TemporaryFolder folder;
  // A part of the archive that the checksum does not fit, and one that names a model that is not there: both abort in
  // Assimp.
  std::string archive = files::three_mf();
  archive.replace(archive.find("triangle v1"), 8, "trIangle");
  EXPECT_NE(quiet_complaint(folder.write("checksum.3mf", archive)), "no complaint");
  EXPECT_NE(quiet_complaint(folder.write("nothing.3mf", files::zip({{"a.txt", "hello"}}))), "no complaint");
}

/// Bytes changed, put in and cut off at random. Whatever comes of it, it is a whole mesh or one line.
TEST(BrokenMeshFile, randomDamage) {
  const TemporaryFolder folder;
  int refused = 0, taken = 0;
  for (const auto& [name, bytes] : files::all())
    for (std::uint32_t round = 0; round < 40; ++round) {
      const CounterRandom random(round, 0, static_cast<std::uint32_t>(bytes.size()));
      std::string damaged = bytes;
      for (int change = 0; change < 4; ++change) {
        const auto u = random.uniform(change);
        const auto at = static_cast<std::size_t>(u[0] * damaged.size());
        if (u[1] < 0.5) damaged[at] = static_cast<char>(256 * u[2]);
        if (u[1] >= 0.5 && u[1] < 0.9) damaged.insert(at, 1, "0123456789.e- \n"[static_cast<int>(15 * u[2])]);
        if (u[1] >= 0.97) damaged.resize(at + 1);
      }
      const auto file = folder.write(name, damaged);
      if (quiet_complaint(file) != "no complaint") {
        ++refused;
        continue;
      }
      ++taken;
      const TriangleMesh mesh = load_mesh(file);
      EXPECT_FALSE(mesh.triangles.empty());
      for (const Eigen::Vector3f& vertex : mesh.vertices) ASSERT_TRUE(vertex.allFinite());
      for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle) ASSERT_LT(vertex, mesh.vertices.size());
    }
  EXPECT_GT(refused, 50);
  EXPECT_GT(taken, 20);
}

}  // namespace
}  // namespace nextview
