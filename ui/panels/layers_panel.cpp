#include "ui/panels/layers_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ui/appearance/colour_map.hpp"
#include "ui/commands/layer_commands.hpp"
#include "ui/commands/scene_commands.hpp"
#include "ui/workbench/chosen_voxels.hpp"

namespace nextview {
namespace {

/// A checkbox for a command that switches something, with its key at the right border.
void toggle(const PanelContext& context, const Command& command, const char* label) {
  bool on = command.on(context.window);
  if (ImGui::Checkbox(label, &on)) context.invoke(command);
  tooltip(help_of(context, command));
  const std::string keys = command.keys();
  if (keys.empty()) return;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(keys.c_str()).x);
  ImGui::TextDisabled("%s", keys.c_str());
}

void swatch(const PanelContext& context, const Colour& colour) {
  const float size = context.style.px(12);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - size);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float y = corner.y + (ImGui::GetFrameHeight() - size) / 2;
  ImGui::GetWindowDrawList()->AddRectFilled({corner.x, y}, {corner.x + size, y + size}, scene_colour_u32(colour),
                                            context.style.px(2));
  ImGui::NewLine();
}

/// One of an enumeration's values, which a command takes, as a drop-down list.
template <class Enum, std::size_t count>
void choices(const PanelContext& context, const CommandOf<Enum>& command, const char* label, Enum chosen,
             const std::array<const char*, count>& names) {
  const auto selected = static_cast<std::size_t>(chosen);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(context.style.px(112));
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::BeginCombo(fmt::format("##{}", command.name).c_str(), names[selected])) {
    for (std::size_t i = 0; i < count; ++i)
      if (ImGui::Selectable(names[i], i == selected)) context.post(command(static_cast<Enum>(i)));
    ImGui::EndCombo();
  }
  tooltip(command.help);
}

/// A slider whose value a command takes, rounded to what the slider shows.
template <class Command>
void slider(const PanelContext& context, const Command& command, const char* label, double value, double low,
            double high, const char* format, double scale = 1.0) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(context.style.px(112));
  ImGui::SetNextItemWidth(-FLT_MIN);
  float shown = float(value * scale);
  if (ImGui::SliderFloat(fmt::format("##{}", command.name).c_str(), &shown, float(low * scale), float(high * scale),
                         format))
    context.post(command(std::clamp(std::round(shown * 1000) / 1000 / scale, low, high)));
  tooltip(command.help);
}

void draw_slice(const PanelContext& context) {
  const auto& slice = context.window.layers.voxels.slice;
  constexpr std::array names = {"all", "x", "y", "z"};
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Slice");
  ImGui::SameLine(context.style.px(112));
  if (const auto axis = segmented(context, "slice", names, slice ? std::size_t(slice->axis) + 1 : 0))
    context.post(command::slice_axis(static_cast<SliceAxis>(*axis)));
  if (!slice || !context.snapshot.loaded()) return;
  const VoxelGrid& grid = context.snapshot.grid;
  slider(context, command::slice_at, "at [mm]", 0.5 * (slice->low + slice->high), grid.lower()[slice->axis],
         grid.upper()[slice->axis], grid.resolution < 2e-3 ? "%.1f" : "%.0f", 1000);
}

void draw_octree(const PanelContext& context) {
  const LayerChoice& layers = context.window.layers;
  constexpr std::array maps = {"conventional map", "Gibbs map"};
  constexpr std::array colours = {"class", "probability", "entropy", "change by Gibbs", "error"};
  choices(context, command::voxel_map, "Of the", layers.map, maps);
  choices(context, command::voxel_colour, "Coloured by", chosen_colouring(context.snapshot, layers), colours);
  ImGui::BeginDisabled(layers.voxels.uncertain);
  for (const auto& [command, label, colour] : {std::tuple{&command::toggle_occupied, "occupied", theme::occupied},
                                               {&command::toggle_unknown, "unknown", theme::unknown},
                                               {&command::toggle_free, "free", theme::free}}) {
    toggle(context, *command, label);
    swatch(context, colour);
  }
  if (layers.voxels.unknown) slider(context, command::threshold, "p from", layers.voxels.unknown_from, 0, 1, "%.2f");
  ImGui::EndDisabled();
  toggle(context, command::toggle_uncertain, "uncertain only");
  if (layers.voxels.uncertain)
    slider(context, command::uncertain_from, "from", layers.voxels.entropy_from, 0, 0.693, "%.2f nats");
  draw_slice(context);
}

void draw_section(const PanelContext& context) {
  const auto& section = context.window.layers.section;
  constexpr std::array names = {"off", "x", "y", "z"};
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Section");
  tooltip(command::section_axis.help);
  ImGui::SameLine(context.style.px(112));
  if (const auto axis = segmented(context, "section", names, section ? std::size_t(section->axis) + 1 : 0))
    context.post(command::section_axis(static_cast<SliceAxis>(*axis)));
  if (!section || !context.snapshot.loaded()) return;
  const SessionSnapshot& s = context.snapshot;
  const Eigen::AlignedBox3d& box = s.object_box;
  slider(context, command::section_at, "at [mm]", section->at, box.min()[section->axis], box.max()[section->axis],
         "%.1f", 1000);
  if (ImGui::Button("Turn over")) context.post(command::flip_section());
  tooltip(help_of(context, command::flip_section));
}

/// How far the surface lies from the true one: bars in the colours of the scene.
void draw_histogram(const PanelContext& context, const SurfaceError& error) {
  const DistanceHistogram& histogram = error.histogram;
  const std::size_t most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
  if (most == 0) return;
  const float width = ImGui::GetContentRegionAvail().x, height = context.style.px(54);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ColourMap map = ColourMap::deviation();
  const float bar = width / float(histogram.counts.size());
  list.AddRectFilled(corner, {corner.x + width, corner.y + height}, to_imgui_u32(theme::sky));
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const float top = height * (1 - 0.95f * float(histogram.counts[i]) / float(most));
    list.AddRectFilled(
        {corner.x + bar * float(i), corner.y + top}, {corner.x + bar * float(i + 1), corner.y + height},
        scene_colour_u32(mix(map.at((double(i) + 0.5) / double(histogram.counts.size())), theme::muted, 0.25)));
  }
  ImGui::Dummy({width, height});
  tooltip("How the distances from the true surface are spread over what was seen of this one; negative lies inside.");
  const std::string low = fmt::format("−{:g}", 1e3 * histogram.limit),
                    high = fmt::format("{:g} mm", 1e3 * histogram.limit);
  ImGui::TextDisabled("%s", low.c_str());
  ImGui::SameLine(ImGui::GetCursorPosX() + width - ImGui::CalcTextSize(high.c_str()).x);
  ImGui::TextDisabled("%s", high.c_str());
  small_text(context.style,
             fmt::format("95 % within {:.2f} mm, mean {:+.2f} mm", 1e3 * error.percentile_95, 1e3 * error.bias));
}

void draw_surface(const PanelContext& context) {
  const LayerChoice& layers = context.window.layers;
  constexpr std::array sources = {"map", "points"};
  constexpr std::array colours = {"distance to truth", "uncertainty", "what was seen"};
  if (!layers.surface && layers.second != SecondView::surface) return;
  if (const auto source = segmented(context, "surface of", sources, static_cast<std::size_t>(layers.surface_source)))
    context.post(command::surface_source(static_cast<SurfaceSource>(*source)));
  tooltip(command::surface_source.help);
  choices(context, command::surface_colour, "Coloured by", chosen_surface_colouring(context.snapshot, layers), colours);
  const FoundSurface* found = context.surface;
  if (!found || !found->of.session || found->of.session->session != context.snapshot.session) return;
  if (!found->found.surface.why_empty.empty()) small_text(context.style, found->found.surface.why_empty);
  if (found->found.surface_error) draw_histogram(context, *found->found.surface_error);
}

void draw_second(const PanelContext& context) {
  constexpr std::array names = {"nothing", "object", "surface", "points", "octree", "Gibbs octree", "missed surface"};
  choices(context, command::second_view, "Beside it", context.window.layers.second, names);
}

}  // namespace

void draw_layers_panel(const PanelContext& context, const Rectangle& rectangle) {
  const Panel panel("Layers", rectangle, 0, context.style.px(left_panel_width));
  const LayerChoice& layers = context.window.layers;
  const float indent = context.style.px(20);
  constexpr std::array styles = {"solid", "wire", "ghost"};
  constexpr std::array clouds = {"one colour", "view", "height", "distance to truth"};
  const auto nested = [&](const auto& draw) {
    ImGui::Indent(indent);
    ImGui::PushFont(context.style.small);
    draw();
    ImGui::PopFont();
    ImGui::Unindent(indent);
  };
  toggle(context, command::toggle_object, "Object");
  nested([&] {
    if (const auto style = segmented(context, "style", styles, static_cast<std::size_t>(layers.object_style)))
      context.post(command::object_style(static_cast<MeshStyle>(*style)));
  });
  toggle(context, command::toggle_missed, "Missed surface");
  toggle(context, command::toggle_surface, "Reconstructed surface");
  nested([&] { draw_surface(context); });
  toggle(context, command::toggle_cloud, "Point cloud");
  nested([&] {
    choices(context, command::cloud_colour, "Coloured by", chosen_cloud_colouring(context.snapshot, layers), clouds);
  });
  toggle(context, command::toggle_octree, "Octree");
  nested([&] { draw_octree(context); });
  toggle(context, command::toggle_views, "Candidate views");
  nested([&] { toggle(context, command::toggle_candidates, "all of them"); });
  toggle(context, command::toggle_rays, "Rays");
  toggle(context, command::toggle_region, "Region of interest");
  ImGui::Separator();
  draw_section(context);
  draw_second(context);
  toggle(context, command::toggle_legends, "Legends");
  toggle(context, command::lock_ranges, "Lock colour ranges");
}

}  // namespace nextview
