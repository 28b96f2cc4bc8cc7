#include "tests/render/picture_comparison.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/file/png_text.hpp"
#include "core/file/read_file.hpp"

namespace nextview {
namespace {

Image grey(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(std::size_t(width) * height * 4, 128)};
}

TEST(PictureComparison, EqualPicturesDoNotDiffer) {
  const PictureDifference difference = compare(grey(40, 30), grey(40, 30));
  EXPECT_EQ(difference.changed_share, 0.0);
  EXPECT_EQ(difference.largest_difference, 0);
  EXPECT_TRUE(difference.within({}));
}

TEST(PictureComparison, OnePixelThatChangedMuchIsCaught) {
  Image changed = grey(400, 300);
  changed.rgba[27693] = 255;  // green of pixel (123, 17)
  const PictureDifference difference = compare(grey(400, 300), changed);
  EXPECT_EQ(difference.largest_difference, 127);
  EXPECT_DOUBLE_EQ(difference.changed_share, 1.0 / (400 * 300));
  EXPECT_FALSE(difference.within({}));
  EXPECT_NE(difference.picture, compare(grey(400, 300), grey(400, 300)).picture) << "the difference picture shows it";
}

TEST(PictureComparison, ManyPixelsThatChangedALittleAreCaught) {
  Image changed = grey(100, 100);
  for (std::size_t pixel = 0; pixel < 11; ++pixel) changed.rgba[124 * pixel] += PictureBound::visible + 1;
  EXPECT_FALSE(compare(grey(100, 100), changed).within({}));
  EXPECT_TRUE(compare(grey(100, 100), changed).within({0.002, 96, "twice the share"}));
}

TEST(PictureComparison, RoundingIsForgiven) {
  Image changed = grey(100, 100);
  for (auto& value : changed.rgba) value += PictureBound::visible;
  EXPECT_TRUE(compare(grey(100, 100), changed).within({}));
}

TEST(PictureComparison, AnotherSizeIsCaught) { EXPECT_FALSE(compare(grey(10, 20), grey(20, 10)).within({})); }

TEST(PictureComparison, ALooserBoundNeedsAReason) {
  EXPECT_THROW(PictureBound(0.1, 255, ""), std::invalid_argument);
  EXPECT_NO_THROW(PictureBound(0.1, 255, "points are drawn as spheres"));
}

class PngFile : public testing::Test {
 protected:
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("nextview-picture-" + std::to_string(::getpid()) + ".png");
  ~PngFile() override { std::filesystem::remove(file); }
};

TEST_F(PngFile, KeepsEveryPixel) {
  Image image = grey(33, 7);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = static_cast<std::uint8_t>(i * 37);
  write_png(image, file);
  EXPECT_EQ(read_png(file), image);
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
}

TEST_F(PngFile, SaysHowManyPixelsAnInchHas) {
  const auto resolution = [&] {
    const std::string bytes = read_file(file, 1 << 20);
    const std::size_t at = bytes.find("pHYs");
    return at == std::string::npos ? "" : bytes.substr(at + 4, 9);
  };
  write_png(grey(33, 7), file);
  EXPECT_EQ(resolution(), "");
  write_png(grey(33, 7), file, "seed = 1", 300.0);
  EXPECT_EQ(resolution(), std::string("\0\0\x2e\x23\0\0\x2e\x23\1", 9)) << "11811 pixels a metre";
  EXPECT_EQ(read_png(file), grey(33, 7));
  EXPECT_EQ(png_configuration(file), "seed = 1");
}

TEST_F(PngFile, ErrorsNameTheFile) {
  EXPECT_THROW(read_png(file), std::runtime_error) << "missing";
  std::ofstream(file) << "not a picture";
  EXPECT_THROW(read_png(file), std::runtime_error) << "not a picture";
  write_png(grey(64, 64), file);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THROW(read_png(file), std::runtime_error) << "truncated";
  EXPECT_THROW(write_png(grey(4, 4), "/nowhere/at/all.png"), std::runtime_error);
}

}  // namespace
}  // namespace nextview
