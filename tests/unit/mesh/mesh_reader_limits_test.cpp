#include <dirent.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <future>
#include <thread>

#include "core/mesh/mesh_file.hpp"
#include "core/mesh/scene_import.hpp"
#include "core/progress/stopped.hpp"
#include "tests/unit/mesh/hostile_files.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

namespace files = tetrahedron_files;
namespace fs = std::filesystem;
using testing::HasSubstr;

/// What load_mesh says, without the file's name; "no complaint" if it loads.
std::string complaint(const fs::path& file) {
  try {
    load_mesh(file);
    return "no complaint";
  } catch (const std::runtime_error& error) {
    const std::string said = error.what(), begin = file.string() + ": ";
    EXPECT_EQ(said.substr(0, begin.size()), begin);
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    return said.substr(std::min(said.size(), begin.size()));
  }
}

long peak_memory_of_children() {  // at once, so far [MiB]
  rusage usage;
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return usage.ru_maxrss / 1024;
}

/// A folder "in" with a secret beside it: "out/secret.bin", a buffer that would do.
struct Folders {
  TemporaryFolder folder;
  fs::path in = folder / "in", secret = folder / "out/secret.bin";
  Folders() {
    fs::create_directories(in / "below");
    fs::create_directories(folder / "out");
    folder.write("out/secret.bin", files::gltf_buffer());
    folder.write("in/buffer.bin", files::gltf_buffer());
    folder.write("in/below/buffer.bin", files::gltf_buffer());
  }
  std::string of_gltf(const std::string& uri) const {
    return complaint(folder.write("in/scene.gltf", hostile_files::gltf_with_buffer(uri)));
  }
};

TEST(MeshReaderFiles, aBufferBesideInAFolderBelowOrInTheFileIsRead) {
  const Folders f;
  for (const char* uri : {"buffer.bin", "./buffer.bin", "below/buffer.bin", "below/./buffer.bin"})
    EXPECT_EQ(f.of_gltf(uri), "no complaint") << uri;
  // Base64 of the same bytes.
  const std::string bytes = files::gltf_buffer();
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string data = "data:application/octet-stream;base64,";
  for (std::size_t i = 0; i < bytes.size(); i += 3) {  // 96 bytes: no rest
    const auto byte = [&](std::size_t k) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])); };
    const unsigned word = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (const int shift : {18, 12, 6, 0}) data += digits[word >> shift & 63];
  }
  EXPECT_EQ(f.of_gltf(data), "no complaint");
}

TEST(MeshReaderFiles, noFileElsewhereIsRead) {
  const Folders f;
  fs::create_symlink(f.secret, f.in / "link.bin");
  fs::create_symlink(f.secret.parent_path(), f.in / "linked");
  fs::create_symlink("loop.bin", f.in / "loop.bin");
  for (const std::string& uri : {std::string("../out/secret.bin"), f.secret.string(), std::string("link.bin"),
                                 std::string("linked/secret.bin"), std::string("below/../../out/secret.bin"),
                                 std::string("loop.bin"), std::string("below"), std::string("nowhere.bin")})
    EXPECT_THAT(f.of_gltf(uri), HasSubstr("needs '" + uri + "', which is no file beside it")) << uri;
}

TEST(MeshReaderFiles, pipesAndDevicesAreNotWaitedFor) {
  const Folders f;
  ASSERT_EQ(::mkfifo((f.in / "pipe.bin").c_str(), 0600), 0);
  EXPECT_THAT(f.of_gltf("pipe.bin"), HasSubstr("needs 'pipe.bin'"));
  EXPECT_THAT(f.of_gltf("/dev/zero"), HasSubstr("needs '/dev/zero'"));
}

TEST(MeshReaderFiles, materialsAreNoGeometryAndNotOpened) {
  const Folders f;
  // Opening any of these would wait for ever; the last is what a reader falls back to.
  for (const char* name : {"in/m.mtl", "out/m.mtl", "in/t.mtl"})
    ASSERT_EQ(::mkfifo((f.folder / name).c_str(), 0600), 0);
  for (const std::string& library :
       {std::string("m.mtl"), std::string("../out/m.mtl"), (f.folder / "out/m.mtl").string()})
    EXPECT_EQ(complaint(f.folder.write("in/t.obj", "mtllib " + library + "\nusemtl m\n" + files::obj())),
              "no complaint")
        << library;
}

TEST(MeshReaderFiles, theOtherFilesCountAsWell) {
  const Folders f;
  const auto file = f.folder.write("in/scene.gltf", hostile_files::gltf_with_buffer("buffer.bin"));
  const auto size = fs::file_size(file);
  EXPECT_NO_THROW(load_mesh(file, {.largest_file = size + 96}));
  EXPECT_THROW(load_mesh(file, {.largest_file = size + 95}), std::runtime_error);
}

TEST(MeshReaderMemory, followsFromTheSizeOfTheFile) {
  if (!can_confine) GTEST_SKIP() << "built with sanitizers";
  const TemporaryFolder folder;
  folder.write("buffer.bin", files::gltf_buffer());
  std::string archive = files::three_mf();
  for (const std::size_t size_of_a_part : {std::size_t{22}, archive.find("PK\1\2") + 24})
    archive.replace(size_of_a_part, 4, files::raw(std::uint32_t{0xf0000000}));
  EXPECT_EQ(complaint(folder.write("good.dae", hostile_files::dae())), "no complaint");
  EXPECT_EQ(complaint(folder.write("good.gltf", hostile_files::gltf_doubling(4))), "no complaint");
  for (const auto& [name, bytes] :
       std::map<std::string, std::string>{{"numbers.dae", hostile_files::dae("1000000000")},
                                          {"triangles.dae", hostile_files::dae("9", "400000000")},
                                          {"nodes.gltf", hostile_files::gltf_doubling(24)},
                                          {"size.3mf", archive}}) {
    const std::string said = complaint(folder.write(name, bytes));
    EXPECT_NE(said, "no complaint") << name;
    EXPECT_THAT(said, HasSubstr("reading it takes more memory")) << name;
  }
  EXPECT_LT(peak_memory_of_children(), 1024);
}

TEST(MeshReaderTime, isBounded) {
  const MeshBytes slow{".obj", hostile_files::obj_with_huge_face(60'000), {}};
  ReadingLimits limits = reading_limits(".obj", slow.bytes.size(), 1u << 30);
  limits.time = std::chrono::milliseconds(300);
  try {
    import_scene(slow, limits);
    FAIL() << "it was read";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("takes longer than"));
  }
}

/// The folder in /proc of the process that reads for this one; empty while there is none.
std::string reader() {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream status(entry.path() / "status");
    const std::string text{std::istreambuf_iterator<char>(status), {}};
    if (text.find("\nPPid:\t" + std::to_string(::getpid()) + "\n") != std::string::npos) return entry.path();
  }
  return "";
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(MeshReader, isConfinedWhileItReadsAndAStopEndsIt) {
  if (!can_confine) GTEST_SKIP() << "built with sanitizers";
  const TemporaryFolder folder;
  const auto file = folder.write("slow.obj", hostile_files::obj_with_huge_face(60'000));
  std::stop_source stop;
  auto loading = std::async(std::launch::async, [&] { load_mesh(file, {}, stop.get_token()); });
  std::string process, status;
  for (int tries = 0; tries < 2000 && status.find("\nSeccomp:\t2\n") == std::string::npos; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    process = reader();
    status = process.empty() ? "" : text_of(fs::path(process) / "status");
  }
  EXPECT_THAT(status, HasSubstr("\nSeccomp:\t2\n"));
  EXPECT_THAT(status, HasSubstr("\nNoNewPrivs:\t1\n"));
  // Its standard streams, which are nothing, and the pipe.
  std::map<std::string, std::string> open;
  for (const auto& entry : fs::directory_iterator(fs::path(process) / "fd"))
    open[entry.path().filename()] = fs::read_symlink(entry.path());
  EXPECT_EQ(open.size(), 4u);
  for (const char* standard : {"0", "1", "2"}) EXPECT_EQ(open[standard], "/dev/null");
  EXPECT_THAT(open["3"], HasSubstr("pipe:"));
  EXPECT_THAT(text_of(fs::path(process) / "limits"), testing::Not(testing::ContainsRegex("Max data size +unlimited")));

  stop.request_stop();
  EXPECT_THROW(loading.get(), Stopped);
  EXPECT_EQ(reader(), "") << "nobody goes on reading";
}

TEST(MeshReader, aStopThatCameBeforeStopsAtOnce) {
  const TemporaryFolder folder;
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(load_mesh(folder.write("t.obj", files::obj()), {}, stop.get_token()), Stopped);
}

TEST(MeshReader, whatIsNoMeshSaysWhatToDo) {
  const TemporaryFolder folder;
  const std::string step = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n";
  for (const char* name : {"part.step", "part.stp", "PART.STEP"})
    EXPECT_THAT(complaint(folder.write(name, step)),
                testing::AllOf(HasSubstr("STEP is not a mesh"), HasSubstr("export it as STL, OBJ or 3MF")))
        << name;
  EXPECT_THAT(complaint(folder.write("part.igs", "S 1\n")), HasSubstr("IGES is not a mesh"));
  for (const char* name : {"scene.blend", "level.bsp", "house.ifc", "scene.xml"})
    EXPECT_THAT(complaint(folder.write(name, step)), HasSubstr("no known mesh file type")) << name;
}

TEST(MeshReader, theEndingDecidesWhatReadsAFile) {
  const TemporaryFolder folder;
  // A COLLADA scene that calls itself glTF: its own readers refuse it, and no other is asked.
  EXPECT_NE(complaint(folder.write("scene.gltf", hostile_files::dae())), "no complaint");
  EXPECT_EQ(complaint(folder.write("scene.dae", hostile_files::dae())), "no complaint");
}

TEST(MeshReader, aLinkToItselfSaysSo) {
  const TemporaryFolder folder;
  fs::create_symlink("loop.ply", folder / "loop.ply");
  EXPECT_THAT(complaint(folder / "loop.ply"), HasSubstr("symbolic links"));
}

TEST(MeshReader, namesOfAnyScriptPrintAndControlsDoNot) {
  const TemporaryFolder folder;
  EXPECT_EQ(complaint(folder.write("größe 零.ply", "")), "is empty");
  try {
    load_mesh(folder.write("a\x1b[31m\nb.ply", "no mesh"));
    FAIL() << "it was read";
  } catch (const std::runtime_error& error) {
    const std::string said = error.what();
    EXPECT_THAT(said, HasSubstr("a\\x1b[31m\\nb.ply: "));
    EXPECT_TRUE(std::none_of(said.begin(), said.end(), [](unsigned char c) { return c < ' '; })) << said;
  }
  const std::string header = "ply\nformat ascii 1.0\nelement \x1b]0;owned\a\nend_header\n";
  EXPECT_THAT(complaint(folder.write("escape.ply", header)), HasSubstr("\\x1b]0;owned\\x07"));
}

TEST(MeshReader, oneIsNotMany) {
  const TemporaryFolder folder;
  EXPECT_THAT(complaint(folder.write("one.stl", files::stl_binary(1))), HasSubstr("claims 1 triangle, which takes"));
  EXPECT_THAT(complaint(folder.write("one.off", "OFF\n1 1 0\n")), HasSubstr("claims 1 vertex,"));
  EXPECT_THAT(complaint(folder.write("two.off", "OFF\n2 1 0\n0 0 0\n")),
              HasSubstr("claims 2 vertices, but only 1 line follows"));
}

}  // namespace
}  // namespace nextview
