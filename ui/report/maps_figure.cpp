#include <fmt/format.h>

#include <cmath>

#include "core/file/counted.hpp"
#include "ui/report/scene_panel.hpp"

namespace nextview {
namespace {

constexpr double width = 224, height = 180, magnified = 168;  // of panels [px]

/// A box around an opening, and where it is looked at from: through it, a little from the side.
struct Magnified {
  std::vector<Vector3> points;
  ViewDirection direction;
};

/// Of the second narrowest width: what maps differ in.
const Opening& shown_opening(std::span<const Opening> openings) {
  const Opening* narrowest = &openings.front();
  for (const Opening& opening : openings)
    if (std::abs(opening.width - 0.02) < std::abs(narrowest->width - 0.02)) narrowest = &opening;
  return *narrowest;
}

/// From outside of the object; if the opening goes through its middle, from above.
Magnified magnify(const Opening& opening, const Vector3& middle) {
  const double half = 0.5 * std::max(opening.length, 3.0 * opening.width) + 0.01;  // [m]
  const Vector3 across = opening.axis.cross(opening.along);
  Magnified result;
  for (const double a : {-half, half})
    for (const double b : {-1.0, 1.0})
      result.points.push_back(opening.centre + a * opening.along + b * 0.5 * half * across);
  const double outwards = opening.axis.dot(opening.centre - middle);
  const bool turned = std::abs(outwards) > 0.01 ? outwards < 0.0 : opening.axis.z() < 0.0;
  const Vector3 towards = turned ? Vector3(-opening.axis) : opening.axis;
  constexpr double degrees = 57.29577951308232;
  result.direction = {std::atan2(towards.y(), towards.x()) * degrees + 12,
                      std::min(std::asin(std::clamp(towards.z(), -1.0, 1.0)) * degrees, 76.0) + 8};
  return result;
}

std::vector<Opening> openings_of(const ReportMaps& maps) {
  return maps.job.truth ? maps.job.truth->openings : std::vector<Opening>{};
}

/// The four columns of an object: its mesh, both maps, its cloud.
struct Columns {
  StepPicture picture, gibbs;
  SceneLayers layers[4] = {no_layers, no_layers, no_layers, no_layers};

  Columns(ReportScan& scan, const Refinement& maps) : picture(picture_after(scan, scan.states.size())) {
    picture.object_style = MeshStyle::solid;
    picture.point_size = 1.5;
    picture.voxels = maps.conventional.voxels().dense();
    gibbs = picture;
    gibbs.voxels = maps.refined.dense();
    layers[0].object = layers[1].map = layers[2].map = layers[3].cloud = true;
  }
  const StepPicture& at(int column) const { return column == 2 ? gibbs : picture; }
};

void draw_row(VectorDrawing& d, double top, double row_height, const Columns& columns, const FigurePaper& paper,
              const ViewDirection& direction, std::span<const Vector3> points) {
  for (int i = 0; i < 4; ++i)
    draw_scene_panel(d, {panel_margin + i * (width + panel_gap), top, width, row_height}, columns.at(i),
                     columns.layers[i], paper, direction, points);
}

}  // namespace

VectorDrawing maps_figure(std::span<ReportScan> scans, const FigurePaper& paper) {
  std::vector<std::shared_ptr<const ReportMaps>> all;
  double bottom = panel_top;
  for (ReportScan& scan : scans) {
    all.push_back(scan.maps());
    bottom += height + panel_gap + (openings_of(*all.back()).empty() ? 0.0 : magnified + panel_gap) + 30;
  }
  VectorDrawing d(2 * panel_margin + 4 * width + 3 * panel_gap, bottom + 20, paper.look);
  draw_title(d, "Objects and the maps of their scans");
  double top = panel_top + 22;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const Columns columns(scans[i], all[i]->refinement);
    const char* names[] = {"mesh", "conventional octree", "Gibbs octree", "aligned cloud"};
    for (int k = 0; k < 4; ++k)
      draw_heading(d, {panel_margin + k * (width + panel_gap), top, width, height},
                   k == 0 ? fmt::format("{}, {}", scans[i].name, counted(all[i]->job.scans.size(), "view")) : names[k]);
    draw_row(d, top, height, columns, paper, {}, points_around(columns.picture, false));
    top += height + panel_gap;
    if (const auto openings = openings_of(*all[i]); !openings.empty()) {
      const Magnified view = magnify(shown_opening(openings), columns.picture.object->bounding_box().center());
      draw_row(d, top, magnified, columns, paper, view.direction, view.points);
      top += magnified + panel_gap;
    }
    top += 30;
  }
  draw_voxel_key(d, bottom - 8);
  return d;
}

}  // namespace nextview
