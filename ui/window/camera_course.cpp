#include "ui/window/camera_course.hpp"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/window/camera_control.hpp"

namespace nextview {
namespace {

constexpr double radians = std::numbers::pi / 180;

/// The short way round.
double near_to(double angle, double other) { return other + std::remainder(angle - other, 2 * std::numbers::pi); }

}  // namespace

CameraCourse::Place CameraCourse::place_of(SceneView& view) {
  vtkCamera& camera = *view.renderer().GetActiveCamera();
  Place place;
  place.focus = Vector3(camera.GetFocalPoint());
  const Vector3 out = Vector3(camera.GetPosition()) - place.focus;
  place.distance = std::max(out.norm(), 1e-6);
  place.azimuth = std::atan2(out.y(), out.x());
  place.elevation = std::asin(std::clamp(out.z() / place.distance, -1.0, 1.0));
  place.angle = camera.GetViewAngle();
  return place;
}

CameraCourse::CameraCourse(SceneView& view, const CameraFlight& flight)
    : end_(view.layers().stand()), from_(place_of(view)), to_(from_) {
  if (flight.relative) {
    to_.azimuth += flight.azimuth * radians;
    to_.elevation = std::clamp(to_.elevation + flight.elevation * radians, -max_elevation, max_elevation);
    return;
  }
  const Scene::Stand start = end_;
  view.move(camera_motion::LookFrom{flight.azimuth, flight.elevation});
  end_ = view.layers().stand();
  to_ = place_of(view);
  to_.azimuth = near_to(to_.azimuth, from_.azimuth);
  to_.distance /= flight.zoom;
  to_.focus = flight.focus.value_or(to_.focus);
  view.layers().restore(start);
}

CameraFlight CameraCourse::flight_to_here(SceneView& view) {
  const Scene::Stand start = view.layers().stand();
  const Place here = place_of(view);
  const double azimuth = here.azimuth / radians,
               elevation = std::clamp(here.elevation, -max_elevation, max_elevation) / radians;
  view.move(camera_motion::LookFrom{azimuth, elevation});
  const double framed = place_of(view).distance;
  view.layers().restore(start);
  const auto rounded = [](double value) { return std::round(1e4 * value) / 1e4; };
  CameraFlight flight{false, rounded(azimuth), rounded(elevation),
                      std::clamp(rounded(framed / here.distance), 0.01, 100.0)};
  flight.focus = here.focus.unaryExpr(rounded);
  return flight;
}

void CameraCourse::stand(SceneView& view, double share) const {
  const auto between = [&](double a, double b) { return a + share * (b - a); };
  const double azimuth = between(from_.azimuth, to_.azimuth), elevation = between(from_.elevation, to_.elevation);
  const double distance = std::exp(between(std::log(from_.distance), std::log(to_.distance)));
  const Vector3 focus = from_.focus + share * (to_.focus - from_.focus);
  const Vector3 position = focus + distance * Vector3(std::cos(elevation) * std::cos(azimuth),
                                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  view.layers().restore(end_);
  vtkCamera& camera = *view.renderer().GetActiveCamera();
  camera.SetFocalPoint(focus.data());
  camera.SetPosition(position.data());
  camera.SetViewUp(0, 0, 1);
  camera.SetViewAngle(between(from_.angle, to_.angle));
  view.renderer().ResetCameraClippingRange();
}

}  // namespace nextview
