#pragma once
#include <imgui.h>

#include <string>
#include <vector>

#include "tests/unit/panels/desk.hpp"
#include "ui/appearance/colour_map.hpp"

namespace nextview {

/// Words that stand in the picture of a frame: read from its glyphs, so also what no widget of ImGui wrote, and only
/// what the user can see.
struct SeenText {
  std::string text;
  ImVec2 from, to;  ///< [px]
  ImU32 colour = 0;
  std::string window;  ///< that it is in: "Candidates"

  float middle() const { return (from.y + to.y) / 2; }
};

/// All words of the last frame, as they were drawn: a run of letters in one line each.
std::vector<SeenText> seen_texts();
/// Words of the last frame that end, or begin, beyond where their window or column does, so that a part of them is not
/// seen; what is scrolled away upwards or downwards is none.
std::vector<SeenText> cut_texts();
/// The words of a window as people read them: line by line, joined by a space; "" if it is not there. Without a name:
/// of all windows.
std::string read(const std::string& window = "");
/// What the tooltip says, if there is one.
std::string read_tooltip();
/// The lines of a window, from the uppermost; what stands beside each other in one is joined by a space.
std::vector<std::string> read_lines(const std::string& window);
/// The first run of letters that reads so, or begins so.
const SeenText* find_text(const std::vector<SeenText>& all, const std::string& text, const std::string& window = "");

/// Plain areas of one colour in a window, such as bars: what encloses each [px].
std::vector<ImRect> seen_areas(const Colour& colour, const std::string& window);

/// Clicks on words; fails if they are nowhere. Returns what that emitted.
std::vector<CommandCall> click_on(Desk& desk, const std::string& text, const std::string& window = "");
/// "sort gain ascending": what was emitted, a line of a script each, joined by "; ".
std::string text_of(const std::vector<CommandCall>& calls);

}  // namespace nextview
