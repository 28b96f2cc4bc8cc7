#include "ui/panels/manual_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

using Kind = MarkdownBlock::Kind;

void draw_heading(const Style& style, const MarkdownBlock& block) {
  ImGui::Dummy({0, style.px(block.level == 1 ? 2 : 8)});
  ImGui::PushFont(style.semi_bold);
  ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(block.level <= 2 ? theme::series[0] : theme::ink));
  ImGui::TextWrapped("%s", block.text.c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void draw_item(const Style& style, const MarkdownBlock& block) {
  ImGui::TextUnformatted(block.number.empty() ? "-" : block.number.c_str());
  ImGui::SameLine(style.px(30));
  ImGui::TextWrapped("%s", block.text.c_str());
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

void draw_table(const Style& style, const MarkdownBlock& block, int id) {
  const int columns = int(block.rows.front().size());
  constexpr int most = 64;  // that ImGui takes
  ImGui::PushID(id);
  ImGui::PushFont(style.small);
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_SizingStretchProp;
  if (columns <= most && ImGui::BeginTable("table", columns, flags)) {
    for (int c = 0; c < columns; ++c)
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, weight(block, std::size_t(c)));
    for (const auto& row : block.rows) {
      ImGui::TableNextRow();
      for (const std::string& cell : row) {
        ImGui::TableNextColumn();
        ImGui::TextWrapped("%s", cell.c_str());
      }
    }
    ImGui::EndTable();
  }
  ImGui::PopFont();
  ImGui::PopID();
}

void draw_block(const Style& style, const MarkdownBlock& block, int id) {
  switch (block.kind) {
    case Kind::heading:
      return draw_heading(style, block);
    case Kind::item:
      return draw_item(style, block);
    case Kind::code:
      return draw_code(style, block, id);
    case Kind::table:
      return draw_table(style, block, id);
    case Kind::picture:
      return small_text(style, "Picture: " + block.text);
    case Kind::paragraph:
      ImGui::TextWrapped("%s", block.text.c_str());
  }
  ImGui::Spacing();
}

}  // namespace

void ManualSheet::follow(const std::string& topic) {
  if (topic == topic_) return;
  topic_ = topic;
  is_new_ = true;
  blocks_.clear();
  try {
    if (pages_.empty())
      for (const std::string& each : manual_topics()) pages_.push_back(read_manual_page(each));
    error_.clear();
  } catch (const std::runtime_error& error) {
    error_ = error.what();
  }
  for (const ManualPage& page : pages_)
    if (page.topic == topic) blocks_ = parse_markdown(page.text);
}

void ManualSheet::draw_topics(const PanelContext& context) const {
  for (const ManualPage& page : pages_) {
    const std::string title = shortened(page.title, ImGui::GetContentRegionAvail().x);
    if (ImGui::Selectable(fmt::format("{}##{}", title, page.topic).c_str(), page.topic == topic_))
      context.post(command::manual(page.topic));
    if (title != page.title) tooltip(page.title);
  }
  ImGui::Spacing();
  if (ImGui::Button("Close")) context.post(command::manual());
}

void ManualSheet::draw_page(const PanelContext& context) {
  if (is_new_) ImGui::SetScrollY(0);
  is_new_ = false;
  if (!error_.empty()) ImGui::TextWrapped("%s", error_.c_str());
  int id = 0;
  for (const MarkdownBlock& block : blocks_) draw_block(context.style, block, ++id);
}

void ManualSheet::draw(const PanelContext& context, const Rectangle& window) {
  if (!context.window.manual) return;
  follow(*context.window.manual);
  const Style& style = context.style;
  const float margin = style.px(24), list = std::min(style.px(230), float(window.width) / 3);
  const float width = std::min(float(window.width) - 2 * margin, style.px(1040));
  ImGui::SetNextWindowPos({float(window.x + window.width / 2), float(window.y) + margin}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSize({width, float(window.height) - 2 * margin});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(style.px(16), style.px(14)));
  ImGui::Begin("Manual", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollbar);
  if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
  ImGui::BeginChild("topics", {list, 0});
  draw_topics(context);
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("page");
  draw_page(context);
  ImGui::EndChild();
  ImGui::End();
  ImGui::PopStyleVar(3);
}

}  // namespace nextview
