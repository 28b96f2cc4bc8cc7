#include "ui/panels/layers_panel.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "ui/appearance/colour_map.hpp"
#include "ui/commands/scene_commands.hpp"

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
  ImGui::GetWindowDrawList()->AddRectFilled({corner.x, y}, {corner.x + size, y + size}, to_imgui_u32(colour),
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
         grid.upper()[slice->axis], "%.0f", 1000);
}

void draw_octree(const PanelContext& context) {
  const LayerChoice& layers = context.window.layers;
  constexpr std::array maps = {"conventional map", "Gibbs map"};
  constexpr std::array colours = {"class", "probability", "entropy", "Gibbs − conventional", "error against truth"};
  choices(context, command::voxel_map, "Of the", layers.map, maps);
  choices(context, command::voxel_colour, "Coloured by", layers.colouring, colours);
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
  toggle(context, command::toggle_cloud, "Point cloud");
  nested([&] { choices(context, command::cloud_colour, "Coloured by", layers.cloud_colouring, clouds); });
  toggle(context, command::toggle_octree, "Octree");
  nested([&] { draw_octree(context); });
  toggle(context, command::toggle_views, "Candidate views");
  nested([&] { toggle(context, command::toggle_candidates, "all of them"); });
  toggle(context, command::toggle_rays, "Rays");
  toggle(context, command::toggle_region, "Region of interest");
  ImGui::Separator();
  toggle(context, command::toggle_legends, "Legends");
  toggle(context, command::lock_ranges, "Lock colour ranges");
}

}  // namespace nextview
