#include "ui/figures/scene_figure.hpp"

#include <vtkRenderer.h>

#include <algorithm>
#include <numbers>

#include "ui/figures/session_figure.hpp"

namespace nextview {
namespace {

/// The points as they are seen from all around: framed, they leave room for every frame of a turn.
std::vector<Vector3> swept(const std::vector<Vector3>& points, const Vector3& centre) {
  constexpr int directions = 72;
  double radius = 0.0, low = centre.z(), high = low;
  for (const Vector3& p : points) {
    radius = std::max(radius, (p - centre).head<2>().norm());
    low = std::min(low, p.z()), high = std::max(high, p.z());
  }
  std::vector<Vector3> all;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * i / directions;
    for (const double z : {low, high})
      all.emplace_back(centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle), z);
  }
  return all;
}

/// All candidates but the chosen one.
std::vector<std::size_t> others(const StepPicture& picture) {
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < picture.candidates.size(); ++i)
    if (i != picture.chosen) others.push_back(i);
  return others;
}

}  // namespace

struct SceneFigure::Parts {
  Parts(RenderTarget& target, const PictureSize& size) : apart(target, {&scene.renderer()}, size) {
    scene.attach(target);
  }

  Scene scene;
  DrawnApart apart;
  Vector3 centre = Vector3::Zero();
};

SceneFigure::SceneFigure(RenderTarget& target, const Session& session, const SceneLayers& layers,
                         const PictureSize& size)
    : SceneFigure(target, step_picture(session), layers, size, picture_scale(size)) {}

SceneFigure::SceneFigure(RenderTarget& target, const StepPicture& picture, const SceneLayers& layers,
                         const PictureSize& size, double scale)
    : parts_(std::make_unique<Parts>(target, size)) {
  Scene& scene = parts_->scene;
  scene.set_scale(scale);
  scene.set_dark(layers.dark);
  scene.set_legends(layers.annotated);
  scene.set_axes(layers.annotated, layers.annotated);
  scene.set_tight(!layers.annotated);
  if (picture.object) scene.mesh().show(*picture.object, picture.object_style);
  scene.cloud().show(picture.cloud, picture.point_size);
  scene.octree().show(picture.grid, picture.voxels);
  scene.rays().show(picture.rays, picture.ray_values);
  ViewsPicture views = views_of(picture);
  views.numbered_path = true;
  const std::vector<std::size_t> hidden = layers.candidates ? std::vector<std::size_t>{} : others(picture);
  views.hidden = hidden;
  if (!layers.candidates) views.path = {};
  scene.views().show(views);
  scene.region().show({picture.grid.lower(), picture.grid.upper()});
  scene.mesh().set_visible(layers.object);
  scene.cloud().set_visible(layers.cloud);
  scene.octree().set_visible(layers.map);
  scene.rays().set_visible(layers.rays);
  scene.views().set_visible(layers.views);
  scene.region().set_visible(layers.region);
  scene.annotate();
  parts_->centre = 0.5 * (picture.grid.lower() + picture.grid.upper());
}

SceneFigure::~SceneFigure() = default;

Image SceneFigure::draw(const ViewDirection& direction, bool transparent) {
  parts_->scene.set_backed(!transparent);
  parts_->scene.frame(direction);
  return parts_->apart.draw(transparent);
}

Image SceneFigure::draw(const ViewDirection& direction, std::span<const Vector3> points) {
  parts_->scene.frame(points, direction);
  return parts_->apart.draw(false);
}

Image SceneFigure::draw_turned(const ViewDirection& start, int frame, int count, bool transparent) {
  Scene& scene = parts_->scene;
  scene.set_backed(!transparent);
  scene.frame(swept(scene.outline(), parts_->centre), start);
  scene.turn(scene.stand(), parts_->centre, 360.0 * frame / count);
  return parts_->apart.draw(transparent);
}

}  // namespace nextview
