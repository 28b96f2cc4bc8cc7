#include "ui/panels/voxel_details.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/file/counted.hpp"
#include "ui/appearance/colour_map.hpp"
#include "ui/commands/gibbs_commands.hpp"
#include "ui/commands/selection_commands.hpp"
#include "ui/commands/window_commands.hpp"
#include "ui/panels/plot.hpp"

namespace nextview {
namespace {

const char* name_of(VoxelClass voxel_class) {
  return voxel_class == VoxelClass::occupied ? "occupied" : voxel_class == VoxelClass::free ? "free" : "unknown";
}

std::string text_of(const Voxel& voxel) {
  if (!voxel.measured) return "not measured";
  return fmt::format("p {:.3f}, {}, {:.2f} nats", voxel.probability, name_of(voxel.voxel_class), voxel.entropy);
}

std::string truth_of(const GroundTruth& truth, std::uint32_t voxel) {
  if (truth.hidden(voxel)) return "inside the object, out of sight";
  if (truth.touch[voxel]) return "the surface touches it";
  const int distance = truth.surface_distance(voxel);
  return distance >= 255 ? "free, far from the surface"
                         : fmt::format("free, {} voxel{} from the surface", distance, distance == 1 ? "" : "s");
}

void draw_summary(const PanelContext& context, std::uint32_t voxel) {
  const SessionSnapshot& s = context.snapshot;
  if (!ImGui::BeginTable("summary", 2)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, context.style.px(96));
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  ImGui::PushFont(context.style.small);
  const Vector3 centre = (1e5 * s.grid.centre(voxel)).array().round() / 1e2 + 0.0;  // no "-0"
  table_row("centre", fmt::format("{:g}, {:g}, {:g} mm", centre.x(), centre.y(), centre.z()));
  table_row("conventional", text_of((*s.voxels)[voxel]), "In the occupancy map");
  if (s.gibbs) {
    const Voxel& v = (*s.gibbs->voxels)[voxel];
    table_row("Gibbs", v.measured ? text_of(v) : "not informed",
              "Posterior mean; of not informed voxels fewer than half a ray tells anything");
  }
  if (s.truth) table_row("truth", truth_of(*s.truth, voxel), "What the mesh says");
  ImGui::PopFont();
  ImGui::EndTable();
}

/// Probability after each view, and what each view did.
void draw_history(const PanelContext& context, const VoxelInspection& voxel) {
  heading(context.style, "Measurement history");
  ChartContent chart{"", "view", "", "p", "", {}, 1.0, true};
  ChartSeries p{"p", {0}, {0.5}};
  for (std::size_t k = 0; k < voxel.history.size(); ++k) {
    p.x.push_back(double(k + 1));
    p.y.push_back(voxel.history[k].probability);
  }
  chart.series = {p};
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const Rectangle place{corner.x, corner.y, ImGui::GetContentRegionAvail().x, context.style.px(112)};
  draw_plot(context.style, chart, place);
  ImGui::Dummy({float(place.width), float(place.height)});
  if (!ImGui::BeginTable("history", 4, ImGuiTableFlags_BordersInnerH)) return;
  ImGui::PushFont(context.style.small);
  for (const auto& [name, width] : {std::pair{"view", 40.0f}, {"hits", 40.0f}, {"misses", 56.0f}})
    ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthFixed, context.style.px(width));
  ImGui::TableSetupColumn("log-odds (change)", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableHeadersRow();
  for (std::size_t k = 0; k < voxel.history.size(); ++k) {
    const VoxelUpdate& u = voxel.history[k];
    if (!u.measured()) continue;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable(fmt::format("{}##history", k + 1).c_str(), false, ImGuiSelectableFlags_SpanAllColumns)) {
      context.post(command::select_taken(k + 1));
      context.post(command::panel(panel_name::view));
    }
    tooltip("Click to look at this view.");
    for (const std::string& text : {fmt::format("{}", u.hits), fmt::format("{}", u.misses),
                                    fmt::format("{:.2f} ({:+.2f})", u.log_odds, u.log_odds_change)}) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(text.c_str());
    }
  }
  ImGui::PopFont();
  ImGui::EndTable();
}

/// The level after each sweep, a strip a chain: pale is free, dark the uppermost level.
void draw_trace(const PanelContext& context, const std::vector<std::vector<std::uint8_t>>& trace, int levels) {
  const Style& style = context.style;
  const float width = ImGui::GetContentRegionAvail().x, height = style.px(12);
  for (const auto& chain : trace) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, {corner.x + width, corner.y + height}, to_imgui_u32(theme::sky));
    const float step = width / float(std::max<std::size_t>(chain.size(), 1));
    for (std::size_t k = 0; k < chain.size(); ++k)
      if (chain[k] > 0)
        list.AddRectFilled(
            {corner.x + float(k) * step, corner.y}, {corner.x + float(k + 1) * step, corner.y + height},
            to_imgui_u32(mix(theme::sky, theme::occupied, 0.4 + 0.6 * chain[k] / std::max(levels - 1, 1))));
    ImGui::Dummy({width, height});
  }
}

std::string level_name(const FullConditional& conditional, std::size_t level) {
  return level == 0 ? "free" : conditional.probability.size() == 2 ? "occupied" : fmt::format("level {}", level);
}

/// Probability of each level, as bars.
void draw_conditional(const PanelContext& context, const FullConditional& conditional) {
  const Style& style = context.style;
  ImGui::PushFont(style.small);
  for (std::size_t q = 0; q < conditional.probability.size(); ++q) {
    ImGui::TextDisabled("%s", level_name(conditional, q).c_str());
    const float p = float(conditional.probability[q]);
    ImGui::SameLine(style.px(84));
    ImGui::TextUnformatted(fmt::format("{:.4f}", p).c_str());
    ImGui::SameLine(style.px(138));
    ImGui::ProgressBar(p, {-FLT_MIN, ImGui::GetTextLineHeight()}, "");
  }
  ImGui::PopFont();
  double speaks_for = 0, against = 0;
  for (const RayEvidence& ray : conditional.rays) (ray.log_ratio > 0 ? speaks_for : against) += ray.log_ratio;
  small_text(style, fmt::format("log odds of {} against free: {:+.2f}, of these prior {:+.2f}, rays for it {:+.2f}, "
                                "against it {:+.2f}",
                                level_name(conditional, std::size_t(conditional.level)),
                                conditional.log_prior_odds + speaks_for + against, conditional.log_prior_odds,
                                speaks_for, against));
}

void draw_gibbs(const PanelContext& context, const VoxelInspection& voxel) {
  const SessionSnapshot& s = context.snapshot;
  heading(context.style, "Gibbs sampler");
  if (!s.gibbs) {
    small_text(context.style, "There is no Gibbs map yet.");
    return command_button(context, command::refine, Icon::none, "Refine the map");
  }
  if (s.gibbs->views < s.records.size())
    small_text(context.style, fmt::format("The Gibbs map is of {}.", first_views(s.gibbs->views)), theme::chosen);
  if (!voxel.trace.empty()) {
    small_text(context.style, "its level after each sweep, a strip a chain");
    draw_trace(context, voxel.trace, s.gibbs->config.model.levels());
  }
  if (voxel.conditional) {
    if ((*s.gibbs->voxels)[voxel.voxel].probability != s.gibbs->posterior->occupied[voxel.voxel])
      small_text(
          context.style,
          "Its p is that the surface touches it, read out from the levels and rays around it, too. Its own level "
          "says how many rays it stops:");
    small_text(context.style, fmt::format("full conditional, given the rest of the last map of chain 1; {} a say",
                                          counted(voxel.conditional->rays.size(), "ray has", "rays have")));
    draw_conditional(context, *voxel.conditional);
  }
}

}  // namespace

void draw_voxel_details(const PanelContext& context, const VoxelInspection& voxel) {
  const Eigen::Vector3i cell = context.snapshot.grid.cell(voxel.voxel);
  heading(context.style, fmt::format("Voxel {}, {}, {}", cell.x(), cell.y(), cell.z()).c_str());
  draw_summary(context, voxel.voxel);
  draw_history(context, voxel);
  std::size_t rays = 0;
  for (const auto& view : voxel.rays) rays += view.size();
  if (rays > 0) small_text(context.style, "Its rays are in the scene: blue ends in it, grey passes.");
  ImGui::Spacing();
  draw_gibbs(context, voxel);
}

}  // namespace nextview
