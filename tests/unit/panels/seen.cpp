#include "tests/unit/panels/seen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace nextview {
namespace {

struct Letter {
  const ImFont* font;
  const ImFontGlyph* glyph;
};

/// Each letter has a place of its own in the fonts' texture.
std::map<std::pair<float, float>, Letter> letters() {
  std::map<std::pair<float, float>, Letter> all;
  for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
    for (const ImFontGlyph& glyph : font->Glyphs)
      if (glyph.Visible) all[{glyph.U0, glyph.V0}] = {font, &glyph};
  return all;
}

std::string utf8(unsigned int c) {
  if (c < 0x80) return {char(c)};
  if (c < 0x800) return {char(0xC0 | (c >> 6)), char(0x80 | (c & 0x3F))};
  return {char(0xE0 | (c >> 12)), char(0x80 | ((c >> 6) & 0x3F)), char(0x80 | (c & 0x3F))};
}

/// "Candidates" of "Candidates/candidates_1234": a table that scrolls is a window within.
std::string window_of(const ImDrawList& list) {
  const std::string owner = list._OwnerName ? list._OwnerName : "";
  return owner.substr(0, owner.find('/'));
}

/// Letters, one after the other, put together to runs.
class Reader {
 public:
  explicit Reader(std::string window) : window_(std::move(window)) {}

  void take(const Letter& letter, ImVec2 corner, ImU32 colour) {
    const ImVec2 start(corner.x - letter.glyph->X0, corner.y - letter.glyph->Y0);
    const float space = letter.font->GetCharAdvance(' '), gap = start.x - end_;
    const bool goes_on = !runs_.empty() && font_ == letter.font && runs_.back().colour == colour &&
                         std::abs(start.y - runs_.back().from.y) < 0.5f && gap > -1 && gap < 3.5f * space;
    if (!goes_on)
      runs_.push_back({"", start, {}, colour, window_});
    else
      runs_.back().text.append(std::size_t(std::lround(std::max(gap, 0.0f) / space)), ' ');
    font_ = letter.font;
    end_ = start.x + letter.glyph->AdvanceX;
    runs_.back().text += utf8(letter.glyph->Codepoint);
    runs_.back().to = {end_, start.y + letter.font->FontSize};
  }
  std::vector<SeenText> runs() const { return runs_; }

 private:
  std::string window_;
  std::vector<SeenText> runs_;
  const ImFont* font_ = nullptr;
  float end_ = 0;
};

using Triangle = std::array<ImDrawVert, 3>;

/// Calls for each triangle with the one after it, of what is drawn in a window's clip rectangles.
void each_triangle(const ImDrawList& list,
                   const std::function<bool(const Triangle&, const Triangle&, const ImRect&)>& f) {
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const auto vertex = [&](unsigned int i) {
      return list.VtxBuffer[int(command.VtxOffset + list.IdxBuffer[int(command.IdxOffset + i)])];
    };
    const auto triangle = [&](unsigned int i) { return Triangle{vertex(i), vertex(i + 1), vertex(i + 2)}; };
    for (unsigned int i = 0; i + 3 <= command.ElemCount; i += 3) {
      const bool last = i + 6 > command.ElemCount;
      if (f(triangle(i), triangle(last ? i : i + 3), ImRect(command.ClipRect))) i += 3;
    }
  }
}

}  // namespace

namespace {

/// Letters of the last frame, with where they may be seen.
void each_letter(const std::function<void(Reader&, const Letter&, const ImDrawVert&, ImVec2 middle, const ImRect&)>& f,
                 const std::function<void(const Reader&)>& end_of_window) {
  const auto all = letters();
  const ImDrawData* data = ImGui::GetDrawData();
  for (int i = 0; i < data->CmdListsCount; ++i) {
    Reader reader(window_of(*data->CmdLists[i]));
    each_triangle(*data->CmdLists[i], [&](const Triangle& a, const Triangle& b, const ImRect& clip) {
      const auto found = all.find({a[0].uv.x, a[0].uv.y});
      if (found == all.end()) return false;
      const ImFontGlyph& glyph = *found->second.glyph;
      const bool whole = a[2].uv.x == glyph.U1 && a[2].uv.y == glyph.V1 && b[1].uv.x == glyph.U1;
      const ImVec2 middle((a[0].pos.x + a[2].pos.x) / 2, (a[0].pos.y + a[2].pos.y) / 2);
      if (whole) f(reader, found->second, a[0], middle, clip);
      return whole;
    });
    end_of_window(reader);
  }
}

}  // namespace

std::vector<SeenText> seen_texts() {
  std::vector<SeenText> result;
  each_letter(
      [](Reader& reader, const Letter& letter, const ImDrawVert& corner, ImVec2 middle, const ImRect& clip) {
        if (clip.Contains(middle)) reader.take(letter, corner.pos, corner.col);
      },
      [&](const Reader& reader) {
        for (SeenText& run : reader.runs()) result.push_back(std::move(run));
      });
  return result;
}

std::vector<SeenText> cut_texts() {
  std::vector<SeenText> result;
  std::vector<ImVec2> outside;  // letters that are beside what is seen, of one window
  each_letter(
      [&](Reader& reader, const Letter& letter, const ImDrawVert& corner, ImVec2 middle, const ImRect& clip) {
        if (middle.y < clip.Min.y || middle.y > clip.Max.y) return;
        reader.take(letter, corner.pos, corner.col);
        if (middle.x < clip.Min.x || middle.x > clip.Max.x) outside.push_back(middle);
      },
      [&](const Reader& reader) {
        for (const SeenText& run : reader.runs()) {
          const auto within = [&](const ImVec2& p) {
            return p.x >= run.from.x && p.x <= run.to.x && p.y >= run.from.y && p.y <= run.to.y;
          };
          if (std::any_of(outside.begin(), outside.end(), within)) result.push_back(run);
        }
        outside.clear();
      });
  return result;
}

std::vector<std::string> read_lines(const std::string& window) {
  std::vector<SeenText> all = seen_texts();
  if (!window.empty()) std::erase_if(all, [&](const SeenText& t) { return t.window != window; });
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.middle() < b.middle(); });
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    while (end < all.size() && all[end].middle() < all[i].middle() + 5) ++end;
    std::stable_sort(all.begin() + long(i), all.begin() + long(end),
                     [](const auto& a, const auto& b) { return a.from.x < b.from.x; });
    std::string line;
    for (; i < end; ++i) line += (line.empty() ? "" : " ") + all[i].text;
    lines.push_back(line);
  }
  return lines;
}

std::string read(const std::string& window) {
  std::string text;
  for (const std::string& line : read_lines(window)) text += (text.empty() ? "" : " ") + line;
  return text;
}

std::string read_tooltip() {
  for (const SeenText& t : seen_texts())
    if (t.window.starts_with("##Tooltip")) return read(t.window);
  return "";
}

const SeenText* find_text(const std::vector<SeenText>& all, const std::string& text, const std::string& window) {
  const SeenText* begins = nullptr;
  for (const SeenText& t : all) {
    if (!window.empty() && t.window != window) continue;
    if (t.text == text) return &t;
    if (!begins && t.text.starts_with(text)) begins = &t;
  }
  return begins;
}

std::vector<ImRect> seen_areas(const Colour& colour, const std::string& window) {
  const ImU32 wanted = to_imgui_u32(colour);
  const ImVec2 plain = ImGui::GetIO().Fonts->TexUvWhitePixel;
  std::vector<ImRect> areas;
  const ImDrawData* data = ImGui::GetDrawData();
  for (int i = 0; i < data->CmdListsCount; ++i) {
    if (window_of(*data->CmdLists[i]) != window) continue;
    ImVec2 first(-1, -1);  // a filled shape is a fan of triangles
    each_triangle(*data->CmdLists[i], [&](const Triangle& t, const Triangle&, const ImRect& clip) {
      for (const ImDrawVert& v : t)
        if (v.col != wanted || v.uv.x != plain.x || v.uv.y != plain.y) return false;
      if (!clip.Contains(t[0].pos)) return false;
      if (areas.empty() || t[0].pos.x != first.x || t[0].pos.y != first.y) areas.push_back({t[0].pos, t[0].pos});
      first = t[0].pos;
      for (const ImDrawVert& v : t) areas.back().Add(v.pos);
      return false;
    });
  }
  return areas;
}

std::vector<CommandCall> click_on(Desk& desk, const std::string& text, const std::string& window) {
  const auto all = seen_texts();
  const SeenText* found = find_text(all, text, window);
  if (!found) {
    ADD_FAILURE() << "'" << text << "' is nowhere in: " << read(window);
    return {};
  }
  desk.click((found->from.x + found->to.x) / 2, found->middle());
  return desk.frames();
}

std::string text_of(const std::vector<CommandCall>& calls) {
  std::string text;
  for (const CommandCall& call : calls) text += (text.empty() ? "" : "; ") + call.text();
  return text;
}

}  // namespace nextview
