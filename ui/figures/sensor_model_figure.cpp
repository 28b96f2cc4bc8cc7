#include "ui/figures/sensor_model_figure.hpp"

#include <fmt/format.h>
#include <vtkContext2D.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/setting/length_text.hpp"
#include "ui/charts/curve_plot.hpp"

namespace nextview {
namespace {

/// A row of voxels along the x axis from the camera to the maximum range; the ray runs through their centres.
class Ray {
 public:
  Ray(const SensorModelPicture& picture, ForwardModel kind) : model_(picture.model) {
    model_.kind = kind;
    grid_.resolution = picture.resolution;
    grid_.size = {static_cast<int>(std::ceil(picture.max_range / picture.resolution - 1e-9)), 1, 1};
    measurements_.max_range = picture.max_range;
    measurements_.origins = {{0.0, 0.5 * picture.resolution, 0.5 * picture.resolution}};
    surface_ = static_cast<std::uint32_t>(std::lround(picture.surface / picture.resolution));
  }

  const ForwardSensorModel& model() const { return model_; }
  double enter() const { return surface_ * grid_.resolution; }
  double exit() const { return (surface_ + 1) * grid_.resolution; }
  double max_range() const { return measurements_.max_range; }

  /// log p(z | the surface's voxel has this level, all others are free).
  double log_range(int level, double z) const {
    if (model_.is_first_hit()) return log_first_hit(level, z);
    return log_likelihood(grid_, model_, measurements_, measurement(z, false), levels(level));
  }
  double log_beyond_range(int level) const {
    if (model_.is_first_hit()) return log_first_hit(level, max_range());
    return log_likelihood(grid_, model_, measurements_, measurement(max_range(), true), levels(level));
  }
  /// Over all ranges up to the maximum.
  double integral(int level) const {
    const double step = std::min(1e-4, model_.sigma / 20);  // [m]
    double sum = 0.0;
    for (double z = 0.5 * step; z < max_range(); z += step) sum += step * std::exp(log_range(level, z));
    return sum;
  }

 private:
  /// Asked directly and not of the whole ray, which leaves out voxels that are farther than 4 sigma behind z.
  double log_first_hit(int level, double z) const {
    const nextview::VoxelSegment segment{surface_, enter(), exit()};
    return first_hit_log_likelihood(grid_, model_, measurements_.origins[0], Vector3::UnitX(),
                                    level > 0 ? &segment : nullptr, z, max_range());
  }
  RangeMeasurement measurement(double z, bool beyond_range) const {
    const Vector3 end = measurements_.origins[0] + z * Vector3::UnitX();
    return {end.cast<float>(), 0, 1, beyond_range};
  }
  std::vector<std::uint8_t> levels(int level) const {
    std::vector<std::uint8_t> all(grid_.voxel_count(), 0);
    all[surface_] = static_cast<std::uint8_t>(level);
    return all;
  }

  ForwardSensorModel model_;
  VoxelGrid grid_;
  RangeMeasurements measurements_;
  std::uint32_t surface_ = 0;
};

constexpr double mm_per_m = 1e3;  // ranges are drawn in mm

Curve curve_of(const Ray& ray, int level, const std::string& name, const Colour& colour, const CurvePlot& plot) {
  constexpr int steps = 600;
  Curve curve{name, {}, {}, {}, colour};
  for (int i = 0; i <= steps; ++i) {
    const double z = plot.x_low + (plot.x_high - plot.x_low) * i / steps;
    curve.x.push_back(z);
    curve.y.push_back(std::exp(ray.log_range(level, z / mm_per_m)));
  }
  return curve;
}

/// "10⁻¹⁹²¹⁷" for what no double holds.
std::string power_of_ten(double logarithm) {
  constexpr std::array digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const auto exponent = std::lround(logarithm / std::numbers::ln10);
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[digit - '0'];
  return text;
}

/// What the curve adds up to, and what it leaves to 'beyond range'.
std::vector<std::string> sums(const Ray& ray, int level, const std::string& sum_unit, const std::string& unit) {
  const double beyond = ray.log_beyond_range(level);
  const std::string value = beyond < -10.0 ? power_of_ten(beyond) : fmt::format("{:.2f}", std::exp(beyond));
  return {fmt::format("all ranges: {:.2f}{}", ray.integral(level), sum_unit),
          fmt::format("beyond range: {}{}", value, unit)};
}

/// The next power of ten over the densest range of all: that of Eq. 1 where it expects the range.
double above_all_densities(const ForwardSensorModel& model) {
  return std::pow(10.0, std::ceil(-std::log10(model.sigma * std::sqrt(2.0 * std::numbers::pi))));
}

CurvePlot plot_of(const Ray& ray, const std::string& title, const std::string& remark, const std::string& y_label,
                  double y_high) {
  CurvePlot plot;
  plot.title = title;
  plot.remark = remark;
  plot.x_label = "range z [mm]";
  plot.y_label = y_label;
  const double resolution = ray.exit() - ray.enter();
  plot.x_low = mm_per_m * (ray.enter() - 2.0 * resolution);
  plot.x_high = mm_per_m * (ray.exit() + 2.0 * resolution);
  plot.logarithmic_y = true;
  plot.y_low = 1e-3;
  plot.y_high = y_high;
  plot.names_width = 188;
  plot.parts = {{mm_per_m * ray.enter(), mm_per_m * ray.exit(), "voxel", true}};
  return plot;
}

/// paper, cone: without an occupied voxel the ray is expected to go to the maximum range.
CurvePlot first_hit_plot(const Ray& ray, CurvePlot plot, const std::string& sum_unit, const std::string& unit) {
  plot.curves = {curve_of(ray, 1, "occupied", theme::series[0], plot), curve_of(ray, 0, "free", theme::region, plot)};
  plot.curves[0].details = sums(ray, 1, sum_unit, unit);
  plot.curves[1].details = {fmt::format("expects z = {}:", length_text(ray.max_range())), "below the axis here"};
  return plot;
}

CurvePlot mixture_plot(const Ray& ray, CurvePlot plot) {
  for (int level = ray.model().levels() - 1; level >= 0; --level) {
    const bool attenuates = ray.model().kind == ForwardModel::attenuation;
    const std::string name = level == 0   ? "free"
                             : attenuates ? fmt::format("κ = {:g} per voxel", ray.model().attenuations[level - 1])
                                          : "occupied";
    const Colour colour = level == 0 ? theme::region : theme::series[(level - 1) % theme::series.size()];
    plot.curves.push_back(curve_of(ray, level, name, colour, plot));
    plot.curves.back().details = sums(ray, level, "", "");
  }
  return plot;
}

std::array<CurvePlot, 4> plots_of(const SensorModelPicture& picture) {
  const Ray paper(picture, ForwardModel::paper), cone(picture, ForwardModel::cone), beam(picture, ForwardModel::beam),
      attenuation(picture, ForwardModel::attenuation);
  const double high = above_all_densities(picture.model);
  const std::string density = "p(z) [1/m]", proper = "a density: all ranges and beyond range add up to 1";
  return {
      first_hit_plot(paper, plot_of(paper, "paper (Eq. 1)", "a density without a floor for outliers", density, high),
                     "", " /m"),
      first_hit_plot(cone, plot_of(cone, "cone (Eq. 2)", "no density: 0.5 far behind the voxel", "p(z)", 1e1), " m",
                     ""),
      mixture_plot(beam, plot_of(beam, "beam", proper, density, high)),
      mixture_plot(attenuation, plot_of(attenuation, "attenuation", proper, density, high))};
}

void check(const SensorModelPicture& picture) {
  picture.model.validate();
  if (!(picture.resolution > 0.0 && picture.surface >= 0.0 &&
        picture.surface + 1.5 * picture.resolution <= picture.max_range))
    throw std::invalid_argument(fmt::format("sensor model figure: no voxel of {} m at {} m within the range of {} m",
                                            picture.resolution, picture.surface, picture.max_range));
}

}  // namespace

Image draw_sensor_model_figure(RenderTarget& target, const SensorModelPicture& picture) {
  constexpr int width = 1200, height = 700;
  check(picture);
  const auto plots = plots_of(picture);
  const std::string remark =
      fmt::format("σ = {:g} mm, voxels of {:g} mm", 1e3 * picture.model.sigma, 1e3 * picture.resolution);
  const std::string caption = fmt::format(
      "What each model says of a range z when the first occupied voxel on the ray begins at {0}: as it is, not "
      "normalised. All ranges: its integral from 0 to {1}. Beyond range: what it gives to no return (paper and "
      "cone: p({1}), our reading).",
      length_text(picture.surface), length_text(picture.max_range));
  return draw_page(target, {width, height}, [&](vtkContext2D& context) {
    Painter painter(context);
    const double top = height - paint_title(painter, width, height, "Forward sensor models", remark, caption);
    const double panel_width = std::floor((width - 3 * page_margin) / 2);
    const double panel_height = std::floor((top - 3 * page_margin) / 2);
    for (int i = 0; i < 4; ++i)
      paint_curve_plot(context,
                       {page_margin + i % 2 * (panel_width + page_margin),
                        page_margin + (1 - i / 2) * (panel_height + page_margin), panel_width, panel_height},
                       plots[i]);
  });
}

}  // namespace nextview
