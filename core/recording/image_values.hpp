#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

namespace nextview {

/// More pixels along a side than any camera has: a file that claims so is damaged.
inline constexpr int largest_image_side = 16384;
/// And in all; keeps what one image takes below half a gigabyte.
inline constexpr std::int64_t most_image_pixels = std::int64_t{1} << 26;

/// An image as its file holds it, row by row, the channels of a pixel side by side.
struct ImageValues {
  int width = 0, height = 0;         ///< [px]
  int channels = 1;                  ///< 1 grey or palette, 2 with alpha, 3 colour, 4 colour with alpha
  int bits = 16;                     ///< of each value
  std::vector<std::uint16_t> whole;  ///< whole numbers, or empty
  std::vector<float> real;           ///< numbers, or empty
};

enum class RawType { uint16, float32, float64 };

/// Each takes the bytes of a file. @throws std::runtime_error with the reason alone, for the caller to name the file:
/// truncated, damaged, a size that no image has (before anything is allocated), a kind that is not read.
ImageValues decode_png(std::string_view bytes);  ///< all but interlaced
ImageValues decode_pgm(std::string_view bytes);  ///< binary (P5)
ImageValues decode_npy(std::string_view bytes);  ///< two-dimensional uint16, float32 or float64 of numpy, little-endian
/// Values without a header, little-endian, from `offset` [bytes] to exactly the end.
ImageValues decode_raw(std::string_view bytes, int width, int height, RawType type, std::size_t offset);

/// What the first bytes say that it is.
bool is_png(std::string_view bytes);
bool is_pgm(std::string_view bytes);
bool is_npy(std::string_view bytes);

/// @throws std::runtime_error with the reason if no image has this size [px].
void require_image_size(std::int64_t width, std::int64_t height);

}  // namespace nextview
