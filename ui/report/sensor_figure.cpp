#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/gibbs/forward_sensor_model.hpp"
#include "ui/report/scene_panel.hpp"
#include "ui/report/surface_plot.hpp"

namespace nextview {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// p(z) of a ray that is so much off the centre of the only occupied voxel [rad], which is at `centre` [m].
double density(const ForwardSensorModel& model, double z, double centre, double angle) {
  constexpr double resolution = 0.01, max_range = 1.5;  // [m]
  const VoxelGrid grid{resolution, Eigen::Vector3i::Zero(), Eigen::Vector3i::Ones()};
  const VoxelSegment segment{0, centre - 0.5 * resolution, centre + 0.5 * resolution};
  const Vector3 origin = grid.centre(0) - centre * Vector3::UnitX(), way(std::cos(angle), std::sin(angle), 0.0);
  return std::exp(first_hit_log_likelihood(grid, model, origin, way, &segment, z, max_range));
}

SurfacePlot paper_surface(ForwardSensorModel model) {
  model.kind = ForwardModel::paper;
  SurfacePlot plot;
  plot.title = "Eq. 1: along the ray";
  plot.note = fmt::format("σ = {:g} mm, voxels' centres", 1e3 * model.sigma);
  plot.x_label = "range z [mm]", plot.y_label = "z_exp [mm]", plot.z_label = "p(z | z_exp) [1/m]";
  plot.x_low = plot.y_low = 890, plot.x_high = plot.y_high = 910;
  plot.z_high = 200;
  plot.value = [model](double z, double expected) { return density(model, 1e-3 * z, 1e-3 * expected, 0.0); };
  return plot;
}

SurfacePlot cone_surface(ForwardSensorModel model) {
  model.kind = ForwardModel::cone;
  SurfacePlot plot;
  plot.title = "Eq. 2: along the ray and across it";
  plot.note = fmt::format("σ = {:g} mm, σ_φ = {:.2g}°; no density: 0.5 far behind", 1e3 * model.sigma,
                          model.angular_sigma / degree);
  const double wide = std::ceil(40.0 * model.angular_sigma / degree) / 10.0;
  plot.x_label = "range z [mm]", plot.y_label = "angle φ [°]", plot.z_label = "p(z, φ)";
  plot.x_low = 890, plot.x_high = 910, plot.y_low = -wide, plot.y_high = wide;
  plot.z_high = 0.6;
  plot.value = [model](double z, double angle) { return density(model, 1e-3 * z, 0.9, degree * angle); };
  return plot;
}

}  // namespace

VectorDrawing sensor_figure(std::span<ReportScan> scans, const FigurePaper& paper) {
  VectorDrawing drawing(1180, 440, paper.look);
  ReportScan& scan = scans.front();
  StepPicture picture = picture_after(scan, 1);
  picture.object_style = MeshStyle::solid;
  SceneLayers layers = no_layers;
  layers.object = layers.views = true;
  const DrawingArea scene{16, 64, 380, 360};
  const PinholeCamera& camera = picture.camera;
  const double angle = 2.0 * std::atan(0.5 * camera.width / camera.fx) / degree;
  draw_title(drawing, "The sensor: its frustum, and forward models of its ranges");
  draw_heading(drawing, scene, fmt::format("{} × {} pixels, {:.0f}° wide", camera.width, camera.height, angle));
  draw_scene_panel(drawing, scene, picture, layers, paper,
                   picture.chosen ? beside(picture.candidates.at(*picture.chosen)) : ViewDirection(),
                   points_around(picture, true));
  ForwardSensorModel model;
  model.voxel_range = VoxelRange::centre;
  model.angular_sigma = 0.002;
  draw_surface_plot(drawing, {420, 48, 370, 380}, paper_surface(model));
  draw_surface_plot(drawing, {800, 48, 370, 380}, cone_surface(model));
  return drawing;
}

}  // namespace nextview
