#include "ui/render_target/animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "core/file/atomic_file.hpp"
#include "ui/render_target/png_chunk.hpp"

namespace nextview {
namespace {

constexpr std::size_t signature_size = 8;
constexpr int longest = 65535;  // that a picture can be shown for, in two bytes

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (const char byte : bytes.substr(at, 4)) number = number << 8 | static_cast<unsigned char>(byte);
  return number;
}

/// What all chunks of this name in a PNG hold.
std::string contents(std::string_view png, std::string_view name) {
  std::string all;
  for (std::size_t at = signature_size; at + 12 <= png.size();) {
    const std::size_t length = number_at(png, at);
    if (png.substr(at + 4, 4) == name) all += png.substr(at + 8, length);
    at += length + 12;
  }
  return all;
}

struct Box {
  int left, top, right, bottom;  ///< [px]; the latter two are beyond it
};

/// Where two pictures of one size differ; nothing is left of its right border if they do not.
Box difference(const Image& a, const Image& b) {
  Box box{a.width, a.height, 0, 0};
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::size_t at = (std::size_t(y) * a.width + x) * 4;
      if (std::equal(&a.rgba[at], &a.rgba[at] + 3, &b.rgba[at])) continue;
      box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1), y + 1};
    }
  return box;
}

Image part_of(const Image& image, const Box& box) {
  Image part{box.right - box.left, box.bottom - box.top, {}};
  for (int y = box.top; y < box.bottom; ++y) {
    const auto first = image.rgba.begin() + (std::ptrdiff_t(y) * image.width + box.left) * 4;
    part.rgba.insert(part.rgba.end(), first, first + part.width * 4);
  }
  return part;
}

}  // namespace

void Animation::add(const Image& picture) {
  if (picture.rgba.empty()) throw std::invalid_argument("animation: a picture is empty");
  if (changes_.empty()) {
    changes_.push_back({0, 0, picture.width, picture.height, 1, contents(png_bytes(picture, {}, 3), "IDAT")});
    last_ = picture;
    return;
  }
  if (picture.width != last_.width || picture.height != last_.height)
    throw std::invalid_argument(fmt::format("animation: a picture of {} x {} among those of {} x {}", picture.width,
                                            picture.height, last_.width, last_.height));
  Box box = difference(last_, picture);
  if (box.left >= box.right && changes_.back().shown < longest) {
    ++changes_.back().shown;
    return;
  }
  if (box.left >= box.right) box = {0, 0, 1, 1};
  const Image changed = part_of(picture, box);
  changes_.push_back(
      {box.left, box.top, changed.width, changed.height, 1, contents(png_bytes(changed, {}, 3), "IDAT")});
  last_ = picture;
}

void Animation::write(const std::filesystem::path& file) const {
  if (changes_.empty()) throw std::runtime_error(fmt::format("{}: the animation has no pictures", file.string()));
  const std::string frame = png_bytes(last_, {}, 3);
  std::string png = frame.substr(0, signature_size) + png_chunk("IHDR" + contents(frame, "IHDR")) +
                    png_chunk("acTL" + png_number(std::uint32_t(changes_.size())) + png_number(0));  // 0: over and over
  std::uint32_t number = 0;
  for (const Change& c : changes_) {
    std::string control = "fcTL" + png_number(number++);
    for (const int length : {c.width, c.height, c.x, c.y}) control += png_number(std::uint32_t(length));
    control += png_number(std::uint32_t(c.shown), 2) + png_number(std::uint32_t(pictures_per_second_), 2);
    png += png_chunk(control + png_number(0, 2));  // it stays, and takes the place of what was there
    png += png_chunk(number == 1 ? "IDAT" + c.pixels : "fdAT" + png_number(number++) + c.pixels);
  }
  write_file(file, png + png_chunk("IEND"));
}

}  // namespace nextview
