// Figures that are scenes of one scan.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/file/counted.hpp"
#include "ui/report/scene_panel.hpp"

namespace nextview {
namespace {

/// Two scenes beside each other, with headings.
struct TwoPanels {
  static constexpr double width = 440, height = 360;
  VectorDrawing drawing;
  DrawingArea left{panel_margin, panel_top, width, height},
      right{panel_margin + width + panel_gap, panel_top, width, height};

  TwoPanels(const FigurePaper& paper, const std::string& title)
      : drawing(2 * (panel_margin + width) + panel_gap, panel_top + height + panel_margin, paper.look) {
    draw_title(drawing, title);
  }
};

/// The views that are shown as columns.
std::vector<int> columns_of(const ReportScan& scan, const FigurePaper& paper) {
  std::vector<int> views = paper.views;
  std::erase_if(views, [&](int view) { return view < 1 || std::size_t(view) > scan.states.size(); });
  if (views.empty()) views.push_back(int(scan.states.size()));
  return views;
}

/// What the colours of rays and voxels mean, in two lines from `top` on [px].
void draw_key(VectorDrawing& drawing, double top, const std::string& along_rays) {
  draw_voxel_key(drawing, top);
  if (along_rays.empty()) return;  // views at random are not explained
  constexpr int shades = 24;
  constexpr double width = 4, height = 12, line = 20, gap = 6;
  const ColourMap map = drawing.look().is_dark() ? ColourMap::contribution().on_dark() : ColourMap::contribution();
  for (int i = 0; i < shades; ++i)
    drawing.box(panel_margin + i * width, top + line, width, height, map.at(i / double(shades - 1)));
  drawing.text(panel_margin + shades * width + gap, top + line + height - 1, along_rays + ", none to most",
               theme::small_text, drawing.look().soft_ink);
}

/// "6 views taken, in this order: start, 17, 4, …": as far as the heading has room.
std::string order_text(const std::vector<StepRecord>& records) {
  constexpr std::size_t most = 9;
  std::string text = counted(records.size(), "view") + " taken, in this order:";
  for (std::size_t i = 0; i < std::min(records.size(), most); ++i)
    text += fmt::format("{} {}", i == 0 ? "" : ",", records[i].view < 0 ? "start" : std::to_string(records[i].view));
  return text + (records.size() > most ? ", …" : "");
}

}  // namespace

VectorDrawing scene_and_octree_figure(std::span<ReportScan> scans, const FigurePaper& paper) {
  ReportScan& scan = scans.front();
  const std::size_t views = std::max<std::size_t>(1, scan.states.size() / 4);  // of all the map would be closed
  StepPicture picture = picture_after(scan, views);
  picture.object_style = MeshStyle::solid;
  TwoPanels panels(paper, fmt::format("{}: the scene, and its octree after {}", scan.name, counted(views, "view")));
  SceneLayers scene = no_layers, octree = no_layers;
  scene.object = scene.views = scene.rays = scene.region = true;
  octree.map = octree.annotated = true;
  draw_heading(panels.drawing, panels.left, "object, and sensor where it looks next");
  draw_heading(panels.drawing, panels.right, fmt::format("octree, voxels of {:g} mm", 1e3 * picture.grid.resolution));
  draw_scene_panel(panels.drawing, panels.left, picture, scene, paper);
  draw_scene_panel(panels.drawing, panels.right, picture, octree, paper);
  return std::move(panels.drawing);
}

VectorDrawing candidate_views_figure(std::span<ReportScan> scans, const FigurePaper& paper) {
  ReportScan& scan = scans.front();
  SceneLayers layers = no_layers;
  layers.object = layers.views = layers.candidates = layers.annotated = true;
  StepPicture first = picture_after(scan, 1);
  first.object_style = MeshStyle::solid;
  first.taken.clear(), first.path.clear(), first.chosen.reset();
  TwoPanels panels(paper, fmt::format("{}: candidate views, and the views taken", scan.name));
  for (const auto& record : scan.states.back().records)
    if (record->view >= 0) first.numbered.push_back(std::size_t(record->view));
  draw_heading(panels.drawing, panels.left,
               fmt::format("{} candidates, ranked after the first view; taken ones numbered", first.candidates.size()));
  draw_scene_panel(panels.drawing, panels.left, first, layers, paper);
  StepPicture last = picture_after(scan, scan.states.size());
  last.object_style = MeshStyle::solid;
  last.candidates = last.path;
  last.scores.resize(last.path.size());
  std::iota(last.scores.begin(), last.scores.end(), 1.0);
  last.taken.clear(), last.chosen.reset();
  layers.annotated = false;
  draw_heading(panels.drawing, panels.right, order_text(scan.session->records()));
  draw_scene_panel(panels.drawing, panels.right, last, layers, paper);
  return std::move(panels.drawing);
}

VectorDrawing strategy_figure(std::span<ReportScan> scans, const FigurePaper& paper) {
  constexpr double width = 168, height = 140, label = 92, narrowest = 440;  // that has room for the title and the key
  ReportScan& scan = scans.front();
  const std::vector<int> columns = columns_of(scan, paper);
  const double panels = panel_margin + label + double(columns.size()) * (width + panel_gap);
  VectorDrawing drawing(std::max(panels, narrowest), panel_top + 3 * (height + panel_gap) + 48, paper.look);
  draw_title(drawing, fmt::format("{}: {} view by view", scan.name, scan.session->configuration().planner.gain));
  SceneLayers layers[3] = {no_layers, no_layers, no_layers};
  layers[0].object = layers[0].rays = layers[0].views = true;
  layers[1].cloud = true;
  layers[2].map = true;
  const char* names[] = {"ray casting", "cloud", "octree"};
  for (int row = 0; row < 3; ++row)
    drawing.text(panel_margin, panel_top + row * (height + panel_gap) + 0.5 * height, names[row], theme::small_text,
                 paper.look.ink);
  std::string along_rays;
  for (std::size_t column = 0; column < columns.size(); ++column) {
    StepPicture picture = picture_after(scan, std::size_t(columns[column]));
    if (!picture.rays.empty()) along_rays = picture.ray_values.name;
    picture.point_size = 1.5;
    for (int row = 0; row < 3; ++row) {
      const DrawingArea area{panel_margin + label + double(column) * (width + panel_gap),
                             panel_top + row * (height + panel_gap), width, height};
      if (row == 0) draw_heading(drawing, area, fmt::format("iteration {}", columns[column]));
      draw_scene_panel(drawing, area, picture, layers[row], paper, {}, points_around(picture, row == 0));
      if (row == 0 && !picture.chosen)
        drawing.text(area.left + 0.5 * width, area.top + 20, "no view is left", theme::small_text, theme::soft_ink,
                     TextAlign::centre);
    }
  }
  draw_key(drawing, panel_top + 3 * (height + panel_gap), along_rays);
  return drawing;
}

}  // namespace nextview
