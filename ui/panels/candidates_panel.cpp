#include "ui/panels/candidates_panel.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ui/appearance/colour_map.hpp"
#include "ui/commands/scan_commands.hpp"
#include "ui/panels/candidates_table.hpp"

namespace nextview {
namespace {

void draw_degenerate(const PanelContext& context, const std::string& reason) {
  const Style& style = context.style;
  const float padding = style.px(10), icon = style.px(16), width = ImGui::GetContentRegionAvail().x;
  const float text_width = width - 3 * padding - icon;
  const std::string text = "The ranking says little: " + reason + ".";
  ImGui::PushFont(style.small);
  const float height = ImGui::CalcTextSize(text.c_str(), nullptr, false, text_width).y + 2 * padding;
  const ImVec2 corner = ImGui::GetCursorScreenPos(), start = ImGui::GetCursorPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + width, corner.y + height},
                     to_imgui_u32(mix(theme::unknown, theme::paper, 0.75)), style.px(4));
  draw_icon(Icon::warning, {corner.x + padding + icon / 2, corner.y + padding + icon / 2}, icon,
            to_imgui_u32(mix(theme::unknown, theme::ink, 0.25)));
  ImGui::SetCursorPos({start.x + 2 * padding + icon, start.y + padding});
  ImGui::PushTextWrapPos(start.x + width - padding);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopFont();
  ImGui::SetCursorPos({start.x, start.y + height + style.px(8)});
}

std::string next_text(const SessionSnapshot& s) {
  if (!s.finished.empty()) return "The scan is finished.";
  if (s.records.empty()) return "The first view is the start view; the candidates are ranked after it.";
  if (s.custom_next_view)
    return fmt::format("Next is a custom view; proposed was candidate {}.", s.proposal().value_or(0));
  if (!s.next_candidate) return "No candidate is left.";
  if (s.next_candidate == s.proposal()) return fmt::format("Next is the proposal, candidate {}.", *s.next_candidate);
  return fmt::format("Next is your choice, candidate {}; proposed was candidate {}.", *s.next_candidate, *s.proposal());
}

/// "0.3 " before what it weighs; nothing for 1.
std::string factor(double weight) { return weight == 1.0 ? "" : fmt::format("{:g} ", weight); }

/// What orders the candidates; of a baseline as of any other gain, though the way there has no say in it.
std::string ranked_by(const PlannerConfig& planner) {
  if (planner.utility == UtilityKind::gain_per_second) return fmt::format("ranked by {} per second", planner.gain);
  return fmt::format("ranked by {}, U = {}gain share − {}cost share (Eq. 13)", planner.gain,
                     factor(planner.weights.gain), factor(planner.weights.cost));
}

/// Takes the selected candidate, or goes back to the proposal.
void draw_take_buttons(const PanelContext& context) {
  const Style& style = context.style;
  const auto selected = context.window.selection.candidate();
  const float width = (ImGui::GetContentRegionAvail().x - style.px(6)) / 2;
  const std::string take = selected ? fmt::format("Take {} next", *selected) : "Take the selected";
  ImGui::BeginDisabled(!selected);
  command_button(context, command::take_view, Icon::none, take.c_str(), false, width);
  ImGui::EndDisabled();
  ImGui::SameLine(0, style.px(6));
  command_button(context, command::take_proposal, Icon::none, "Take the proposal", false, width);
}

}  // namespace

void draw_candidates_panel(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Candidates", rectangle, 0, context.style.px(right_panel_width));
  const SessionSnapshot& s = context.snapshot;
  if (!s.loaded()) return;
  small_text(context.style, ranked_by(s.configuration.planner));
  if (!s.records.empty() && s.finished.empty()) small_text(context.style, s.records.back().ranking.reason, theme::ink);
  if (!s.records.empty() && s.finished.empty() && !s.records.back().ranking.degenerate.empty())
    draw_degenerate(context, s.records.back().ranking.degenerate);
  const float below = ImGui::GetFrameHeight() + 2 * ImGui::GetTextLineHeight() + context.style.px(4) +
                      3 * ImGui::GetStyle().ItemSpacing.y;
  const float left = ImGui::GetContentRegionAvail().y - below, least = context.style.px(110);
  const bool low = left < least;  // the table keeps some rows, and the panel scrolls; not for its buttons
  if (low) draw_take_buttons(context);
  ImGui::PushFont(context.style.small);
  draw_candidates_table(context, std::max(left, least));
  ImGui::PopFont();
  small_text(context.style, next_text(s));
  if (low) return;
  ImGui::SetCursorPosY(float(rectangle.height) - ImGui::GetStyle().WindowPadding.y - ImGui::GetFrameHeight() -
                       context.style.px(4));
  draw_take_buttons(context);
}

}  // namespace nextview
