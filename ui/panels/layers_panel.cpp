#include "ui/panels/layers_panel.hpp"

#include <array>
#include <utility>

#include "ui/colour_map.hpp"

namespace nextview {
namespace {

/// A layer's checkbox, with its key at the right border.
void checkbox(const char* name, Action action, bool* shown) {
  ImGui::Checkbox(name, shown);
  const std::string_view key = keys_of(action);
  const float width = ImGui::CalcTextSize(key.data(), key.data() + key.size()).x;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
  ImGui::PushStyleColor(ImGuiCol_Text, to_imgui(theme::soft_ink));
  ImGui::TextUnformatted(key.data(), key.data() + key.size());
  ImGui::PopStyleColor();
  tooltip("Key " + std::string(key));
}

/// One of several choices, as a row of buttons that hang together.
template <class Value, std::size_t count>
void segmented(const PanelContext& context, Value& value, const std::array<std::pair<const char*, Value>, count>& all) {
  const float width = (ImGui::GetContentRegionAvail().x - float(count - 1) * context.style.px(2)) / float(count);
  ImGui::PushFont(context.style.small);
  ImGui::PushID(all.data()->first);
  for (const auto& [name, one] : all) {
    if (one != all[0].second) ImGui::SameLine(0, context.style.px(2));
    const bool selected = one == value;
    if (selected) {
      const Colour fill = mix(theme::series[0], theme::paper, 0.78);
      for (const auto which : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive}) {
        ImGui::PushStyleColor(which, to_imgui(fill));
      }
    }
    if (ImGui::Button(name, {width, 0})) value = one;
    if (selected) ImGui::PopStyleColor(3);
  }
  ImGui::PopID();
  ImGui::PopFont();
}

void voxel_class(const PanelContext& context, const char* name, const char* help, const Colour& colour, bool* shown) {
  ImGui::PushFont(context.style.small);
  ImGui::Checkbox(name, shown);
  tooltip(help);
  const float size = context.style.px(12);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - size);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float y = corner.y + (ImGui::GetFrameHeight() - size) / 2;
  ImGui::GetWindowDrawList()->AddRectFilled({corner.x, y}, {corner.x + size, y + size}, to_imgui_u32(colour),
                                            context.style.px(2));
  ImGui::NewLine();
  ImGui::PopFont();
}

void draw_octree_options(const PanelContext& context, LayerChoice& choice) {
  segmented(context, choice.colouring,
            std::array{std::pair{"by class", VoxelColouring::by_class},
                       std::pair{"by probability", VoxelColouring::by_probability}});
  voxel_class(context, "occupied", "Measured voxels with p above the bound of class occupied", theme::occupied,
              &choice.voxels.occupied);
  voxel_class(context, "unknown", "Measured voxels that are neither occupied nor free yet", theme::unknown,
              &choice.voxels.unknown);
  voxel_class(context, "free", "Measured voxels with p below the bound of class free", theme::free,
              &choice.voxels.free);
}

}  // namespace

bool* layer_of(LayerChoice& choice, Action action) {
  switch (action) {
    case Action::toggle_object:
      return &choice.object;
    case Action::toggle_cloud:
      return &choice.cloud;
    case Action::toggle_octree:
      return &choice.octree;
    case Action::toggle_views:
      return &choice.views;
    case Action::toggle_rays:
      return &choice.rays;
    case Action::toggle_region:
      return &choice.region;
    default:
      return nullptr;
  }
}

void draw_layers_panel(PanelContext& context, const Rectangle& rectangle, LayerChoice& choice) {
  const Panel panel("Layers", rectangle);
  heading(context.style, "Layers");
  ImGui::Spacing();
  const auto layer = [&](const char* name, Action action) { checkbox(name, action, layer_of(choice, action)); };
  const float indent = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
  layer("Object", Action::toggle_object);
  ImGui::Indent(indent);
  segmented(context, choice.object_style,
            std::array{std::pair{"ghost", MeshStyle::ghost}, std::pair{"solid", MeshStyle::solid},
                       std::pair{"wire", MeshStyle::wire}});
  ImGui::Unindent(indent);
  layer("Point cloud", Action::toggle_cloud);
  layer("Octree", Action::toggle_octree);
  ImGui::Indent(indent);
  draw_octree_options(context, choice);
  ImGui::Unindent(indent);
  layer("Candidate views", Action::toggle_views);
  layer("Next view's rays", Action::toggle_rays);
  layer("Region of interest", Action::toggle_region);
}

}  // namespace nextview
