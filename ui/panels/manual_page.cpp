#include "ui/panels/manual_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/file/png_text.hpp"
#include "ui/manual/manual.hpp"

namespace nextview {
namespace {

using Kind = MarkdownBlock::Kind;

/// A page of the manual; what lies elsewhere is told, and its address copied.
bool is_page(const std::string& target) {
  return target.find("://") == target.npos && target.substr(0, target.find('#')).ends_with(".md");
}

/// A word, or the part of one that is a link; whether it was clicked.
bool draw_word(const std::string& word, const ImVec2& at, const MarkdownLink* link) {
  const ImVec2 size = ImGui::CalcTextSize(word.c_str());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 colour = link ? to_imgui_u32(theme::series[0]) : ImGui::GetColorU32(ImGuiCol_Text);
  list.AddText(at, colour, word.c_str());
  if (!link) return false;
  list.AddLine({at.x, at.y + size.y - 1}, {at.x + size.x, at.y + size.y - 1}, colour);
  ImGui::SetCursorScreenPos(at);
  const bool clicked = ImGui::InvisibleButton(fmt::format("{} {}", word, link->begin).c_str(), size);
  if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  tooltip(is_page(link->target) ? "" : link->target + " (a click copies this)");
  if (clicked && !is_page(link->target)) ImGui::SetClipboardText(link->target.c_str());
  return clicked && is_page(link->target);
}

/// Wrapped at its spaces, as TextWrapped does, which knows of no links. Returns the target of the one that was clicked.
std::string draw_linked_text(const std::string& text, const std::vector<MarkdownLink>& links) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float right = corner.x + ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
  ImVec2 at = corner;
  std::string clicked;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t word_end = std::min(text.find(' ', i), text.size());
    if (at.x > corner.x && at.x + ImGui::CalcTextSize(&text[i], &text[word_end]).x > right)
      at = {corner.x, at.y + line};
    while (i < word_end) {  // its parts
      const auto link = std::ranges::find_if(links, [&](const MarkdownLink& l) { return i < l.end; });
      const bool is_link = link != links.end() && link->begin <= i;
      const std::size_t limit = link == links.end() ? text.size() : is_link ? link->end : link->begin;
      const std::string part = text.substr(i, std::min(word_end, limit) - i);
      if (draw_word(part, at, is_link ? &*link : nullptr)) clicked = link->target;
      at.x += ImGui::CalcTextSize(part.c_str()).x;
      i += part.size();
    }
    at.x += ImGui::CalcTextSize(" ").x;
    ++i;
  }
  ImGui::SetCursorScreenPos(corner);
  ImGui::Dummy({right - corner.x, at.y + line - corner.y});
  return clicked;
}

std::string draw_text(const std::string& text, const std::vector<MarkdownLink>& links) {
  if (!links.empty()) return draw_linked_text(text, links);
  ImGui::TextWrapped("%s", text.c_str());
  return "";
}

void draw_heading(const Style& style, const MarkdownBlock& block) {
  ImGui::Dummy({0, style.px(block.level == 1 ? 2 : 8)});
  ImGui::PushFont(style.semi_bold);
  ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(block.level <= 2 ? theme::series[0] : theme::ink));
  ImGui::TextWrapped("%s", block.text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

std::string draw_item(const Style& style, const MarkdownBlock& block) {
  ImGui::TextUnformatted(block.number.empty() ? "-" : block.number.c_str());
  ImGui::SameLine(style.px(30));
  return draw_text(block.text, block.links);
}

/// On a ground of its own; what is too wide is scrolled.
void draw_code(const Style& style, const MarkdownBlock& block, int id) {
  const auto lines = std::ranges::count(block.text, '\n');
  const float height = float(lines) * ImGui::GetTextLineHeightWithSpacing() + style.px(26);
  ImGui::PushID(id);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, to_imgui(theme::sky));
  ImGui::PushFont(style.small);
  ImGui::BeginChild("code", {0, height}, true, ImGuiWindowFlags_HorizontalScrollbar | ImGuiWindowFlags_NoNav);
  ImGui::TextUnformatted(block.text.c_str());
  ImGui::EndChild();
  ImGui::PopFont();
  ImGui::PopStyleColor();
  ImGui::PopID();
}

/// The longer the texts of a column, the wider it is.
float weight(const MarkdownBlock& block, std::size_t column) {
  std::size_t sum = 0;
  for (const auto& row : block.rows) sum += std::min<std::size_t>(row[column].size(), 80);
  return 6.0f + float(sum) / float(block.rows.size());
}

/// Those of a cell.
std::vector<MarkdownLink> links_of(const MarkdownBlock& block, std::size_t row, std::size_t column) {
  std::vector<MarkdownLink> links;
  std::ranges::copy_if(block.links, std::back_inserter(links),
                       [&](const MarkdownLink& link) { return link.row == row && link.column == column; });
  return links;
}

std::string draw_table(const Style& style, const MarkdownBlock& block) {
  const int columns = int(block.rows.front().size());
  constexpr int most = 64;  // that ImGui takes
  std::string clicked;
  ImGui::PushFont(style.small);
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_SizingStretchProp;
  if (columns <= most && ImGui::BeginTable("table", columns, flags)) {
    for (int c = 0; c < columns; ++c)
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, weight(block, std::size_t(c)));
    for (std::size_t row = 0; row < block.rows.size(); ++row) {
      ImGui::TableNextRow();
      for (std::size_t column = 0; column < block.rows[row].size(); ++column) {
        ImGui::TableNextColumn();
        ImGui::PushID(int(row * most + column));
        const std::string target = draw_text(block.rows[row][column], links_of(block, row, column));
        if (!target.empty()) clicked = target;
        ImGui::PopID();
      }
    }
    ImGui::EndTable();
  }
  ImGui::PopFont();
  return clicked;
}

}  // namespace

/// As wide as the page, or as it is. It is read once it is seen. False if the program was installed without it.
bool ManualPageDrawing::draw_picture(const PanelContext& context, const std::string& picture) {
  const std::filesystem::path file = manual_folder() / picture;
  if (!sizes_.contains(picture)) try {
      const PngInfo info = read_png_info(file);
      sizes_[picture] = {float(info.width), float(info.height)};
    } catch (const std::runtime_error&) {
      sizes_[picture] = {0, 0};
    }
  ImVec2& size = sizes_[picture];
  if (size.x <= 0) return false;
  const float width = std::min(ImGui::GetContentRegionAvail().x, size.x);
  const ImVec2 corner = ImGui::GetCursorScreenPos(), drawn(width, size.y * width / size.x);
  ImGui::Dummy(drawn);
  if (!ImGui::IsItemVisible()) return true;
  try {
    const ImTextureID texture = context.pictures.get("manual " + picture, 1, [&] { return read_png(file); });
    ImGui::GetWindowDrawList()->AddImage(texture, corner, {corner.x + drawn.x, corner.y + drawn.y});
  } catch (const std::runtime_error&) {
    size = {0, 0};
  }
  return true;
}

std::string ManualPageDrawing::draw_content(const Style& style, const MarkdownBlock& block, int id) {
  switch (block.kind) {
    case Kind::heading:
      return draw_heading(style, block), "";
    case Kind::item:
      return draw_item(style, block);
    case Kind::code:
      return draw_code(style, block, id), "";
    case Kind::table:
      return draw_table(style, block);
    case Kind::picture:
      return small_text(style, block.text), "";
    case Kind::paragraph:
      break;
  }
  const std::string clicked = draw_text(block.text, block.links);
  ImGui::Spacing();
  return clicked;
}

std::string ManualPageDrawing::draw(const PanelContext& context, const MarkdownBlock& block, int id) {
  ImGui::PushID(id);
  if (!block.picture.empty() && draw_picture(context, block.picture)) ImGui::Spacing();
  const std::string clicked = draw_content(context.style, block, id);
  ImGui::PopID();
  return clicked;
}

}  // namespace nextview
