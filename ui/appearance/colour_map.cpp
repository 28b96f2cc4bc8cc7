#include "ui/appearance/colour_map.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace nextview {
namespace {

/// OKLab (Ottosson 2020): linear sRGB to cone responses, and their cube roots to lightness and two opponent axes.
const Eigen::Matrix3d cones_from_rgb{{0.4122214708, 0.5363325363, 0.0514459929},
                                     {0.2119034982, 0.6806995451, 0.1073969566},
                                     {0.0883024619, 0.2817188376, 0.6299787005}};
const Eigen::Matrix3d lab_from_cones{{0.2104542553, 0.7936177850, -0.0040720468},
                                     {1.9779984951, -2.4285922050, 0.4505937099},
                                     {0.0259040371, 0.7827717662, -0.8086757660}};
const Eigen::Matrix3d rgb_from_cones = cones_from_rgb.inverse(), cones_from_lab = lab_from_cones.inverse();

double to_linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double to_srgb(double c) {
  c = std::clamp(c, 0.0, 1.0);
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

Colour from_lab(const Eigen::Vector3d& lab) {
  const Eigen::Vector3d cones = (cones_from_lab * lab).array().cube();
  const Eigen::Vector3d rgb = rgb_from_cones * cones;
  return {to_srgb(rgb.x()), to_srgb(rgb.y()), to_srgb(rgb.z())};
}

Eigen::Vector3d to_lab(const Colour& colour) {
  const Eigen::Vector3d rgb(to_linear(colour[0]), to_linear(colour[1]), to_linear(colour[2]));
  return lab_from_cones * (cones_from_rgb * rgb).array().pow(1.0 / 3).matrix();
}

/// White becomes a dark grey, ink nearly white; what lies between keeps its distance from both.
double turned_lightness(double lightness) { return std::min(1.196 - 0.986 * lightness, 0.97); }

}  // namespace

ColourMap ColourMap::score() { return ColourMap({{{0.93, 0.03, 310}, {0.645, 0.12, 305}, {0.36, 0.15, 300}}}); }
ColourMap ColourMap::contribution() { return ColourMap({{{0.87, 0.08, 85}, {0.635, 0.15, 55}, {0.40, 0.15, 25}}}); }
ColourMap ColourMap::probability() { return ColourMap({{{0.55, 0.11, 235}, {0.93, 0.02, 150}, {0.45, 0.10, 50}}}); }
ColourMap ColourMap::deviation() { return ColourMap({{{0.47, 0.16, 258}, {0.94, 0.0, 0}, {0.47, 0.17, 27}}}); }
ColourMap ColourMap::uncertainty() { return ColourMap({{{0.92, 0.02, 210}, {0.64, 0.11, 325}, {0.36, 0.15, 305}}}); }
ColourMap ColourMap::error() { return ColourMap({{{0.92, 0.02, 200}, {0.66, 0.13, 45}, {0.40, 0.16, 20}}}); }
ColourMap ColourMap::distance() { return ColourMap({{{0.79, 0.08, 200}, {0.59, 0.14, 45}, {0.37, 0.15, 20}}}); }
ColourMap ColourMap::height() { return ColourMap({{{0.34, 0.13, 300}, {0.57, 0.10, 215}, {0.80, 0.16, 130}}}); }
ColourMap ColourMap::order() { return ColourMap({{{0.84, 0.15, 90}, {0.605, 0.10, 175}, {0.37, 0.15, 280}}}); }

Colour ColourMap::at(double t) const {
  t = t > 0 ? std::min(t, 1.0) : 0.0;
  const Stop &a = stops_[t < 0.5 ? 0 : 1], &b = stops_[t < 0.5 ? 1 : 2];
  const double share = t < 0.5 ? 2 * t : 2 * t - 1;
  const auto lab = [](const Stop& s) {
    const double hue = s.hue * std::numbers::pi / 180;
    return Eigen::Vector3d(s.lightness, s.chroma * std::cos(hue), s.chroma * std::sin(hue));
  };
  return from_lab(lab(a) + share * (lab(b) - lab(a)));
}

Colour ColourMap::at(double value, double low, double high) const {
  return at(high > low ? (value - low) / (high - low) : 1.0);
}

double lightness(const Colour& colour) { return to_lab(colour).x(); }

Colour on_dark(const Colour& colour) {
  Eigen::Vector3d lab = to_lab(colour);
  lab.x() = turned_lightness(lab.x());
  return from_lab(lab);
}

ColourMap ColourMap::on_dark() const {
  ColourMap turned = *this;
  for (Stop& stop : turned.stops_) stop.lightness = turned_lightness(stop.lightness);
  return turned;
}

Colour mix(const Colour& a, const Colour& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

}  // namespace nextview
