#include "core/recording/depth_image_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <cmath>

#include "tests/unit/file/gzip.hpp"
#include "tests/unit/recording/made_recording.hpp"

namespace nextview {
namespace {

using namespace made_recording;
using testing::HasSubstr;

constexpr PinholeCamera six_pixels{0, 0, 2.0, 4.0, 1.0, 0.5};
const std::vector<std::uint16_t> values = {0, 1, 1000, 2000, 65535, 300};  // 3 x 2

/// The definition: depth along z, times the length of the ray through the pixel to z = 1.
float range_of(double depth, int u, int v) {
  return static_cast<float>(depth * std::hypot((u - 1.0) / 2.0, (v - 0.5) / 4.0, 1.0));
}

void expect_values(const DepthImage& image) {
  ASSERT_EQ(image.camera.width, 3);
  ASSERT_EQ(image.camera.height, 2);
  EXPECT_EQ(image.camera.fx, 2.0);
  EXPECT_TRUE(std::isnan(image.range[0])) << "zero says nothing";
  EXPECT_FLOAT_EQ(image.range[1], range_of(0.001, 1, 0));
  EXPECT_FLOAT_EQ(image.range[2], range_of(1.0, 2, 0));
  EXPECT_FLOAT_EQ(image.range[3], range_of(2.0, 0, 1));
  EXPECT_TRUE(std::isnan(image.range[4])) << "the greatest value says nothing";
  EXPECT_FLOAT_EQ(image.range[5], range_of(0.3, 2, 1));
}

TEST(DepthImageFile, EveryKindHoldsTheSameDepths) {
  const TemporaryFolder folder;
  expect_values(read_depth_image(folder.write("a.png", depth_png(3, 2, values)), {}, six_pixels));
  expect_values(read_depth_image(folder.write("a.pgm", pgm(3, 2, values)), {}, six_pixels));
  expect_values(read_depth_image(folder.write("a.npy", npy(2, 3, "<u2", raw(values))), {}, six_pixels));
  DepthFormat bin;
  bin.width = 3, bin.height = 2, bin.offset = 8;
  expect_values(read_depth_image(folder.write("a.bin", "12345678" + raw(values)), bin, six_pixels));
  write_gzip(folder / "a.bin.gz", "12345678" + raw(values));
  expect_values(read_depth_image(folder / "a.bin.gz", bin, six_pixels));
}

TEST(DepthImageFile, FloatsAreNumbersBeyondOrNothing) {
  const TemporaryFolder folder;
  const std::vector<float> reals = {1.5f, NAN, INFINITY, -1.0f, 0.0f, 2.0f};
  DepthFormat format;
  format.scale = 1.0, format.measures = DepthMeasures::range, format.zero = ZeroDepth::beyond;
  const auto file = folder.write("a.npy", npy(2, 3, "<f4", raw(reals)));
  const DepthImage image = read_depth_image(file, format, six_pixels);
  EXPECT_EQ(image.range[0], 1.5f);
  EXPECT_TRUE(std::isnan(image.range[1]));
  EXPECT_TRUE(std::isinf(image.range[2]));
  EXPECT_TRUE(std::isnan(image.range[3]));
  EXPECT_TRUE(std::isinf(image.range[4]));
  EXPECT_EQ(image.range[5], 2.0f);
  format.width = 3, format.height = 2, format.type = RawType::float32;
  EXPECT_EQ(read_depth_image(folder.write("a.raw", raw(reals)), format, six_pixels).range[5], 2.0f);
}

TEST(DepthImageFile, RotatedBitsAreTurnedBack) {
  const TemporaryFolder folder;
  DepthFormat format;
  format.scale = 1e-4, format.encoding = DepthEncoding::rotate3, format.measures = DepthMeasures::range;
  std::vector<std::uint16_t> stored;
  for (const unsigned depth : {8192u, 10000u, 1u, 0u})
    stored.push_back(static_cast<std::uint16_t>((depth << 3 | depth >> 13) & 65535u));
  const DepthImage image = read_depth_image(folder.write("a.png", depth_png(4, 1, stored)), format, six_pixels);
  EXPECT_FLOAT_EQ(image.range[0], 0.8192f);
  EXPECT_FLOAT_EQ(image.range[1], 1.0f);
  EXPECT_FLOAT_EQ(image.range[2], 1e-4f);
  EXPECT_TRUE(std::isnan(image.range[3]));
}

TEST(DepthImageFile, MaskedPixelsAreInvalid) {
  const TemporaryFolder folder;
  const std::string rows("\0\x00\xff\x00\0\x01\x00\x00", 8);
  const ImageMask mask = read_mask(folder.write("mask.png", png(3, 2, 8, 0, rows)));
  EXPECT_EQ(mask.ignored, (std::vector<bool>{false, true, false, true, false, false}));
  const auto file = folder.write("a.png", depth_png(3, 2, {9, 9, 9, 9, 9, 9}));
  const DepthImage image = read_depth_image(file, {}, six_pixels, &mask);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(std::isnan(image.range[i]), mask.ignored[i]) << i;
  const ImageMask other{2, 2, {false, false, false, false}};
  EXPECT_THAT(failure_of([&] { read_depth_image(file, {}, six_pixels, &other); }), HasSubstr("the mask 2 x 2"));
}

/// Rows of random bytes with every filter, of every kind of PNG, as stb's reader takes them.
TEST(DepthImageFile, PngsAreReadAsByAnotherReader) {
  std::mt19937 random(3);
  for (const auto [kind, bits, channels] :
       {std::array{0, 16, 1}, {2, 16, 3}, {0, 8, 1}, {4, 8, 2}, {6, 16, 4}, {0, 2, 1}}) {
    constexpr int width = 37, height = 29;
    std::string rows;
    for (int v = 0; v < height; ++v) {
      rows += static_cast<char>(v % 5);
      for (int i = 0; i < (width * bits * channels + 7) / 8; ++i) rows += static_cast<char>(random());
    }
    const std::string file = png(width, height, bits, kind, rows);
    const ImageValues image = decode_png(file);
    int w = 0, h = 0, c = 0;
    const auto* bytes = reinterpret_cast<const stbi_uc*>(file.data());
    const std::unique_ptr<stbi_us, decltype(&stbi_image_free)> expected(
        stbi_load_16_from_memory(bytes, static_cast<int>(file.size()), &w, &h, &c, 0), stbi_image_free);
    ASSERT_TRUE(expected) << stbi_failure_reason();
    ASSERT_EQ((std::array{image.width, image.height, image.channels}), (std::array{w, h, c}));
    const int widen = bits == 16 ? 1 : bits == 8 ? 257 : 85 * 257;  // stb spreads values over 16 bits
    for (std::size_t i = 0; i < image.whole.size(); ++i) ASSERT_EQ(image.whole[i] * widen, expected.get()[i]) << i;
  }
}

TEST(DepthImageFile, WhatCannotBeRightIsOneLineThatNamesTheFile) {
  const TemporaryFolder folder;
  const auto why = [&](const std::string& name, const std::string& bytes, const DepthFormat& format = {}) {
    const auto file = folder.write(name, bytes);
    const std::string text = failure_of([&] { read_depth_image(file, format, six_pixels); });
    EXPECT_EQ(text.find('\n'), std::string::npos);
    EXPECT_THAT(text, testing::StartsWith(file.string() + ": "));
    return text;
  };
  EXPECT_THAT(why("8.png", png(1, 1, 8, 0, std::string(2, '\0'))), HasSubstr("8 bits"));
  EXPECT_THAT(why("rgb.png", png(1, 1, 16, 2, std::string(7, '\0'))), HasSubstr("3 channels"));
  EXPECT_THAT(why("wide.png", png(16385, 1, 16, 0, "")), HasSubstr("claims 16385 x 1 pixels"));
  EXPECT_THAT(why("huge.png", png(16384, 16384, 16, 0, "")), HasSubstr("claims 16384 x 16384 pixels"));
  EXPECT_THAT(why("empty.png", png(8000, 8000, 16, 0, "")), HasSubstr("truncated"));
  EXPECT_THAT(why("cut.png", depth_png(3, 2, values).substr(0, 60)), HasSubstr("truncated"));
  std::string flipped = depth_png(3, 2, values);
  flipped[50] = static_cast<char>(flipped[50] ^ 1);
  EXPECT_THAT(why("flipped.png", flipped), HasSubstr("checksum"));
  EXPECT_THAT(why("a.pgm", pgm(3, 2, values).substr(0, 30)), HasSubstr("truncated"));
  EXPECT_THAT(why("a.npy", npy(2, 4, "<u2", raw(values))), HasSubstr("bytes where 4 x 2 pixels"));
  EXPECT_THAT(why("b.npy", npy(2, 3, "<i8", raw(values))), HasSubstr("uint16, float32 or float64"));
  EXPECT_THAT(why("a.bin", raw(values)), HasSubstr("width, height and type must be given"));
  DepthFormat bin;
  bin.width = 3, bin.height = 3;
  EXPECT_THAT(why("b.bin", raw(values), bin), HasSubstr("has 12 bytes where 3 x 3 pixels"));
  bin.width = 100000;
  EXPECT_THAT(why("c.bin", raw(values), bin), HasSubstr("claims 100000 x 3"));
}

TEST(DepthImageFile, DamageIsSurvived) {
  const TemporaryFolder folder;
  const std::vector<std::uint16_t> many(40 * 30, 1234);
  const auto read = [](const auto& file) { read_depth_image(file, {}, six_pixels); };
  survives_damage(folder, "a.png", depth_png(40, 30, many), read);
  survives_damage(folder, "a.npy", npy(30, 40, "<u2", raw(many)), read);
  survives_damage(folder, "a.pgm", pgm(40, 30, many), read);
  DepthFormat bin;
  bin.width = 40, bin.height = 30;
  survives_damage(folder, "a.bin", raw(many), [&](const auto& file) { read_depth_image(file, bin, six_pixels); });
}

}  // namespace
}  // namespace nextview
