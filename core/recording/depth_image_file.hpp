#pragma once
#include <filesystem>
#include <vector>

#include "core/recording/image_values.hpp"
#include "core/sensor/depth_image.hpp"

namespace nextview {

enum class DepthMeasures { z, range };        ///< along the camera's z axis, or along the pixel's ray
enum class ZeroDepth { invalid, beyond };     ///< what a value of 0 says: nothing, or that the way is free
enum class DepthEncoding { plain, rotate3 };  ///< rotate3: the bits of the value are rotated left by three

/// What the values of a depth image mean, and of an image without a header its size.
struct DepthFormat {
  int width = 0, height = 0;  ///< [px] of images without a header
  RawType type = RawType::uint16;
  int offset = 0;        ///< of the first value [bytes]
  double scale = 0.001;  ///< what a value of 1 stands for [m]
  DepthMeasures measures = DepthMeasures::z;
  ZeroDepth zero = ZeroDepth::invalid;
  DepthEncoding encoding = DepthEncoding::plain;
};

/// Pixels to leave out.
struct ImageMask {
  int width = 0, height = 0;  ///< [px]
  std::vector<bool> ignored;  ///< row by row
};

/// A PNG or PGM; a pixel is ignored where any channel but alpha is not 0. A name that ends in .gz is decompressed.
/// @throws std::runtime_error "FILE: reason"
ImageMask read_mask(const std::filesystem::path& file);

/// Reads a depth image: 16-bit grey PNG or PGM, .npy (uint16, float32 or float64), or values without a header, by what
/// its first bytes say; each may be compressed with gzip (.gz). The size is the file's, the rest of the camera
/// `intrinsics`. Not a number, negative, the greatest uint16 (sensors say so that they measured nothing) and masked
/// pixels are invalid; infinite is beyond range.
/// @throws std::runtime_error "FILE: reason": missing, truncated, damaged, absurd or differing sizes, 8 bits, colour
DepthImage read_depth_image(const std::filesystem::path& file, const DepthFormat& format,
                            const PinholeCamera& intrinsics, const ImageMask* mask = nullptr);

}  // namespace nextview
