#include "ui/layers/views_layer.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "ui/layers/geometry.hpp"

namespace nextview {
namespace {

struct Frustum {
  Vector3 apex;
  std::array<Vector3, 4> base;  ///< around the image's border

  Frustum(const PinholeCamera& camera, const Pose& T_world_camera, double depth) : apex(T_world_camera.translation()) {
    const double right = camera.width - 0.5, bottom = camera.height - 0.5;  // pixel centres are at whole numbers
    const std::array<Eigen::Vector2d, 4> pixels{{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}}};
    for (int i = 0; i < 4; ++i) {
      const Vector3 direction = camera.direction(pixels[i].x(), pixels[i].y());
      base[i] = T_world_camera * Vector3(direction * (depth / direction.z()));
    }
  }

  void add_faces(Geometry& geometry, const Colour& colour, bool with_base) const {
    for (int i = 0; i < 4; ++i) geometry.add_triangle(apex, base[i], base[(i + 1) % 4], colour);
    if (!with_base) return;
    geometry.add_triangle(base[0], base[1], base[2], colour);
    geometry.add_triangle(base[0], base[2], base[3], colour);
  }

  void add_outline(Geometry& geometry, const Colour& colour) const {
    for (int i = 0; i < 4; ++i) {
      geometry.add_line(apex, base[i], colour);
      geometry.add_line(base[i], base[(i + 1) % 4], colour);
    }
  }
};

void check(const ViewsPicture& picture) {
  if (!picture.scores.empty() && picture.scores.size() != picture.candidates.size()) {
    throw std::invalid_argument(
        fmt::format("scores: {} for {} candidates", picture.scores.size(), picture.candidates.size()));
  }
  const auto beyond = [&](std::size_t index) { return index >= picture.candidates.size(); };
  if (std::ranges::any_of(picture.taken, beyond) || std::ranges::any_of(picture.unreachable, beyond)) {
    throw std::invalid_argument("taken, unreachable: an index is no candidate's");
  }
  if (picture.range && !(picture.range->first < picture.range->second)) {
    throw std::invalid_argument("the scores' range is empty");
  }
  if (picture.chosen && beyond(*picture.chosen)) throw std::invalid_argument("chosen: the index is no candidate's");
}

struct Scores {
  double low = 0.0, high = 0.0;       ///< of the colours
  bool below = false, above = false;  ///< some scores are beyond these
  bool any = false;                   ///< some candidate is left to have one
  bool drawn = false;                 ///< ... and is drawn in its colour

  ColourMap map;
  std::vector<bool> taken, unreachable, hidden;

  Scores(const ViewsPicture& picture, const ColourMap& of_scores)
      : map(of_scores), taken(picture.candidates.size(), false), unreachable(taken), hidden(taken) {
    for (const std::size_t index : picture.taken) taken[index] = true;
    for (const std::size_t index : picture.unreachable) unreachable[index] = true;
    for (const std::size_t index : picture.hidden) hidden.at(index) = true;
    for (std::size_t i = 0; i < picture.scores.size(); ++i) {
      if (taken[i] || unreachable[i]) continue;
      drawn |= !hidden[i] && (picture.chosen != i || picture.custom_view);
      low = any ? std::min(low, picture.scores[i]) : picture.scores[i];
      high = any ? std::max(high, picture.scores[i]) : picture.scores[i];
      any = true;
    }
    if (!picture.range) return;
    below = low < picture.range->first;
    above = high > picture.range->second;
    std::tie(low, high) = *picture.range;
  }

  Colour colour(const ViewsPicture& picture, std::size_t candidate) const {
    if (picture.chosen == candidate && !picture.custom_view) return theme::chosen;
    if (taken[candidate]) return theme::muted;
    if (unreachable[candidate]) return theme::unreachable;
    return picture.scores.empty() ? theme::object : map.at(picture.scores[candidate], low, high);
  }
};

std::vector<Legend> legends_of(const ViewsPicture& picture, const Scores& scores) {
  if (picture.candidates.empty() && picture.path.empty() && !picture.custom_view) return {};
  Legend views{"views", {}, {}};
  if (picture.chosen && !picture.custom_view) views.swatches.push_back({"chosen", theme::chosen});
  if (picture.custom_view) views.swatches.push_back({"custom view", theme::chosen});
  if (!picture.taken.empty()) views.swatches.push_back({"taken", theme::muted});
  if (!picture.unreachable.empty()) views.swatches.push_back({"not reachable", theme::unreachable});
  if (picture.scores.empty() && picture.hidden.size() < picture.candidates.size())
    views.swatches.push_back({"candidate", theme::object});
  std::vector<Legend> result;
  if (scores.drawn || (scores.any && picture.range)) {  // of a locked one it is to be seen that it is
    result.push_back({picture.score_name,
                      {},
                      Legend::Range{scores.map, scores.low, scores.high, picture.score_unit,
                                    scores.below ? "and less" : "", scores.above ? "and more" : ""},
                      picture.range.has_value()});
  }
  if (!views.swatches.empty()) result.push_back(views);
  return result;
}

}  // namespace

double frustum_depth(std::span<const Pose> candidates, const Vector3& target) {
  constexpr double share = 0.07 / 0.9;
  if (candidates.empty()) return ViewsPicture().size;
  double way = 0.0;
  for (const Pose& candidate : candidates) way += (candidate.translation() - target).norm();
  return share * way / double(candidates.size());
}

bool stands_at(const Vector3& eye, const Vector3& camera, double depth) {
  const double near = depth * 2.0 / 7.0;
  return (eye - camera).squaredNorm() < near * near;
}

ViewsLayer::ViewsLayer(vtkRenderer& renderer)
    : Layer(renderer),
      frustums_(make_part(1.0, 1.0)),
      outlines_(make_part(1.0, 1.0)),
      path_(make_part(2.0, 1.0)),
      chosen_faces_(make_part(1.0, 0.06)),
      chosen_outline_(make_part(2.0, 1.0)) {}

ViewsLayer::Part ViewsLayer::make_part(double line_width, double opacity) {
  Part part{vtkSmartPointer<vtkPolyDataMapper>::New(), vtkSmartPointer<vtkActor>::New()};
  part.mapper->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  part.actor->SetMapper(part.mapper);
  part.actor->GetProperty()->LightingOff();  // a colour is a score here, so light must not change it
  part.actor->GetProperty()->SetLineWidth(static_cast<float>(line_width));
  part.actor->GetProperty()->SetOpacity(opacity);
  add(*part.actor);
  return part;
}

void ViewsLayer::show(const ViewsPicture& picture) {
  check(picture);
  const Scores scores(picture, tone(ColourMap::score()));
  Geometry frustums, outlines, path;
  std::vector<Vector3> points;
  std::vector<Label> labels;
  const auto at_eye = [&](const Pose& view) {
    return picture.eye && stands_at(*picture.eye, view.translation(), picture.size);
  };
  // Hidden by the object as its frustum is, but not by that frustum.
  const auto number = [&](const Vector3& place, std::size_t n) {
    return Label{{place}, std::to_string(n), theme::soft_ink, false, 2 * picture.size};
  };
  for (std::size_t i = 0; i < picture.candidates.size(); ++i) {
    if (scores.hidden[i]) continue;
    const Frustum frustum(picture.camera, picture.candidates[i], picture.size);
    const Colour colour = scores.colour(picture, i);
    if (!at_eye(picture.candidates[i])) {
      // Of those that were taken the edges do: they are not to stand before the object.
      if (!scores.taken[i] || picture.chosen == i) frustum.add_faces(frustums, colour, true);
      frustum.add_outline(outlines, scores.taken[i] ? colour : mix(colour, tone(theme::ink), 0.45));
    }
    if (std::ranges::find(picture.numbered, i) != picture.numbered.end()) labels.push_back(number(frustum.apex, i));
    points.push_back(frustum.apex);
    points.insert(points.end(), frustum.base.begin(), frustum.base.end());
  }
  for (std::size_t i = 0; i < picture.path.size(); ++i) {
    points.push_back(picture.path[i].translation());
    if (at_eye(picture.path[i])) continue;
    if (i > 0 && !at_eye(picture.path[i - 1]))
      path.add_line(picture.path[i - 1].translation(), points.back(), theme::muted);
    if (picture.numbered_path) labels.push_back(number(points.back(), i + 1));
  }
  const Pose* full = picture.custom_view ? &*picture.custom_view
                     : picture.chosen    ? &picture.candidates[*picture.chosen]
                                         : nullptr;
  if (full) points.push_back(full->translation());
  if (full && !picture.eye) {  // who looks through a view looks at what it sees
    show_full_frustum(picture, *full);
    const std::string name = picture.custom_view ? "custom view" : fmt::format("candidate {}", *picture.chosen);
    labels.push_back({{full->translation()}, name, theme::chosen, true});
  } else {
    for (Part* part : {&chosen_faces_, &chosen_outline_})
      part->mapper->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  }
  frustums_.mapper->SetInputDataObject(frustums.polydata());
  outlines_.mapper->SetInputDataObject(outlines.polydata());
  path_.mapper->SetInputDataObject(path.polydata());
  describe(std::move(points), legends_of(picture, scores), std::move(labels));
}

void ViewsLayer::show_full_frustum(const ViewsPicture& picture, const Pose& T_world_camera) {
  Geometry faces, outline;
  const Frustum frustum(picture.camera, T_world_camera, picture.reach);
  frustum.add_faces(faces, theme::chosen, false);
  frustum.add_outline(outline, theme::chosen);
  chosen_faces_.mapper->SetInputDataObject(faces.polydata());
  chosen_outline_.mapper->SetInputDataObject(outline.polydata());
}

}  // namespace nextview
