#pragma once
#include <string>
#include <string_view>

#include "ui/appearance/theme.hpp"

namespace nextview {

// Words and colours in HTML and SVG.

/// Text as it is shown, whatever it holds.
std::string markup_text(std::string_view text);
/// "#1b2430"
std::string markup_colour(const Colour& colour);

}  // namespace nextview
