#include "ui/panels/view_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/file/counted.hpp"
#include "core/planner/way_text.hpp"
#include "core/setting/area_text.hpp"
#include "ui/appearance/colour_map.hpp"
#include "ui/commands/scan_commands.hpp"
#include "ui/commands/selection_commands.hpp"
#include "ui/panels/view_pictures.hpp"

namespace nextview {
namespace {

std::string title(const SessionSnapshot& s, const ViewSelection& view) {
  switch (view.kind) {
    case ViewSelection::Kind::candidate:
      return fmt::format("Candidate {}", view.index);
    case ViewSelection::Kind::taken:
      return fmt::format("View {} as taken", view.index + 1);
    case ViewSelection::Kind::custom:
      return "A custom view";
    case ViewSelection::Kind::next:
      break;
  }
  if (!s.finished.empty()) return "Next: none";
  if (s.custom_next_view) return "Next: your custom view";
  return s.next_candidate ? fmt::format("Next: candidate {}", *s.next_candidate) : "Next: the start view";
}

/// Which view: the next one, the views taken, the candidates.
void draw_view_choice(const PanelContext& context) {
  const SessionSnapshot& s = context.snapshot;
  const ViewSelection& view = context.window.selection.view;
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (!ImGui::BeginCombo("##view", title(s, view).c_str(), ImGuiComboFlags_HeightLarge)) return;
  if (s.finished.empty() && ImGui::Selectable("The next view", view.kind == ViewSelection::Kind::next))
    context.post(command::select_next());
  for (std::size_t i = s.records.size(); i-- > 0;)
    if (ImGui::Selectable(fmt::format("View {} as taken", i + 1).c_str(), view.is(ViewSelection::Kind::taken, i)))
      context.post(command::select_taken(i + 1));
  for (std::size_t i = 0; i < s.candidates.size(); ++i)
    if (s.available(i) &&
        ImGui::Selectable(fmt::format("Candidate {}", i).c_str(), view.is(ViewSelection::Kind::candidate, i)))
      context.post(command::select_view(i));
  ImGui::EndCombo();
}

/// A picture with words at its right, or its place while there is none. Returns its corners.
ImVec4 draw_picture(const PanelContext& context, const char* name, double aspect, const std::string& words,
                    const std::function<Image()>& make) {
  const Style& style = context.style;
  const ImVec2 size(style.px(196), std::round(style.px(196) * float(aspect)));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::BeginGroup();
  if (const ImTextureID texture = context.pictures.get(name, context.inspection.number, make)) {
    ImGui::Image(texture, size);
  } else {
    ImGui::Dummy(size);
  }
  ImGui::EndGroup();
  const ImVec4 place(corner.x, corner.y, corner.x + size.x, corner.y + size.y);
  ImGui::GetWindowDrawList()->AddRect(corner, {place.z, place.w}, to_imgui_u32(theme::hairline));
  ImGui::SameLine(0, style.px(10));
  ImGui::BeginGroup();
  small_text(style, words);
  ImGui::EndGroup();
  return place;
}

/// The cell of a picture that is pointed at.
std::optional<std::size_t> pointed_cell(const ImVec4& place, int columns, int rows) {
  const ImVec2 at = ImGui::GetIO().MousePos;
  if (!ImGui::IsWindowHovered() || at.x < place.x || at.y < place.y || at.x >= place.z || at.y >= place.w)
    return std::nullopt;
  const int column = std::clamp(int((at.x - place.x) / (place.z - place.x) * float(columns)), 0, columns - 1);
  const int row = std::clamp(int((at.y - place.y) / (place.w - place.y) * float(rows)), 0, rows - 1);
  return std::size_t(row) * columns + column;
}

void draw_depth(const PanelContext& context, const ViewInspection& view) {
  const ExpectedView& e = view.expected;
  const bool taken = !view.measured.empty();
  const auto [near, far] = depth_range(view.measured, e.depth);
  const std::string words =
      taken ? "Depth as measured." : "Depth as the map has it. Striped: the way there is not known.";
  const std::string range = fmt::format("\n\nDark {:.0f} mm, pale {:.0f} mm; white: nothing.", 1e3 * near, 1e3 * far);
  const ImVec4 place = draw_picture(context, taken ? "measured" : "expected", double(e.rows) / e.columns, words + range,
                                    [&, near = near, far = far] {
                                      const auto& depth = taken ? view.measured : e.depth;
                                      const auto unknown = taken ? std::vector<std::uint8_t>() : e.unknown;
                                      return depth_picture(depth, unknown, e.columns, e.rows, near, far);
                                    });
  const auto cell = pointed_cell(place, e.columns, e.rows);
  if (!cell) return;
  const float depth = taken ? view.measured[*cell] : e.depth[*cell];
  const std::string way = !taken && e.unknown[*cell] ? "\nthe way there is not known" : "";
  ImGui::SetTooltip("%s", ((depth < 0 ? "nothing met" : fmt::format("{:.0f} mm", 1e3 * depth)) + way).c_str());
}

void mark_ray(const ImVec4& place, std::size_t ray, const RayGrid& grid, const Colour& colour, float width) {
  const float w = (place.z - place.x) / float(grid.columns), h = (place.w - place.y) / float(grid.rows);
  const float x = place.x + float(grid.column(ray)) * w, y = place.y + float(grid.row(ray)) * h;
  ImGui::GetWindowDrawList()->AddRect({x - 1, y - 1}, {x + w + 1, y + h + 1}, to_imgui_u32(colour), 0, 0, width);
}

/// Which ray contributes what; a click inspects the ray.
void draw_contributions(const PanelContext& context, const ViewInspection& view) {
  if (!view.explanation) return small_text(context.style, view.no_explanation);
  const ScoreExplanation& e = *view.explanation;
  const PinholeCamera& camera = context.snapshot.camera;
  const std::string& unit = context.snapshot.gain_unit;
  const RayGrid grid(context.snapshot.configuration.planner, camera, e.rays.size());
  if (grid.cells() == 0 || grid.cells() != e.rays.size()) return;
  const std::string words = fmt::format(
      "What each of its {} adds to the gain.\n\nDark {}, pale little, white nothing. Click a ray to see why.",
      counted(e.rays.size(), "ray"), readable(largest_contribution(e), unit));
  const ImVec4 place = draw_picture(context, "contributions", double(camera.height) / camera.width, words,
                                    [&] { return contribution_picture(e, grid); });
  const float width = context.style.px(1.5f);
  if (const auto& ray = context.window.selection.ray; ray && *ray < e.rays.size())
    mark_ray(place, *ray, grid, theme::ink, width);
  const auto cell = pointed_cell(place, grid.columns, grid.rows);
  if (!cell) return;
  const std::size_t ray = grid.ray(int(*cell) % grid.columns, int(*cell) / grid.columns);
  mark_ray(place, ray, grid, theme::series[0], width);
  ImGui::SetTooltip("ray %zu: %s", ray, readable(e.rays[ray].contribution, unit).c_str());
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) context.post(command::inspect_ray(ray));
}

void draw_taken_numbers(const PanelContext& context, const StepRecord& r) {
  const std::string& unit = r.gain_unit.empty() ? context.snapshot.gain_unit : r.gain_unit;
  const std::string from = r.view < 0 ? (r.overridden ? "your custom view" : "the start view")
                                      : fmt::format("candidate {}{}", r.view, r.overridden ? ", your choice" : "");
  table_row("taken from", from);
  const bool in_surface = unit == "cm²";
  const auto predicted = r.view < 0 && !r.overridden ? "none" : readable(r.gain, unit);
  table_row("predicted", predicted, "What the planner expected of this view, on the map before it");
  table_row(in_surface ? "realised" : "new surface", area_text(r.new_surface),
            "Surface that its points show for the first time, at the registration distance");
  table_row(in_surface ? "entropy lost" : "realised", fmt::format("{} nats", readable(r.realised_gain)),
            "Entropy that the map lost by this view (Eq. 12)");
  table_row("new voxels", fmt::format("{}", r.new_voxels), "Measured for the first time");
  table_row("points", fmt::format("{} of {} hits", r.points, r.hits), "Left after the cleaning of the cloud");
  table_row("beyond range", counted(r.misses, "ray"));
  table_row("way there",
            fmt::format("{}, {:.0f}°", way_text(r.motion.distance, context.snapshot.state.known.map.grid()),
                        180 / std::numbers::pi * r.motion.rotation));
}

/// The gain by which it was ranked. By fewer rays than explain it, unless it is one of the best.
void draw_ranked_gain(const PanelContext& context, const ViewInspection& view, double gain) {
  const PlannerConfig& planner = context.snapshot.configuration.planner;
  const std::size_t rays = std::size_t(planner.ray_columns) * planner.ray_rows;
  const std::string text = readable(gain, context.snapshot.gain_unit);
  const bool by_fewer = view.explanation && view.explanation->rays.size() > rays &&
                        std::abs(gain - view.explanation->value) > 1e-6 * std::abs(gain);
  if (by_fewer)
    table_row("in the ranking", fmt::format("{} by {}", text, counted(rays, "ray")),
              "The gain by which it was ranked: few rays value every candidate, many the best two");
  else
    table_row("in the ranking", text, "The gain by which it was ranked");
}

void draw_candidate_numbers(const PanelContext& context, const ViewInspection& view) {
  const SessionSnapshot& s = context.snapshot;
  const std::string unit = s.gain_unit;
  const auto candidate =
      view.view.kind == ViewSelection::Kind::next ? s.next_candidate : context.window.selection.candidate();
  if (view.explanation)
    table_row("expected gain", readable(view.explanation->value, unit), "The sum of what its rays contribute");
  if (!candidate || s.records.empty()) return;
  const Candidate& c = s.records.back().candidates[*candidate];
  if (!c.unreachable.empty()) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("not reachable");
    ImGui::TableNextColumn();
    return ImGui::TextWrapped("%s", c.unreachable.c_str());
  }
  if (!c.available) return table_row("", "taken");
  draw_ranked_gain(context, view, c.gain);
  table_row("way there", way_text(c.cost, s.state.known.map.grid()));
  const bool per_second = s.configuration.planner.utility == UtilityKind::gain_per_second;
  table_row("utility", fmt::format("{:.4f}", c.utility),
            per_second ? "Gain per second of the way and of a scan"
                       : "U = gain share - cost share, each with its weight (Eq. 13)");
}

void draw_numbers(const PanelContext& context, const ViewInspection& view) {
  if (!ImGui::BeginTable("numbers", 2)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, context.style.px(110));
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  ImGui::PushFont(context.style.small);
  const auto& records = context.snapshot.records;
  if (view.view.kind == ViewSelection::Kind::taken && view.view.index < records.size()) {
    draw_taken_numbers(context, records[view.view.index]);
  } else {
    draw_candidate_numbers(context, view);
  }
  ImGui::PopFont();
  ImGui::EndTable();
}

void draw_buttons(const PanelContext& context) {
  const float gap = context.style.px(6), width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  command_button(context, command::look_through, Icon::none, "Look through it", false, width);
  ImGui::SameLine(0, gap);
  command_button(context, command::custom_view, Icon::none, "View as I look now", false, width);
  const ViewSelection::Kind kind = context.window.selection.view.kind;
  if (kind == ViewSelection::Kind::candidate)
    command_button(context, command::take_view, Icon::none, "Take this view next", true, 2 * width + gap);
  if (kind == ViewSelection::Kind::custom)
    command_button(context, command::take_custom_view, Icon::none, "Take the custom view next", true, 2 * width + gap);
}

}  // namespace

void draw_view_panel(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("View", rectangle, 0, context.style.px(right_panel_width));
  if (!context.snapshot.loaded()) return;
  draw_view_choice(context);
  draw_buttons(context);
  const auto& view = context.inspection.view;
  if (!context.snapshot.finished.empty() && context.window.selection.view.kind == ViewSelection::Kind::next)
    return small_text(context.style, "The scan is finished: there is no next view. Choose one that was taken above.");
  if (!view || view->view != context.window.selection.view) return small_text(context.style, "Looking …");
  if (!view->why_empty.empty()) small_text(context.style, fmt::format("Empty: {}.", view->why_empty), theme::chosen);
  draw_depth(context, *view);
  draw_numbers(context, *view);
  draw_contributions(context, *view);
}

}  // namespace nextview
