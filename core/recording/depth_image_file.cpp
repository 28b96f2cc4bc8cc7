#include "core/recording/depth_image_file.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "core/file/gzip_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// The greatest image of floats, and a header.
constexpr std::uintmax_t largest_image_file = most_image_pixels * 4 + (1 << 20);

ImageValues decode(std::string_view bytes, const DepthFormat& format) {
  if (is_png(bytes)) return decode_png(bytes);
  if (is_pgm(bytes) && format.width == 0) return decode_pgm(bytes);
  if (is_npy(bytes)) return decode_npy(bytes);
  if (format.width == 0 || format.height == 0)
    throw std::runtime_error(
        "is neither PNG, PGM (P5) nor .npy; of values without a header, width, height and type must be given");
  return decode_raw(bytes, format.width, format.height, format.type, static_cast<std::size_t>(format.offset));
}

void require_depths(const ImageValues& image) {
  if (image.channels != 1)
    throw std::runtime_error(fmt::format("has {} channels; a depth image has one", image.channels));
  if (image.bits < 16)
    throw std::runtime_error(
        fmt::format("has {} bits a pixel: too coarse for depths (a picture of them?); 16 are needed", image.bits));
}

/// What one value says, as the file has it: a depth [m] and not yet along the ray, beyond or invalid.
float depth_of(double value, bool saturated, const DepthFormat& format) {
  if (std::isnan(value) || value < 0.0 || saturated) return DepthImage::invalid;
  if (std::isinf(value)) return DepthImage::beyond_range;
  if (value == 0.0) return format.zero == ZeroDepth::beyond ? DepthImage::beyond_range : DepthImage::invalid;
  const double depth = value * format.scale;
  constexpr double farthest = 1e6;  // [m]
  return depth <= farthest ? static_cast<float>(depth) : DepthImage::invalid;
}

float depth_at(const ImageValues& image, std::size_t i, const DepthFormat& format) {
  if (!image.real.empty()) return depth_of(image.real[i], false, format);
  std::uint16_t value = image.whole[i];
  const bool saturated = value == 65535;
  if (format.encoding == DepthEncoding::rotate3) value = static_cast<std::uint16_t>(value >> 3 | value << 13);
  return depth_of(value, saturated, format);
}

DepthImage depth_image(const ImageValues& image, const DepthFormat& format, PinholeCamera camera,
                       const ImageMask* mask) {
  camera.width = image.width;
  camera.height = image.height;
  if (mask && (mask->width != image.width || mask->height != image.height))
    throw std::runtime_error(
        fmt::format("has {} x {} pixels, the mask {} x {}", image.width, image.height, mask->width, mask->height));
  DepthImage depths{camera, std::vector<float>(static_cast<std::size_t>(image.width) * image.height)};
  std::size_t i = 0;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u, ++i) {
      const float depth = mask && mask->ignored[i] ? DepthImage::invalid : depth_at(image, i, format);
      const bool along_z = format.measures == DepthMeasures::z && DepthImage::is_range(depth);
      depths.range[i] = along_z ? static_cast<float>(depth / camera.direction(u, v).z()) : depth;
    }
  return depths;
}

std::runtime_error named(const fs::path& file, const std::exception& error) {
  return std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
}

}  // namespace

ImageMask read_mask(const fs::path& file) {
  const std::string bytes = read_plain_or_gzip(file, largest_image_file);
  try {
    if (!is_png(bytes) && !is_pgm(bytes)) throw std::runtime_error("is neither PNG nor PGM (P5)");
    const ImageValues image = is_png(bytes) ? decode_png(bytes) : decode_pgm(bytes);
    ImageMask mask{image.width, image.height, {}};
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t seen = channels % 2 == 0 ? channels - 1 : channels;  // the last of an even number is alpha
    for (std::size_t i = 0; i < image.whole.size(); i += channels) {
      bool ignored = false;
      for (std::size_t c = 0; c < seen; ++c) ignored |= image.whole[i + c] != 0;
      mask.ignored.push_back(ignored);
    }
    return mask;
  } catch (const std::runtime_error& error) {
    throw named(file, error);
  }
}

DepthImage read_depth_image(const fs::path& file, const DepthFormat& format, const PinholeCamera& intrinsics,
                            const ImageMask* mask) {
  const std::string bytes = read_plain_or_gzip(file, largest_image_file);
  try {
    const ImageValues image = decode(bytes, format);
    require_depths(image);
    return depth_image(image, format, intrinsics, mask);
  } catch (const std::runtime_error& error) {
    throw named(file, error);
  }
}

}  // namespace nextview
