#include "ui/panels/candidates_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/colour_map.hpp"

namespace nextview {
namespace {

/// The largest of each column over the candidates that are left: full bars.
struct Largest {
  double gain = 0.0, cost = 0.0, utility = 0.0;

  explicit Largest(const std::vector<Candidate>& candidates) {
    for (const Candidate& c : candidates) {
      if (!c.available) continue;
      gain = std::max(gain, c.gain);
      cost = std::max(cost, c.cost);
      utility = std::max(utility, std::abs(c.utility));
    }
  }
};

/// A number at the right of its cell over a bar; negative values have a paler bar.
void number_cell(const PanelContext& context, const std::string& text, double value, double largest,
                 const Colour& colour) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
  const double share = largest > 0 ? std::clamp(std::abs(value) / largest, 0.0, 1.0) : 0.0;
  const Colour fill = mix(colour, theme::paper, value < 0 ? 0.86 : 0.7);
  if (share > 0)
    ImGui::GetWindowDrawList()->AddRectFilled({corner.x, corner.y},
                                              {corner.x + float(share) * width, corner.y + height}, to_imgui_u32(fill),
                                              context.style.px(2));
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + width - ImGui::CalcTextSize(text.c_str()).x);
  ImGui::TextUnformatted(text.c_str());
}

int step_of(const SessionSnapshot& snapshot, std::size_t candidate) {
  for (const StepRecord& record : snapshot.records) {
    if (record.view == static_cast<int>(candidate)) return record.step;
  }
  return 0;
}

bool is_proposed(const SessionSnapshot& s, std::size_t candidate) {
  return s.finished.empty() && s.proposal() == candidate;
}

void draw_numbers(const PanelContext& context, std::size_t candidate, const Largest& largest) {
  const SessionSnapshot& s = context.snapshot;
  const Candidate& c = s.records.back().candidates[candidate];
  ImGui::TableNextColumn();
  if (!c.available) {
    const int step = step_of(s, candidate);
    ImGui::TextUnformatted(step > 0 ? fmt::format("visited, view {}", step).c_str() : "not reachable");
    return;
  }
  const Colour colour = is_proposed(s, candidate) ? theme::chosen : theme::series[0];
  number_cell(context, readable(c.gain), c.gain, largest.gain, colour);
  ImGui::TableNextColumn();
  number_cell(context, fmt::format("{:.2f}", c.cost), c.cost, largest.cost, theme::visited);
  ImGui::TableNextColumn();
  number_cell(context, fmt::format("{:.4f}", c.utility), c.utility, largest.utility, colour);
}

void draw_row(const PanelContext& context, std::size_t candidate, const Largest& largest, CandidateFocus& focus) {
  const SessionSnapshot& s = context.snapshot;
  const bool available = s.available(candidate), next = s.next_candidate == candidate && s.finished.empty();
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(!available                          ? theme::soft_ink
                                                : is_proposed(s, candidate) || next ? theme::chosen
                                                                                    : theme::ink));
  const std::string name = fmt::format("{}##{}", candidate, candidate);
  if (ImGui::Selectable(name.c_str(), focus.selected == candidate, ImGuiSelectableFlags_SpanAllColumns)) {
    focus.selected = focus.selected == candidate ? std::nullopt : std::optional(candidate);
  }
  if (ImGui::IsItemHovered()) focus.hovered = candidate;
  if (next) {
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    const float size = context.style.px(8);
    ImGui::GetWindowDrawList()->AddTriangleFilled({from.x + context.style.px(27), (from.y + to.y - size) / 2},
                                                  {from.x + context.style.px(27), (from.y + to.y + size) / 2},
                                                  {from.x + context.style.px(27) + size, (from.y + to.y) / 2},
                                                  to_imgui_u32(theme::chosen));
  }
  ImGui::PopStyleColor();
  ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(available ? theme::ink : theme::soft_ink));
  draw_numbers(context, candidate, largest);
  ImGui::PopStyleColor();
}

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
  if (!s.next_candidate) return "No candidate is left.";
  if (s.next_candidate == s.proposal()) return fmt::format("Next is the proposal, view {}.", *s.next_candidate);
  return fmt::format("Next is your choice, view {}; proposed was view {}.", *s.next_candidate, *s.proposal());
}

void draw_take_button(PanelContext& context, CandidateFocus& focus) {
  const SessionSnapshot& s = context.snapshot;
  const bool can = focus.selected && s.available(*focus.selected) && focus.selected != s.next_candidate &&
                   s.finished.empty() && !context.progress.busy;
  const std::string text =
      focus.selected ? fmt::format("Take view {} next", *focus.selected) : std::string("Take the selected view next");
  ImGui::BeginDisabled(!can);
  if (ImGui::Button(fmt::format("{}###take", text).c_str(),
                    {-FLT_MIN, ImGui::GetFrameHeight() + context.style.px(4)})) {
    context.commands.emplace_back(command::TakeView{*focus.selected});
  }
  ImGui::EndDisabled();
  tooltip("Select a candidate in the table or in the scene, then make it the next view instead of the proposal.");
}

}  // namespace

void CandidatesPanel::draw_table(PanelContext& context, CandidateFocus& focus, float height) {
  const SessionSnapshot& s = context.snapshot;
  const auto flags =
      ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_PadOuterX;
  if (!ImGui::BeginTable("candidates", 4, flags, {0, height})) return;
  const std::string gain = s.gain_unit.empty() ? "gain" : fmt::format("gain [{}]", s.gain_unit);
  const auto id = [](CandidateColumn column) { return static_cast<ImGuiID>(column); };
  const auto highest_first = ImGuiTableColumnFlags_WidthStretch | ImGuiTableColumnFlags_PreferSortDescending;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("view", ImGuiTableColumnFlags_WidthFixed, context.style.px(46), id(CandidateColumn::view));
  ImGui::TableSetupColumn(gain.c_str(), highest_first, 1.2f, id(CandidateColumn::gain));
  ImGui::TableSetupColumn("cost [m]", ImGuiTableColumnFlags_WidthStretch, 1.0f, id(CandidateColumn::cost));
  ImGui::TableSetupColumn("utility", highest_first | ImGuiTableColumnFlags_DefaultSort, 1.05f,
                          id(CandidateColumn::utility));
  ImGui::TableHeadersRow();
  if (ImGuiTableSortSpecs* sort = ImGui::TableGetSortSpecs(); sort && sort->SpecsCount > 0) {
    column_ = static_cast<CandidateColumn>(sort->Specs[0].ColumnUserID);
    ascending_ = sort->Specs[0].SortDirection == ImGuiSortDirection_Ascending;
  }
  if (!s.records.empty()) {
    const std::vector<Candidate>& candidates = s.records.back().candidates;
    const Largest largest(candidates);
    for (const std::size_t i : sorted_candidates(candidates, column_, ascending_)) draw_row(context, i, largest, focus);
  }
  ImGui::EndTable();
}

void CandidatesPanel::draw(PanelContext& context, const Rectangle& rectangle, CandidateFocus& focus) {
  const Panel panel("Candidates", rectangle, ImGuiWindowFlags_NoScrollbar);
  const SessionSnapshot& s = context.snapshot;
  heading(context.style, "Candidates");
  if (!s.loaded()) return;
  ImGui::SameLine();
  ImGui::TextDisabled("%s", s.configuration.planner.gain.c_str());
  ImGui::Spacing();
  if (!s.records.empty() && s.finished.empty() && !s.records.back().ranking.degenerate.empty()) {
    draw_degenerate(context, s.records.back().ranking.degenerate);
  }
  const float below = ImGui::GetFrameHeight() + 2 * ImGui::GetTextLineHeight() + context.style.px(4) +
                      3 * ImGui::GetStyle().ItemSpacing.y;
  ImGui::PushFont(context.style.small);
  draw_table(context, focus, ImGui::GetContentRegionAvail().y - below);
  ImGui::PopFont();
  small_text(context.style, next_text(s));
  ImGui::SetCursorPosY(float(rectangle.height) - ImGui::GetStyle().WindowPadding.y - ImGui::GetFrameHeight() -
                       context.style.px(4));
  draw_take_button(context, focus);
}

}  // namespace nextview
