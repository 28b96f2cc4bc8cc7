#pragma once
#include <cstdint>
#include <string>

namespace nextview {

/// Most significant byte first, as all of PNG's.
std::string png_number(std::uint32_t number, int count = 4);
/// A chunk of a PNG: its name and what it holds, with length and check sum.
std::string png_chunk(const std::string& content);

}  // namespace nextview
