#include "tests/render/picture_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace nextview {

PictureBound::PictureBound(double changed, int largest, std::string why)
    : changed_share(changed), largest_difference(largest), reason(std::move(why)) {
  if (reason.empty()) throw std::invalid_argument("a bound other than the default needs a reason");
}

bool PictureDifference::within(const PictureBound& bound) const {
  return same_size && changed_share <= bound.changed_share && largest_difference <= bound.largest_difference;
}

std::string PictureDifference::summary() const {
  if (!same_size) return "the sizes differ";
  return fmt::format("{:.4f} % of the pixels changed, the largest difference is {} of 255", 100 * changed_share,
                     largest_difference);
}

PictureDifference compare(const Image& expected, const Image& actual) {
  PictureDifference result;
  result.same_size = expected.width == actual.width && expected.height == actual.height;
  if (!result.same_size) return result;
  result.picture = {expected.width, expected.height, std::vector<std::uint8_t>(expected.rgba.size(), 255)};
  std::size_t changed = 0;
  for (std::size_t pixel = 0; pixel < expected.rgba.size(); pixel += 4) {
    int difference = 0;
    for (std::size_t c = pixel; c < pixel + 4; ++c) {
      difference = std::max(difference, std::abs(int(expected.rgba[c]) - int(actual.rgba[c])));
    }
    result.largest_difference = std::max(result.largest_difference, difference);
    std::uint8_t* const shown = &result.picture.rgba[pixel];
    if (difference > PictureBound::visible) {
      ++changed;
      shown[1] = shown[2] = static_cast<std::uint8_t>(255 - std::min(255, 80 + difference));
    } else {
      shown[0] = shown[1] = shown[2] = static_cast<std::uint8_t>(160 + expected.rgba[pixel + 1] * 95 / 255);
    }
  }
  result.changed_share = double(changed) / (double(expected.width) * expected.height);
  return result;
}

}  // namespace nextview
