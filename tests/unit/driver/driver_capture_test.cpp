#include "core/driver/driver_capture.hpp"

#include <gmock/gmock.h>

#include "core/cloud/point_cloud.hpp"
#include "core/file/npy_file.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;
using namespace std::string_literals;

const PinholeCamera camera{4, 3, 4.0, 4.0, 1.5, 1.0};

/// 4 x 3 grey values of 16 bits: 0 1000 2000 65535, 1 2 3 4, 500 600 700 800; made with Python's zlib.
const std::string png16 =
    "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x04\0\0\0\x03\x10\0\0\0\0\xc1\x0f\x2d\x59\0\0\0\x23IDAT\x78\x9c\x63\x60\x60"
    "\x60"
    "\x7e\xc1\x7e\xe1\xff\x7f\x06\x06\x46\x06\x26\x06\x66\x06\x16\x06\xc6\x2f\x4c\x11\x4c\x7b\x98\x15\0\x59\x10\x05\xfb"
    "\x26\x75\xc8\x3d\0\0\0\0IEND\xae\x42\x60\x82"s;
/// The same of 8 bits, all 0.
const std::string png8 =
    "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x04\0\0\0\x03\x08\0\0\0\0\x91\x9f\xf1\x1a\0\0\0\x0bIDAT\x78\x9c\x63\x60\x40"
    "\x01\0"
    "\0\x0f\0\x01\xb5\x56\x29\x3e\0\0\0\0IEND\xae\x42\x60\x82"s;

CapturedFile file(const std::string& name, double scale = 0.0, const std::string& measures = {}) {
  return {Pose(Eigen::Translation3d(1, 2, 3)), name, scale, measures};
}

std::string reason(const CapturedFile& captured, const TemporaryFolder& folder) {
  try {
    read_capture(captured, folder / "", camera, 2.0);
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr((folder / captured.file).string()));
    return error.what();
  }
  return "it was read";
}

TEST(DriverCapture, OfRanges) {
  const TemporaryFolder folder;
  NpyTable table{4, 3, std::vector<float>(12, 0.5f)};
  table.values[1] = DepthImage::beyond_range;
  table.values[2] = DepthImage::invalid;
  write_npy(table, folder / "a.npy");
  const Capture capture = read_capture(file("a.npy"), folder / "", camera, 2.0);
  EXPECT_EQ(capture.T_world_camera.translation(), Vector3(1, 2, 3));
  EXPECT_EQ(capture.max_range, 2.0);
  const auto& image = std::get<DepthImage>(capture.measured);
  EXPECT_EQ(image.camera.width, 4);
  EXPECT_EQ(image.range[0], 0.5f);
  EXPECT_TRUE(DepthImage::is_beyond_range(image.range[1]));
  EXPECT_TRUE(std::isnan(image.range[2]));
  table.values[3] = 0.0f;
  write_npy(table, folder / "a.npy");
  EXPECT_THAT(reason(file("a.npy"), folder), HasSubstr("holds the range 0"));
  table.values[3] = -DepthImage::beyond_range;
  write_npy(table, folder / "a.npy");
  EXPECT_THAT(reason(file("a.npy"), folder), HasSubstr("holds the range -inf"));
  std::swap(table.columns, table.rows);
  write_npy(table, folder / "a.npy");
  EXPECT_THAT(reason(file("a.npy"), folder), HasSubstr("has 3 x 4 pixels"));
}

TEST(DriverCapture, OfAnImage) {
  const TemporaryFolder folder;
  folder.write("a.png", png16);
  const auto ranges = [&](const char* measures) {
    return std::get<DepthImage>(read_capture(file("a.png", 0.001, measures), folder / "", camera, 2.0).measured).range;
  };
  const std::vector<float> range = ranges("range"), z = ranges("z");
  ASSERT_EQ(range.size(), 12u);
  EXPECT_TRUE(std::isnan(range[0]) && std::isnan(z[0])) << "0 is invalid";
  EXPECT_FLOAT_EQ(range[1], 1.0f);
  EXPECT_TRUE(std::isnan(range[3])) << "65535: the sensor was saturated";
  EXPECT_FLOAT_EQ(range[11], 0.8f);
  EXPECT_FLOAT_EQ(z[1], 1.0f * float(Vector3(-0.5 / 4, -1.0 / 4, 1).norm()));
  EXPECT_FLOAT_EQ(z[11], 0.8f * float(Vector3(1.5 / 4, 1.0 / 4, 1).norm()));
}

TEST(DriverCapture, AnImageNeedsItsMeaning) {
  const TemporaryFolder folder;
  folder.write("a.png", png16);
  EXPECT_THAT(reason(file("a.png", 0.0, "z"), folder), HasSubstr("'scale'"));
  EXPECT_THAT(reason(file("a.png", 0.001), folder), HasSubstr("'measures'"));
  EXPECT_THAT(reason(file("a.png", 0.001, "depth"), folder), HasSubstr("'measures'"));
  folder.write("a.png", png8);
  EXPECT_THAT(reason(file("a.png", 0.001, "z"), folder), HasSubstr("16 are needed"));
  folder.write("a.png", "no image");
  EXPECT_THAT(reason(file("a.png", 0.001, "z"), folder), HasSubstr("neither PNG"));
  for (std::size_t size = 0; size < 60; ++size) {
    folder.write("a.png", png16.substr(0, size));
    EXPECT_NE(reason(file("a.png", 0.001, "z"), folder), "it was read") << size;
  }
}

TEST(DriverCapture, OfPoints) {
  const TemporaryFolder folder;
  write_ply({{1, 2, 3}, {0.5f, 0, 1}}, folder / "a.ply");
  const Capture capture = read_capture(file((folder / "a.ply").string()), "/elsewhere", camera, 2.0);
  const auto& points = std::get<std::vector<Vector3>>(capture.measured);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1], Vector3(0.5, 0, 1));
  folder.write("a.ply", "ply\n");
  EXPECT_NE(reason(file("a.ply"), folder), "it was read");
}

TEST(DriverCapture, RangesOfAnotherUnitAreNone) {
  const TemporaryFolder folder;
  NpyTable table{4, 3, std::vector<float>(12, DepthImage::beyond_range)};
  const auto of_ranges = [&] {
    write_npy(table, folder / "a.npy");
    return reason(file("a.npy"), folder);
  };
  table.values[0] = table.values[1] = 1500.0f;
  table.values[2] = 3.0f;
  EXPECT_THAT(of_ranges(), HasSubstr("ranges up to 1.5e+03 m, but hello says max_range 2 m: are they millimetres?"));
  table.values[1] = 19.0f;
  EXPECT_EQ(of_ranges(), "it was read") << "one is far off";
  write_ply({{0, 0, 800}, {0, 1, 900}, {0, 0, 1}}, folder / "a.ply");
  EXPECT_THAT(reason(file("a.ply"), folder), HasSubstr("ranges up to 900 m"));
}

TEST(DriverCapture, OfNothingIsNone) {
  const TemporaryFolder folder;
  const auto of_ranges = [&](float first) {
    NpyTable table{4, 3, std::vector<float>(12, DepthImage::invalid)};
    table.values[0] = first;
    write_npy(table, folder / "a.npy");
    return reason(file("a.npy"), folder);
  };
  EXPECT_THAT(of_ranges(DepthImage::invalid), HasSubstr("nothing was measured"));
  EXPECT_EQ(of_ranges(DepthImage::beyond_range), "it was read") << "that the way is free was";
  write_ply({}, folder / "a.ply");
  EXPECT_THAT(reason(file("a.ply"), folder), HasSubstr("nothing was measured"));
  EXPECT_THROW(read_capture(file("a.ply"), folder / "", camera, 2.0), NothingMeasured)
      << "who can look elsewhere is told from whose file is wrong";
}

TEST(DriverCapture, MustBeARegularFileOfAKnownKind) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a.ply");
  std::filesystem::create_symlink("/dev/zero", folder / "a.npy");
  std::filesystem::create_symlink("/dev/zero", folder / "a.png");
  EXPECT_NE(reason(file("a.ply"), folder), "it was read");
  EXPECT_THAT(reason(file("a.npy"), folder), HasSubstr("regular file"));
  EXPECT_THAT(reason(file("a.png", 1.0, "z"), folder), HasSubstr("regular file"));
  EXPECT_THAT(reason(file("a.txt"), folder), HasSubstr(".npy, .png, .ply"));
  EXPECT_THAT(reason(file("none.npy"), folder), HasSubstr("none.npy"));
}

}  // namespace
}  // namespace nextview
