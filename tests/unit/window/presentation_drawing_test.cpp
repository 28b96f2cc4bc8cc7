// What lies over the scene and over the window: labels, a demo's captions and titles, by where their letters are.
#include "ui/window/presentation_drawing.hpp"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include "ui/panels/all_panels.hpp"
#include "ui/panels/panel_table.hpp"
#include "ui/window/imgui_host.hpp"
#include "ui/window/overlay_drawing.hpp"

namespace nextview {
namespace {

constexpr int width = 1000, height = 640;  // of the window [px]

/// A frame, and what was drawn in it.
class Drawn {
 public:
  explicit Drawn(double scale, const std::function<void(const Style&)>& draw) : host_(scale) {
    unsigned char* pixels = nullptr;
    int columns = 0, rows = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &columns, &rows);
    host_.begin_frame(width, height, 1.0 / 60);
    draw(host_.style());
    ImGui::Render();
  }
  const Style& style() const { return host_.style(); }
  /// What encloses the letters, or the plain areas, of a colour, however clear.
  ImRect letters(const Colour& colour) const { return box(colour, false); }
  ImRect areas(const Colour& colour) const { return box(colour, true); }

  /// What encloses all that is of a colour: thick lines, too.
  ImRect all(const Colour& colour) const {
    ImRect box = areas(colour);
    each(colour, false, [&](const ImDrawVert* corners) {
      for (int k = 0; k < 4; ++k) box.Add(corners[k].pos);
    });
    return box;
  }

  /// The lines that letters of a colour stand in, from above: what encloses each.
  std::vector<ImRect> lines(const Colour& colour) const {
    std::vector<ImRect> glyphs;
    each(colour, false, [&](const ImDrawVert* corners) { glyphs.push_back({corners[0].pos, corners[2].pos}); });
    std::vector<ImRect> lines;
    for (const ImRect& glyph : glyphs) {
      const auto in_it = [&](const ImRect& line) { return glyph.Min.y < line.Max.y && line.Min.y < glyph.Max.y; };
      const auto line = std::ranges::find_if(lines, in_it);
      line == lines.end() ? lines.push_back(glyph) : line->Add(glyph);
    }
    return lines;
  }

 private:
  /// Of each rectangle of this colour its four corners, from the upper left around.
  static void each(const Colour& colour, bool plain, const std::function<void(const ImDrawVert*)>& f) {
    const ImVec2 white = ImGui::GetIO().Fonts->TexUvWhitePixel;
    const ImU32 wanted = to_imgui_u32(colour) & ~IM_COL32_A_MASK;
    const ImDrawData* data = ImGui::GetDrawData();
    for (int i = 0; i < data->CmdListsCount; ++i) {
      const auto& all = data->CmdLists[i]->VtxBuffer;
      for (int k = 0; k + 4 <= all.Size;) {
        const bool is_plain = all[k].uv.x == white.x && all[k].uv.y == white.y;
        const bool is_wanted = (all[k].col & ~IM_COL32_A_MASK) == wanted && is_plain == plain;
        if (is_wanted) f(&all[k]);
        k += is_wanted && !plain ? 4 : 1;
      }
    }
  }
  ImRect box(const Colour& colour, bool plain) const {
    ImRect box(FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX);
    each(colour, plain, [&](const ImDrawVert* corners) {
      box.Add(corners[0].pos);
      if (!plain) box.Add(corners[2].pos);
    });
    return box;
  }

  ImguiHost host_;
};

float middle(const ImRect& box) { return box.GetCenter().x; }

/// Long since faded in.
ShownText shown(const std::string& text, const std::string& subtitle = "") { return {text, subtitle, 60}; }

Layout with_captions() { return Layout::with_captions(width, height, 1.0, Side::right); }

Drawn drawn(const Presentation& presentation) {
  return Drawn(1.0, [&](const Style& style) { draw_presentation(style, presentation, with_captions()); });
}

TEST(Labels, AreRightAboveTheirPlaceInTheMiddleOfTheirPaper) {
  constexpr float scale = 4;  // so that a pixel of the design is seen beside what letters leave free
  const ImVec2 place(200, 300);
  const Drawn label(scale, [&](const Style& style) { draw_label(style, place, "000", theme::chosen); });
  const ImRect paper = label.areas(theme::paper), letters = label.letters(theme::chosen);
  EXPECT_GT(letters.GetWidth(), 20 * scale / 2);
  EXPECT_TRUE(paper.Contains(letters));
  EXPECT_NEAR(letters.Min.x - paper.Min.x, paper.Max.x - letters.Max.x, 0.6f * scale);
  EXPECT_TRUE(letters.Min.x - paper.Min.x > 4 * scale && letters.Min.x - paper.Min.x < 8 * scale);
  EXPECT_GT(paper.Min.x, place.x);
  EXPECT_LT(paper.Max.y, place.y);
  EXPECT_TRUE(paper.Min.x < place.x + 15 * scale && paper.Max.y > place.y - 15 * scale) << "beside it";
}

TEST(Captions, StandInTheMiddleOfTheirStripWhateverTheirLength) {
  Presentation presentation;
  EXPECT_LT(drawn(presentation).letters(theme::paper).GetWidth(), 0) << "there is none";
  const Rectangle strip = with_captions().captions;
  float last = 0;
  for (const char* text : {"Two", "Two views of a sphere",
                           "A caption of so many words that they would need far more than "
                           "all of the width of the window if they were not smaller"}) {
    presentation.caption = shown(text);
    const Drawn frame = drawn(presentation);
    const ImRect dark = frame.areas(theme::ink), words = frame.letters(theme::paper);
    EXPECT_NEAR(dark.GetWidth(), strip.width, 1);
    EXPECT_NEAR(dark.GetHeight(), strip.height, 1);
    EXPECT_NEAR(middle(words), strip.x + strip.width / 2, 3) << text;
    EXPECT_TRUE(words.Min.y > strip.y && words.Max.y < strip.y + strip.height) << text;
    EXPECT_TRUE(words.Min.x >= 0 && words.Max.x <= width) << text;
    EXPECT_GT(words.GetWidth(), last) << text;
    last = words.GetWidth();
  }
  EXPECT_GT(last, 0.85 * width) << "no smaller than it must be";
  presentation.paused = true;
  const ImRect paused = drawn(presentation).letters(theme::paper);
  EXPECT_LT(paused.GetWidth(), last) << "what can be done now is said instead";
  EXPECT_NEAR(middle(paused), strip.x + strip.width / 2, 3);
}

TEST(Titles, AreInTheMiddleOfTheWindowWithTheirSubtitlesBeneath) {
  Presentation presentation;
  presentation.title = shown("A sphere", "and what is seen of it");
  const Drawn frame = drawn(presentation);
  const auto title = frame.lines(theme::ink), beneath = frame.lines(theme::series[0]);
  ASSERT_EQ(title.size(), 1u);
  ASSERT_EQ(beneath.size(), 1u);
  EXPECT_NEAR(middle(title[0]), width / 2.0, 4);
  EXPECT_NEAR(middle(beneath[0]), width / 2.0, 4);
  EXPECT_GT(beneath[0].Min.y, title[0].Max.y);
  EXPECT_LT(beneath[0].GetHeight(), title[0].GetHeight());
  EXPECT_TRUE(title[0].Min.y > 0.3 * height && beneath[0].Max.y < 0.7 * height);
}

TEST(Titles, OfManyWordsAreBrokenBetweenThem) {
  Presentation presentation;
  presentation.title = shown("The next best view of an object that nobody has seen before, chosen by what it would add",
                             "with a subtitle that is so long that it needs more than one line as well, which stands "
                             "beneath the other, and is broken between words, too");
  const Drawn frame = drawn(presentation);
  for (const Colour& colour : {theme::ink, theme::series[0]}) {
    const auto lines = frame.lines(colour);
    EXPECT_GT(lines.size(), 1u);
    for (const ImRect& line : lines) {
      EXPECT_NEAR(middle(line), width / 2.0, 6);
      EXPECT_TRUE(line.Min.x > 0.05 * width && line.Max.x < 0.95 * width);
    }
  }
  EXPECT_GT(frame.lines(theme::series[0]).front().Min.y, frame.lines(theme::ink).back().Max.y - 4);
}

TEST(Highlights, GoAroundTheirPanelsPlace) {
  announce_panels(standard_panels());
  Presentation presentation;
  for (const auto& [panel, side] :
       {std::pair{"view", Side::right}, {"session", Side::left}, {"curves", Side::bottom}}) {
    presentation.highlight = shown(panel);
    const ImRect frame = drawn(presentation).all(theme::chosen);
    const Rectangle place = with_captions().of(side);
    EXPECT_TRUE(frame.Min.x >= place.x - 2 && frame.Max.x <= place.x + place.width + 2) << panel;
    EXPECT_TRUE(frame.Min.y >= place.y - 2 && frame.Max.y <= place.y + place.height + 2) << panel;
    EXPECT_GT(frame.GetWidth(), place.width - 16) << panel;
    EXPECT_GT(frame.GetHeight(), place.height - 16) << panel;
  }
}

}  // namespace
}  // namespace nextview
