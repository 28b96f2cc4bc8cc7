#pragma once
#include <array>
#include <cstdint>

namespace nextview {

using Colour = std::array<double, 3>;  ///< sRGB, 0 to 1

/// The product's one look: windows, figures and screenshots. Meanings differ in lightness as well as in hue, so that
/// they are told apart with any colour vision and in grey print.
namespace theme {

constexpr Colour from_hex(std::uint32_t rgb) {
  return {(rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0};
}

inline constexpr Colour paper = from_hex(0xFFFFFF);     ///< behind charts and text
inline constexpr Colour sky = from_hex(0xEEF1F5);       ///< top of a 3D scene's background
inline constexpr Colour ground = from_hex(0xFBFCFD);    ///< bottom of it
inline constexpr Colour ink = from_hex(0x1B2430);       ///< text
inline constexpr Colour soft_ink = from_hex(0x5B6675);  ///< secondary text, axes
inline constexpr Colour hairline = from_hex(0xD3D9E1);  ///< grid lines, frames

inline constexpr Colour object = from_hex(0xB9BFC9);
inline constexpr Colour cloud = from_hex(0x6B7C93);
inline constexpr Colour new_scan = from_hex(0xE0761E);        ///< that may not fit the cloud
inline constexpr Colour corrected_scan = from_hex(0x45B8D0);  ///< the same where registration puts it
inline constexpr Colour region = from_hex(0x8A95A3);

inline constexpr Colour occupied = from_hex(0x4A7DB3);
inline constexpr Colour unknown = from_hex(0xE8B04A);
inline constexpr Colour free = from_hex(0x9CCBD9);

inline constexpr Colour reconstructed = from_hex(0x5FA88C);  ///< surface, where no value paints it
inline constexpr Colour cut = from_hex(0xD9DEE5);            ///< the object's inside, where a section cuts it

inline constexpr Colour missed = from_hex(0xD9722E);  ///< surface that no view has seen

inline constexpr Colour unreachable = from_hex(0xC4B49A);  ///< views that the robot cannot take
inline constexpr Colour chosen = from_hex(0xD1401F);
inline constexpr Colour muted = from_hex(0x6E7781);

/// Series of a chart, in this order.
inline constexpr std::array<Colour, 5> series{from_hex(0x1F5FA8), from_hex(0xD1401F), from_hex(0x2C8C6B),
                                              from_hex(0x8A5BB5), from_hex(0xB07A10)};

inline constexpr int small_text = 13;  ///< [px] legends, axes
inline constexpr int text = 14;        ///< [px]
inline constexpr int caption = 15;     ///< [px] panel captions, semi-bold
inline constexpr int title = 22;       ///< [px] a figure's title, semi-bold

}  // namespace theme
}  // namespace nextview
