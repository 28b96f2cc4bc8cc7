#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/config/gibbs_config.hpp"
#include "ui/report/scene_panel.hpp"
#include "ui/report/surface_plot.hpp"

namespace nextview {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The camera of a scan as Eqs. 1 and 2 see it, and what it looks at.
struct RangeModel {
  ForwardSensorModel model;
  double resolution;  ///< voxel edge [m]
  double distance;    ///< of the only occupied voxel's centre, where there is one [m]
  double max_range;   ///< [m]
};

RangeModel range_model(const Configuration& c, double distance) {
  ForwardSensorModel model =
      posterior_sampler_config(c.gibbs, c.sensor.range_noise, ray_pitch(c.sensor), c.map.resolution, 0).model;
  model.voxel_range = VoxelRange::centre;
  return {model, c.map.resolution, distance, c.sensor.max_range};
}

/// p(z) of a ray that is so much off the centre of the only occupied voxel [rad], which is at `centre` [m].
double density(const RangeModel& m, double z, double centre, double angle) {
  const VoxelGrid grid{m.resolution, Eigen::Vector3i::Zero(), Eigen::Vector3i::Ones()};
  const VoxelSegment segment{0, centre - 0.5 * m.resolution, centre + 0.5 * m.resolution};
  const Vector3 origin = grid.centre(0) - centre * Vector3::UnitX(), way(std::cos(angle), std::sin(angle), 0.0);
  return std::exp(first_hit_log_likelihood(grid, m.model, origin, way, &segment, z, m.max_range));
}

/// With one digit that is not 0, and not below the value.
double rounded_up(double value) {
  const double step = std::pow(10.0, std::floor(std::log10(value)));
  return step * std::ceil(value / step);
}

/// Ranges within 5 sigma of the voxel [mm].
void show_ranges(SurfacePlot& plot, const RangeModel& m) {
  plot.x_label = "range z [mm]";
  plot.x_low = 1e3 * (m.distance - 5.0 * m.model.sigma), plot.x_high = 1e3 * (m.distance + 5.0 * m.model.sigma);
}

SurfacePlot paper_surface(RangeModel m) {
  m.model.kind = ForwardModel::paper;
  SurfacePlot plot;
  plot.title = "Eq. 1: along the ray";
  plot.note = fmt::format("σ = {:.3g} mm, voxels' centres", 1e3 * m.model.sigma);
  show_ranges(plot, m);
  plot.y_low = plot.x_low, plot.y_high = plot.x_high;
  plot.y_label = "z_exp [mm]", plot.z_label = "p(z | z_exp) [1/m]";
  plot.z_high = rounded_up(density(m, m.distance, m.distance, 0.0));
  plot.value = [m](double z, double expected) { return density(m, 1e-3 * z, 1e-3 * expected, 0.0); };
  return plot;
}

SurfacePlot cone_surface(RangeModel m) {
  m.model.kind = ForwardModel::cone;
  SurfacePlot plot;
  plot.title = "Eq. 2: along the ray and across it";
  plot.note = fmt::format("σ = {:.3g} mm, σ_φ = {:.2g}°; no density: 0.5 far behind", 1e3 * m.model.sigma,
                          m.model.angular_sigma / degree);
  const double wide = rounded_up(4.0 * m.model.angular_sigma / degree);
  show_ranges(plot, m);
  plot.y_label = "angle φ [°]", plot.z_label = "p(z, φ)";
  plot.y_low = -wide, plot.y_high = wide;
  plot.z_high = 0.6;
  plot.value = [m](double z, double angle) { return density(m, 1e-3 * z, m.distance, degree * angle); };
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
  const Vector3 middle = 0.5 * (picture.grid.lower() + picture.grid.upper());
  const RangeModel model =
      range_model(scan.session->configuration(), (picture.path.front().translation() - middle).norm());
  draw_surface_plot(drawing, {408, 48, 362, 380}, paper_surface(model));
  draw_surface_plot(drawing, {802, 48, 362, 380}, cone_surface(model));
  return drawing;
}

}  // namespace nextview
