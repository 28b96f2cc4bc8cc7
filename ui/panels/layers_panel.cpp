#include "ui/panels/layers_panel.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "ui/appearance/colour_map.hpp"

namespace nextview {
namespace {

/// A checkbox for a command that switches something, with its key at the right border.
void toggle(const PanelContext& context, const char* name, const char* label) {
  const Command& command = find_command(name);
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

/// One of the values of a command's first argument, as a drop-down list.
template <std::size_t count>
void choices(const PanelContext& context, const char* command, const char* label, std::size_t selected,
             const std::array<const char*, count>& names) {
  const auto values = find_command(command).arguments.front().choices(context.snapshot);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(context.style.px(112));
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::BeginCombo(fmt::format("##{}", command).c_str(), names[selected])) {
    for (std::size_t i = 0; i < count; ++i)
      if (ImGui::Selectable(names[i], i == selected)) context.call(command, values[i]);
    ImGui::EndCombo();
  }
  tooltip(find_command(command).help);
}

/// A slider whose value a command takes, rounded to what the slider shows.
void slider(const PanelContext& context, const char* command, const char* label, double value, double low, double high,
            const char* format, double scale = 1.0) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(context.style.px(112));
  ImGui::SetNextItemWidth(-FLT_MIN);
  float shown = float(value * scale);
  if (ImGui::SliderFloat(fmt::format("##{}", command).c_str(), &shown, float(low * scale), float(high * scale), format))
    context.call(command, std::clamp(std::round(shown * 1000) / 1000 / scale, low, high));
  tooltip(find_command(command).help);
}

void draw_slice(const PanelContext& context) {
  const auto& slice = context.window.layers.voxels.slice;
  constexpr std::array names = {"all", "x", "y", "z"};
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Slice");
  ImGui::SameLine(context.style.px(112));
  if (const auto axis = segmented(context, "slice", names, slice ? std::size_t(slice->axis) + 1 : 0))
    context.call("slice-axis", *axis == 0 ? "none" : names[*axis]);
  if (!slice || !context.snapshot.loaded()) return;
  const VoxelGrid& grid = context.snapshot.grid;
  slider(context, "slice-at", "at [mm]", 0.5 * (slice->low + slice->high), grid.lower()[slice->axis],
         grid.upper()[slice->axis], "%.0f", 1000);
}

void draw_octree(const PanelContext& context) {
  const LayerChoice& layers = context.window.layers;
  constexpr std::array maps = {"conventional map", "Gibbs map"};
  constexpr std::array colours = {"class", "probability", "entropy", "Gibbs − conventional", "error against truth"};
  choices(context, "voxel-map", "Of the", static_cast<std::size_t>(layers.map), maps);
  choices(context, "voxel-colour", "Coloured by", static_cast<std::size_t>(layers.colouring), colours);
  ImGui::BeginDisabled(layers.voxels.uncertain);
  for (const auto& [name, label, colour] : {std::tuple{"toggle-occupied", "occupied", theme::occupied},
                                            {"toggle-unknown", "unknown", theme::unknown},
                                            {"toggle-free", "free", theme::free}}) {
    toggle(context, name, label);
    swatch(context, colour);
  }
  if (layers.voxels.unknown) slider(context, "threshold", "p from", layers.voxels.unknown_from, 0, 1, "%.2f");
  ImGui::EndDisabled();
  toggle(context, "toggle-uncertain", "uncertain only");
  if (layers.voxels.uncertain)
    slider(context, "uncertain-from", "from", layers.voxels.entropy_from, 0, 0.693, "%.2f nats");
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
  toggle(context, "toggle-object", "Object");
  nested([&] {
    if (const auto style = segmented(context, "style", styles, static_cast<std::size_t>(layers.object_style)))
      context.call("object-style", styles[*style]);
  });
  toggle(context, "toggle-missed", "Missed surface");
  toggle(context, "toggle-cloud", "Point cloud");
  nested([&] {
    choices(context, "cloud-colour", "Coloured by", static_cast<std::size_t>(layers.cloud_colouring), clouds);
  });
  toggle(context, "toggle-octree", "Octree");
  nested([&] { draw_octree(context); });
  toggle(context, "toggle-views", "Candidate views");
  toggle(context, "toggle-rays", "Rays");
  toggle(context, "toggle-region", "Region of interest");
  ImGui::Separator();
  toggle(context, "lock-ranges", "Lock colour ranges");
}

}  // namespace nextview
