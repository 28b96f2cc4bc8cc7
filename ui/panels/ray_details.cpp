#include "ui/panels/ray_details.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/file/counted.hpp"
#include "ui/appearance/colour_map.hpp"
#include "ui/commands/selection_commands.hpp"

namespace nextview {
namespace {

Vector3 centre_of(const ScoreExplanation::Voxel& voxel, double resolution) {
  return (Vector3(voxel.lattice[0], voxel.lattice[1], voxel.lattice[2]) + Vector3::Constant(0.5)) * resolution;
}

/// A row of numbers; the contribution has a bar behind it.
void draw_row(const PanelContext& context, const ScoreExplanation::Voxel& voxel, std::size_t index, double distance,
              double largest) {
  const SessionSnapshot& s = context.snapshot;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const Vector3 centre = centre_of(voxel, s.grid.resolution);
  const bool in_grid = s.grid.contains(s.grid.cell_at(centre));
  const int decimals = s.grid.resolution < 2e-3 ? 1 : 0;
  if (ImGui::Selectable(fmt::format("{:.{}f}##{}", 1e3 * std::max(distance, 0.0), decimals, index).c_str(), false,
                        ImGuiSelectableFlags_SpanAllColumns) &&
      in_grid)
    context.post(command::inspect_voxel(centre.x(), centre.y(), centre.z()));
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(voxel.measured ? fmt::format("{:.3f}", voxel.probability).c_str() : "unseen");
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(fmt::format("{:.3f}", voxel.visibility).c_str());
  ImGui::TableNextColumn();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
  if (largest > 0 && voxel.contribution > 0)
    ImGui::GetWindowDrawList()->AddRectFilled(
        corner, {corner.x + width * float(voxel.contribution / largest), corner.y + height},
        to_imgui_u32(mix(theme::chosen, theme::paper, 0.75)), context.style.px(2));
  ImGui::TextUnformatted(readable(voxel.contribution).c_str());
}

}  // namespace

void draw_ray_details(const PanelContext& context, const ScoreExplanation& explanation, std::size_t index) {
  const auto& ray = explanation.rays[index];
  const std::string unit = context.snapshot.gain_unit;
  heading(context.style, fmt::format("Ray {} of {}", index, explanation.rays.size()).c_str());
  const double share = explanation.value != 0 ? 100 * ray.contribution / explanation.value : 0;
  small_text(context.style, fmt::format("It contributes {} of the view's {} ({:.2f} %): the sum over its {}.",
                                        readable(ray.contribution, unit), readable(explanation.value, unit), share,
                                        counted(ray.voxels.size(), "voxel")));
  if (ray.voxels.empty()) return small_text(context.style, "It misses the region of interest.");
  double largest = 0;
  for (const auto& voxel : ray.voxels) largest = std::max(largest, voxel.contribution);
  const auto flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerH;
  if (!ImGui::BeginTable("ray", 4, flags, {0, ImGui::GetContentRegionAvail().y - context.style.px(36)})) return;
  ImGui::PushFont(context.style.small);
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("at [mm]", ImGuiTableColumnFlags_WidthFixed, context.style.px(56));
  ImGui::TableSetupColumn("p", ImGuiTableColumnFlags_WidthFixed, context.style.px(54));
  ImGui::TableSetupColumn("visibility", ImGuiTableColumnFlags_WidthFixed, context.style.px(64));
  ImGui::TableSetupColumn(fmt::format("adds [{}]", unit.empty() ? "1" : unit).c_str(),
                          ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableHeadersRow();
  const Vector3 origin = context.inspection.view->T_world_camera.translation();
  for (std::size_t i = 0; i < ray.voxels.size(); ++i) {
    const double distance = (centre_of(ray.voxels[i], context.snapshot.grid.resolution) - origin).dot(ray.direction);
    draw_row(context, ray.voxels[i], i, distance, largest);
  }
  ImGui::PopFont();
  ImGui::EndTable();
  small_text(context.style,
             "at: distance from the camera; visibility: how likely the ray gets there. Click a voxel to inspect it.");
}

}  // namespace nextview
