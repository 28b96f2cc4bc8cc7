#include "ui/report/scene_panel.hpp"

#include <cmath>

#include "ui/figures/session_figure.hpp"

namespace nextview {

void draw_scene_panel(VectorDrawing& drawing, const DrawingArea& area, const StepPicture& picture,
                      const SceneLayers& layers, const FigurePaper& paper, const ViewDirection& direction,
                      std::span<const Vector3> points) {
  if (!(paper.scale > 0.0)) return;
  SceneLayers shown = layers;
  shown.cloud |= layers.object && !picture.object;
  shown.dark = paper.look.is_dark();
  const auto pixels = [&](double length) { return int(std::lround(length * paper.scale)); };
  SceneFigure figure(paper.target, picture, shown, {pixels(area.width), pixels(area.height)}, paper.scale);
  drawing.picture(area.left, area.top, points.empty() ? figure.draw(direction, false) : figure.draw(direction, points));
}

StepPicture picture_after(ReportScan& scan, std::size_t views) {
  scan.session->restore(scan.states.at(views - 1));
  return step_picture(*scan.session);
}

std::vector<Vector3> points_around(const StepPicture& picture, bool view) {
  Eigen::AlignedBox3d box;
  if (picture.object) box = picture.object->bounding_box();
  for (const Eigen::Vector3f& point : picture.object ? PointCloud() : picture.cloud) box.extend(point.cast<double>());
  if (box.isEmpty()) box = {picture.grid.lower(), picture.grid.upper()};
  std::vector<Vector3> points = corners(box);
  if (!view || !picture.chosen) return points;
  const Pose& T_world_camera = picture.candidates.at(*picture.chosen);
  const double reach = views_of(picture).reach;  // [m]
  points.push_back(T_world_camera.translation());
  for (const int u : {0, picture.camera.width})
    for (const int v : {0, picture.camera.height}) {
      const Vector3 direction = picture.camera.direction(u, v);
      points.push_back(T_world_camera * Vector3(direction * (reach / direction.z())));
    }
  return points;
}

void draw_heading(VectorDrawing& drawing, const DrawingArea& area, const std::string& text) {
  drawing.text(area.left, area.top - 8, text, theme::small_text, drawing.look().ink);
}

void draw_title(VectorDrawing& drawing, const std::string& text) {
  drawing.text(16, 26, text, theme::caption, drawing.look().ink, TextAlign::left, true);
}

void draw_voxel_key(VectorDrawing& drawing, double top) {
  constexpr double swatch = 12, gap = 6;
  const auto shown_as = [&](double x, const Colour& colour, const std::string& words) {
    drawing.box(x, top, swatch, swatch, colour);
    drawing.text(x + swatch + gap, top + swatch - 1, words, theme::small_text, drawing.look().soft_ink);
  };
  shown_as(panel_margin, theme::occupied, "occupied");
  shown_as(panel_margin + 92, theme::unknown, "measured but unknown");
}

}  // namespace nextview
