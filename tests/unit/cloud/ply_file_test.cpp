#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/cloud/point_cloud.hpp"
#include "core/file/atomic_file.hpp"

namespace nextview {
namespace {

class PlyFile : public testing::Test {
 protected:
  PlyFile()
      : folder_(std::filesystem::temp_directory_path() /
                ("nextview_ply_" + std::to_string(::getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~PlyFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file_with(const std::string& bytes) const {
    std::ofstream(folder_ / "cloud.ply", std::ios::binary) << bytes;
    return folder_ / "cloud.ply";
  }
  /// The one line that reading these bytes fails with.
  std::string error_of(const std::string& bytes) const {
    try {
      read_ply(file_with(bytes));
    } catch (const std::runtime_error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("cloud.ply"), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return message;
    }
    return "no error";
  }
  std::size_t files() const {
    return std::size_t(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }

  std::filesystem::path folder_;
};

std::string content(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

/// The bytes of a number, lowest first or, reversed, highest first.
template <class T>
std::string bytes(T value, bool reversed = false) {
  std::string result(sizeof value, '\0');
  std::memcpy(result.data(), &value, sizeof value);
  return reversed ? std::string(result.rbegin(), result.rend()) : result;
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";

TEST_F(PlyFile, WritesWhatTheFormatSays) {
  write_ply({{1.0f, -2.5f, 3e-7f}, {0.0f, 1e9f, -0.0f}}, folder_ / "a.ply");
  const std::string data = content(folder_ / "a.ply");
  const std::size_t end = data.find("end_header\n") + 11;
  EXPECT_TRUE(data.starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_NE(data.find("\nelement vertex 2\n" + xyz), std::string::npos);
  EXPECT_EQ(data.substr(end), bytes(1.0f) + bytes(-2.5f) + bytes(3e-7f) + bytes(0.0f) + bytes(1e9f) + bytes(-0.0f));
  EXPECT_EQ(files(), 1u);
}

TEST_F(PlyFile, ReadsBackWhatItWrote) {
  PointCloud cloud;
  for (int i = 0; i < 1000; ++i) cloud.emplace_back(0.1f * float(i), -1.0f / float(i + 1), 1e-20f * float(i));
  write_ply(cloud, folder_ / "a.ply");
  EXPECT_EQ(read_ply(folder_ / "a.ply"), cloud);
  write_ply({}, folder_ / "a.ply");
  EXPECT_TRUE(read_ply(folder_ / "a.ply").empty());
}

TEST_F(PlyFile, ReadsAsciiWithOtherPropertiesElementsAndLineEnds) {
  const auto file = file_with(
      "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nobj_info 1\r\nelement camera 2\r\nproperty list uchar float "
      "view\r\n"
      "element vertex 2\r\nproperty uchar red\r\nproperty double z\r\nproperty float x\r\nproperty float y\r\n"
      "element face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n"
      "2 1.5 2.5\r\n0\r\n255 3 1 2\r\n0 -6e-1 4 5.25\r\n3 0 1 0\r\n");
  EXPECT_EQ(read_ply(file), (PointCloud{{1, 2, 3}, {4, 5.25f, -0.6f}}));
  const auto shortest = file_with("ply\nformat ascii 1.0\nelement vertex 1\n" + xyz + "end_header\n1 2 3");
  EXPECT_EQ(read_ply(shortest), (PointCloud{{1, 2, 3}}));
}

TEST_F(PlyFile, ReadsBothByteOrdersAndAllTypes) {
  for (const bool big : {false, true}) {
    const std::string header = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                               "_endian 1.0\nelement extra 1\nproperty list ushort short numbers\nelement vertex 1\n"
                               "property int8 a\nproperty uint32 x\nproperty float64 y\nproperty int16 z\nend_header\n";
    const auto file =
        file_with(header + bytes(std::uint16_t(2), big) + bytes(std::int16_t(7), big) + bytes(std::int16_t(8), big) +
                  bytes(std::int8_t(-1)) + bytes(std::uint32_t(4000000000u), big) + bytes(0.125, big) +
                  bytes(std::int16_t(-300), big));
    EXPECT_EQ(read_ply(file), (PointCloud{{4e9f, 0.125f, -300.0f}})) << big;
  }
}

TEST_F(PlyFile, ClaimsLargerThanTheFileAreRefusedBeforeAnythingIsAllocated) {
  for (const char* format : {"ascii", "binary_little_endian"})
    for (const char* count : {"3", "1000000000000", "18446744073709551615"}) {
      const std::string message = error_of(std::string("ply\nformat ") + format + " 1.0\nelement vertex " + count +
                                           "\n" + xyz + "end_header\n1 2 3 4 5 6 7");
      EXPECT_NE(message.find(std::string("claims ") + count), std::string::npos) << message;
    }
}

TEST_F(PlyFile, EveryWayToBeBrokenHasItsReason) {
  const std::string ascii = "ply\nformat ascii 1.0\n";
  const auto expect = [&](const std::string& data, const std::string& reason) {
    EXPECT_NE(error_of(data).find(reason), std::string::npos) << error_of(data);
  };
  expect("", "no PLY file");
  expect("solid cube\n", "no PLY file");
  expect(ascii + "element vertex 1\n" + xyz, "no end_header");
  expect("ply\nelement vertex 0\n" + xyz + "end_header\n", "names no format");
  expect("ply\nformat utf8 1.0\nend_header\n", "format 'utf8'");
  expect(ascii + "end_header\n", "no element 'vertex'");
  expect(ascii + "element vertex -3\n" + xyz + "end_header\n", "no valid count ('-3')");
  expect(ascii + "element vertex 1\nproperty float x\nproperty float y\nend_header\n1 2\n", "lack x, y or z");
  expect(ascii + "element vertex 1\nproperty quad x\nend_header\n1\n", "unknown type 'quad'");
  expect(ascii + "property float x\nend_header\n", "before the first element");
  expect(ascii + "vertices 3\nend_header\n", "no element 'vertex'");
  expect(ascii + std::string(1 << 21, '\n') + "end_header\n", "its header exceeds 1048576 bytes");
  expect(ascii + "element vertex 2\n" + xyz + "end_header\n1 2 3\n4 five 6\n", "vertex 2 of 2 is cut off");
  expect(ascii + "element vertex 2\n" + xyz + "end_header\n1.00000 2.0000 3.00000\n4 5\n", "vertex 2 of 2 is cut off");
  expect(ascii + "element vertex 1\n" + xyz + "end_header\n1 nan 3\n", "vertex 1 of 1 is not finite");
  expect(ascii + "element vertex 1\n" + xyz + "end_header\n1 1e300 3\n", "vertex 1 of 1 is not finite");
  expect(ascii + "element nothing 99\nelement vertex 0\n" + xyz + "end_header\n", "claims 99");
  expect("ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int i\nelement vertex 0\n" + xyz +
             "end_header\n" + bytes(0xffffffffu),
         "ends within face 1 of 1");
}

TEST_F(PlyFile, MissingFilesAndFoldersAreNamed) {
  for (const auto& file : {folder_ / "missing.ply", folder_}) {
    try {
      read_ply(file);
      ADD_FAILURE() << "accepted " << file;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string() + ": cannot be read: "), std::string::npos)
          << error.what();
    }
  }
  EXPECT_THROW(write_ply({}, folder_ / "missing" / "a.ply"), std::runtime_error);
}

TEST_F(PlyFile, AFullDiskLosesNothing) {
  const PointCloud before = {{1, 2, 3}};
  write_ply(before, folder_ / "a.ply");
  rlimit old_limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  rlimit limit = old_limit;
  limit.rlim_cur = 4096;  // as if the disk had no more room
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::string message;
  try {
    write_ply(PointCloud(10000, Eigen::Vector3f::Zero()), folder_ / "a.ply");
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(message.find((folder_ / "a.ply").string() + ": cannot be written: "), std::string::npos) << message;
  EXPECT_EQ(read_ply(folder_ / "a.ply"), before);
  EXPECT_EQ(files(), 1u);
}

/// The header, number format and trailing blanks of Stanford's meshes.
TEST_F(PlyFile, ReadsTheVerticesOfAMeshAsStanfordWritesIt) {
  std::string text =
      "ply\nformat ascii 1.0\ncomment zipper output\nelement vertex 5000\nproperty float x\nproperty float y\n"
      "property float z\nproperty float confidence\nproperty float intensity\nelement face 4998\n"
      "property list uchar int vertex_indices\nend_header\n";
  PointCloud expected;
  for (int i = 0; i < 5000; ++i) {
    expected.emplace_back(-0.0378297f + 1e-5f * float(i), 0.12794f, 0.00447467f * float(i % 7));
    text += fmt::format("{:.9g} {:.9g} {:.9g} 0.850855 0.5 \n", expected[i].x(), expected[i].y(), expected[i].z());
  }
  for (int i = 0; i < 4998; ++i) text += fmt::format("3 {} {} {} \n", i, i + 1, i + 2);
  write_file(folder_ / "mesh.ply", text);
  EXPECT_EQ(read_ply(folder_ / "mesh.ply"), expected);
}

TEST_F(PlyFile, ReadsTheStanfordBunnysVertices) {
  const std::filesystem::path archive =
      std::filesystem::path(NEXTVIEW_SHARED_DIR) / "data/scans/stanford_bunny/bun_zipper.ply.gz";
  if (!std::filesystem::exists(archive))
    GTEST_SKIP() << "an addition: " << archive << " is not there, so a file like it was read, but not the real one";
  ASSERT_EQ(std::system(("gzip -dc '" + archive.string() + "' > '" + (folder_ / "bunny.ply").string() + "'").c_str()),
            0);
  const PointCloud cloud = read_ply(folder_ / "bunny.ply");
  EXPECT_EQ(cloud.size(), 35947u);
  EXPECT_EQ(cloud.front(), Eigen::Vector3f(-0.0378297f, 0.12794f, 0.00447467f));
}

}  // namespace
}  // namespace nextview
