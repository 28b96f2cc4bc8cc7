#include "ui/panels/candidates_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/planner/way_text.hpp"
#include "core/setting/area_text.hpp"
#include "ui/appearance/colour_map.hpp"
#include "ui/commands/selection_commands.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

/// The largest of each column over the candidates that are left: full bars.
struct Largest {
  double gain = 0.0, cost = 0.0, utility = 0.0;
  bool gains_are_whole = true;  ///< counts
  std::string gain_unit;
  double gain_scale = 1.0;  ///< what is shown of each gain
  WayUnit way;              ///< of costs, as of the sentence above the table

  explicit Largest(const SessionSnapshot& s) : gain_unit(s.gain_unit), way(way_unit(s.state.known.map.grid())) {
    if (s.records.empty()) return;
    const StepRecord& last = s.records.back();
    if (gain_unit == "cm²" && last.ranking.best) {  // in the unit of the sentence above the table
      const AreaUnit unit = area_unit(last.candidates[*last.ranking.best].gain);
      gain_unit = unit.name;
      gain_scale = unit.per_square_centimetre;
    }
    for (const Candidate& c : last.candidates) {
      if (!c.available) continue;
      gain = std::max(gain, gain_scale * c.gain);
      gains_are_whole = gains_are_whole && gain_scale * c.gain == std::round(gain_scale * c.gain);
      cost = std::max(cost, c.cost);
      utility = std::max(utility, std::abs(c.utility));
    }
  }
  /// Four digits of the largest, and as many decimals for all, so that they stand one below the other.
  int gain_decimals() const {
    if (gains_are_whole || !(gain > 0)) return 0;
    return std::clamp(3 - static_cast<int>(std::floor(std::log10(gain))), 0, 6);
  }
  int cost_decimals() const { return way.per_metre == 1.0 ? 2 : cost < 0.1 ? 1 : 0; }
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
  const auto taken = snapshot.state.known.taken_as(snapshot.state.candidates[candidate]);
  return taken ? snapshot.records[*taken].step : 0;
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
    ImGui::TextUnformatted(step == 0 ? "not reachable" : fmt::format("view {}", step).c_str());
    if (step == 0) tooltip(c.unreachable);
    return;
  }
  const Colour colour = is_proposed(s, candidate) ? theme::chosen : theme::series[0];
  const double gain = largest.gain_scale * c.gain;
  number_cell(context, fmt::format("{:.{}f}", gain, largest.gain_decimals()), gain, largest.gain, colour);
  ImGui::TableNextColumn();
  const std::string cost = fmt::format("{:.{}f}", largest.way.per_metre * c.cost, largest.cost_decimals());
  number_cell(context, cost, c.cost, largest.cost, theme::muted);
  ImGui::TableNextColumn();
  number_cell(context, fmt::format("{:.4f}", c.utility), c.utility, largest.utility, colour);
}

void draw_row(const PanelContext& context, std::size_t candidate, const Largest& largest) {
  const SessionSnapshot& s = context.snapshot;
  const bool available = s.available(candidate), next = s.next_candidate == candidate && s.finished.empty();
  const bool selected = context.window.selection.candidate() == candidate;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(!available                          ? theme::soft_ink
                                                : is_proposed(s, candidate) || next ? theme::chosen
                                                                                    : theme::ink));
  const std::string name = fmt::format("{}##{}", candidate, candidate);
  if (ImGui::Selectable(name.c_str(), selected, ImGuiSelectableFlags_SpanAllColumns)) {
    context.post(selected ? command::select_next() : command::select_view(candidate));
  }
  if (ImGui::IsItemHovered()) {
    context.hovered = candidate;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) context.post(command::panel(panel_name::view));
  }
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

/// A column's name; a click sorts by it, another one the other way round.
void draw_header(const PanelContext& context, CandidateColumn column, const std::string& name) {
  constexpr std::array columns = {"view", "gain", "cost", "utility"};
  const WindowState& window = context.window;
  const bool sorted = window.sort_column == column;
  const bool low_first = column == CandidateColumn::view || column == CandidateColumn::cost;
  ImGui::TableNextColumn();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const char* id = columns[static_cast<std::size_t>(column)];
  if (ImGui::InvisibleButton(id, {width, ImGui::GetTextLineHeight()})) {
    const bool ascending = sorted ? !window.sort_ascending : low_first;
    context.post(command::sort(column, ascending ? SortOrder::ascending : SortOrder::descending));
  }
  tooltip("Click to sort by this column.");
  const Colour colour = sorted || ImGui::IsItemHovered() ? theme::ink : theme::soft_ink;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText(corner, to_imgui_u32(colour), name.c_str());
  if (!sorted) return;
  const float r = context.style.px(3.5f), x = corner.x + width - r, y = corner.y + ImGui::GetTextLineHeight() / 2;
  const float up = window.sort_ascending ? -r : r;
  list.AddTriangleFilled({x - r, y - up / 2}, {x + r, y - up / 2}, {x, y + up}, to_imgui_u32(theme::ink));
}

}  // namespace

void draw_candidates_table(const PanelContext& context, float height) {
  const SessionSnapshot& s = context.snapshot;
  const auto flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_PadOuterX;
  if (!ImGui::BeginTable("candidates", 4, flags, {0, height})) return;
  const std::vector<Candidate> none;
  const std::vector<Candidate>& candidates = s.records.empty() ? none : s.records.back().candidates;
  const Largest largest(s);
  const std::string gain = largest.gain_unit.empty() ? "gain" : fmt::format("gain [{}]", largest.gain_unit);
  const float long_unit = ImGui::CalcTextSize(gain.c_str()).x / context.style.px(50);  // "nats/voxel" has to fit
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("view", ImGuiTableColumnFlags_WidthFixed, context.style.px(64));
  for (const auto& [name, weight] : {std::pair{"gain", std::max(1.2f, long_unit)}, {"cost", 1.0f}, {"utility", 1.05f}})
    ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthStretch, weight);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  draw_header(context, CandidateColumn::view, "candidate");
  draw_header(context, CandidateColumn::gain, gain);
  draw_header(context, CandidateColumn::cost, fmt::format("cost [{}]", largest.way.name));
  draw_header(context, CandidateColumn::utility, "utility");
  for (const std::size_t i : sorted_candidates(candidates, context.window.sort_column, context.window.sort_ascending))
    draw_row(context, i, largest);
  ImGui::EndTable();
}

}  // namespace nextview
