// Animated PNGs: read again part by part, they show the pictures that they were made of.
#include "ui/render_target/animation.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/render/animation_pictures.hpp"
#include "tests/unit/map/in_temporary_folder.hpp"

namespace nextview {
namespace {

class Animations : public InTemporaryFolder {
 protected:
  static Image noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i)
      for (int channel = 0; channel < 4; ++channel)
        image.rgba.push_back(channel == 3 ? 255 : static_cast<std::uint8_t>(random()));
    return image;
  }
  std::vector<Image> shown(const std::vector<Image>& pictures) const {
    Animation animation(2);
    for (const Image& picture : pictures) animation.add(picture);
    animation.write(folder_ / "a.png");
    return animation_pictures(folder_ / "a.png");
  }
};

TEST_F(Animations, ShowWhatTheyWereMadeOf) {
  const Image first = noise(31, 17, 1), other = noise(31, 17, 2);
  Image corner = first, middle = first;
  for (std::uint8_t* last = &corner.rgba.back() - 3; last < &corner.rgba.back(); ++last) *last ^= 1;
  for (int x = 4; x < 9; ++x) middle.rgba[(6 * 31 + std::size_t(x)) * 4] ^= 128;
  const std::vector<Image> pictures = {first, first, corner, first, middle, middle, middle, other, first};
  EXPECT_EQ(shown(pictures), pictures);
  EXPECT_EQ(shown({first}), std::vector<Image>{first});
  EXPECT_EQ(read_png(folder_ / "a.png"), first) << "what does not know of motion shows the first";
}

TEST_F(Animations, AreSmallWhereNothingMoves) {
  const Image still = noise(64, 64, 1);
  static_cast<void>(shown({still}));
  const auto one = std::filesystem::file_size(folder_ / "a.png");
  static_cast<void>(shown(std::vector<Image>(50, still)));
  EXPECT_EQ(std::filesystem::file_size(folder_ / "a.png"), one);
}

TEST_F(Animations, SayWhatIsWrong) {
  Animation animation(2);
  EXPECT_THROW(animation.write(folder_ / "none.png"), std::runtime_error);
  EXPECT_THROW(animation.add({}), std::invalid_argument);
  animation.add(noise(8, 8, 1));
  EXPECT_THROW(animation.add(noise(8, 9, 1)), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none.png"));
}

TEST(SideBySide, EachRowIsThatOfOneAndThenOfTheOther) {
  Image left{2, 2, {}}, right{1, 2, {}};
  for (std::uint8_t i = 0; i < 16; ++i) left.rgba.push_back(i);
  for (std::uint8_t i = 100; i < 108; ++i) right.rgba.push_back(i);
  const std::vector<std::uint8_t> rows = {0, 1, 2,  3,  4,  5,  6,  7,  100, 101, 102, 103,
                                          8, 9, 10, 11, 12, 13, 14, 15, 104, 105, 106, 107};
  EXPECT_EQ(side_by_side(left, right), (Image{3, 2, rows}));
}

}  // namespace
}  // namespace nextview
