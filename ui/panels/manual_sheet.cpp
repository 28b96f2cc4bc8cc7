#include "ui/panels/manual_sheet.hpp"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "core/file/lower_case.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

using Kind = MarkdownBlock::Kind;

/// What a block says, a row of a table at a time.
std::vector<std::string> texts_of(const MarkdownBlock& block) {
  if (block.kind != Kind::table) return {block.text};
  std::vector<std::string> rows;
  for (const auto& row : block.rows) rows.push_back(fmt::format("{}", fmt::join(row, "  ")));
  return rows;
}

/// As links name a heading: "At any density" is at-any-density.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : lower_case(heading)) {
    if (c == ' ') anchor += '-';
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_') anchor += c;
  }
  return anchor;
}

/// From the word before a place on, in one line.
std::string excerpt(const std::string& text, std::size_t at) {
  constexpr std::size_t before = 14;  // letters
  const std::size_t space = at > before ? text.find(' ', at - before) : text.npos;
  std::string line = text.substr(space < at ? space + 1 : at > before ? at : 0);
  std::ranges::replace(line, '\n', ' ');
  return line;
}

}  // namespace

std::vector<ManualHit> find_in_manual(const std::vector<ParsedPage>& pages, const std::string& text) {
  const std::string wanted = lower_case(text);
  std::vector<ManualHit> headed, others;  // of pages with a heading that says it, and of those without
  for (std::size_t p = 0; p < pages.size() && !wanted.empty(); ++p) {
    std::vector<ManualHit> headings, rest;
    for (std::size_t b = 0; b < pages[p].blocks.size(); ++b) {
      const MarkdownBlock& block = pages[p].blocks[b];
      for (const std::string& each : texts_of(block)) {
        const std::size_t at = lower_case(each).find(wanted);
        if (at == each.npos) continue;
        (block.kind == Kind::heading ? headings : rest).push_back({p, b, excerpt(each, at)});
        break;
      }
    }
    std::vector<ManualHit>& hits = headings.empty() ? others : headed;
    std::ranges::move(headings, std::back_inserter(hits));
    std::ranges::move(rest, std::back_inserter(hits));
  }
  std::ranges::move(others, std::back_inserter(headed));
  return headed;
}

void ManualSheet::follow(const std::string& topic) {
  if (topic == topic_) return;
  topic_ = topic;
  is_new_ = true;
  try {
    if (pages_.empty())
      for (const std::string& each : manual_topics()) {
        ManualPage page = read_manual_page(each);
        std::vector<MarkdownBlock> blocks = parse_markdown(page.text);
        pages_.push_back({std::move(page), std::move(blocks)});
      }
    error_.clear();
  } catch (const std::runtime_error& error) {
    error_ = error.what();
  }
}

/// Enter goes from hit to hit.
void ManualSheet::draw_search(const PanelContext& context) {
  const bool enter = ImGui::InputTextWithHint("##search", "Search the manual", &wanted_,
                                              ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemEdited()) {
    hits_ = find_in_manual(pages_, wanted_);
    at_.reset();
  }
  if (!enter) return;
  ImGui::SetKeyboardFocusHere(-1);  // for the next one
  if (!hits_.empty()) go_to_hit(context, at_ ? (*at_ + 1) % hits_.size() : 0);
}

void ManualSheet::go_to_hit(const PanelContext& context, std::size_t hit) {
  at_ = hit;
  is_at_new_ = true;
  const std::string& topic = pages_[hits_[hit].page].page.topic;
  if (topic != topic_) context.post(command::manual(topic));
}

/// "gibbs.md#sweeps": the page, and the heading on it.
void ManualSheet::go_to_link(const PanelContext& context, const std::string& target) {
  const std::size_t hash = std::min(target.find('#'), target.size());
  const std::string topic = target.substr(0, target.find(".md"));
  anchor_ = target.substr(std::min(hash + 1, target.size()));
  if (topic != topic_) context.post(command::manual(topic));
}

void ManualSheet::draw_hits(const PanelContext& context) {
  small_text(context.style, hits_.empty() ? "The manual does not say this."
                            : at_         ? fmt::format("{} of {}; Enter: the next", *at_ + 1, hits_.size())
                                          : fmt::format("{} places; Enter: the first", hits_.size()));
  for (std::size_t k = 0; k < hits_.size(); ++k) {
    const ParsedPage& page = pages_[hits_[k].page];
    const float width = ImGui::GetContentRegionAvail().x;
    if (k == 0 || hits_[k].page != hits_[k - 1].page)
      ImGui::TextDisabled("%s", shortened(page.page.title, width).c_str());
    ImGui::PushFont(context.style.small);
    const std::string line = fmt::format("{}##{}", shortened(hits_[k].excerpt, width), k);
    if (ImGui::Selectable(line.c_str(), at_ == k)) go_to_hit(context, k);
    if (at_ == k && is_at_new_) ImGui::SetScrollHereY();
    ImGui::PopFont();
  }
}

void ManualSheet::draw_topics(const PanelContext& context) const {
  for (const auto& [page, blocks] : pages_) {
    const std::string title = shortened(page.title, ImGui::GetContentRegionAvail().x);
    if (ImGui::Selectable(fmt::format("{}##{}", title, page.topic).c_str(), page.topic == topic_))
      context.post(command::manual(page.topic));
    if (title != page.title) tooltip(page.title);
  }
}

void ManualSheet::draw_page(const PanelContext& context) {
  if (std::exchange(is_new_, false)) ImGui::SetScrollY(0);
  if (!error_.empty()) ImGui::TextWrapped("%s", error_.c_str());
  for (const auto& [page, blocks] : pages_) {
    if (page.topic != topic_) continue;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const bool is_hit = at_ && &pages_[hits_[*at_].page].page == &page && hits_[*at_].block == b;
      const ImVec2 corner = ImGui::GetCursorScreenPos();
      if (const std::string target = drawing_.draw(context, blocks[b], int(b)); !target.empty())
        go_to_link(context, target);
      if (blocks[b].kind == Kind::heading && !anchor_.empty() && anchor_of(blocks[b].text) == anchor_) {
        anchor_.clear();
        ImGui::SetScrollFromPosY(corner.y - ImGui::GetWindowPos().y, 0.0f);
      }
      if (!is_hit) continue;
      const float right = corner.x + ImGui::GetContentRegionAvail().x, bottom = ImGui::GetCursorScreenPos().y;
      ImGui::GetWindowDrawList()->AddRectFilled(corner, {right, bottom}, to_imgui_u32(theme::series[0], 0.1));
      if (std::exchange(is_at_new_, false)) ImGui::SetScrollFromPosY(corner.y - ImGui::GetWindowPos().y, 0.2f);
    }
  }
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
  ImGui::BeginGroup();
  ImGui::SetNextItemWidth(list);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  draw_search(context);
  ImGui::BeginChild("topics", {list, -ImGui::GetFrameHeightWithSpacing()});
  wanted_.empty() ? draw_topics(context) : draw_hits(context);
  ImGui::EndChild();
  if (ImGui::Button("Close")) context.post(command::manual());
  ImGui::EndGroup();
  ImGui::SameLine();
  ImGui::BeginChild("page");
  draw_page(context);
  ImGui::EndChild();
  ImGui::End();
  ImGui::PopStyleVar(3);
}

}  // namespace nextview
