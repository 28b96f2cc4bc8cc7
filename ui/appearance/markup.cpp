#include "ui/appearance/markup.hpp"

#include <fmt/format.h>

#include <cmath>

namespace nextview {

std::string markup_text(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return result;
}

std::string markup_colour(const Colour& colour) {
  const auto channel = [](double value) { return int(std::lround(255 * value)); };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(colour[0]), channel(colour[1]), channel(colour[2]));
}

}  // namespace nextview
