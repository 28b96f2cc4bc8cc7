#include "ui/layers/rays_layer.hpp"

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

#include "ui/layers/geometry.hpp"

namespace nextview {

namespace {

/// Opacity of a segment that contributes nothing: just enough to see where the rays go.
constexpr double faintest = 0.12;

}  // namespace

RaysLayer::RaysLayer(vtkRenderer& renderer)
    : Layer(renderer), mapper_(vtkSmartPointer<vtkPolyDataMapper>::New()), actor_(vtkSmartPointer<vtkActor>::New()) {
  mapper_->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->LightingOff();
  actor_->GetProperty()->SetLineWidth(1.3f);
  add(*actor_);
}

void RaysLayer::show(std::span<const RaySegment> segments, const RayValues& values) {
  double largest = 0.0;
  std::vector<Vector3> points;
  for (const RaySegment& segment : segments) {
    largest = std::max(largest, segment.value);
    points.insert(points.end(), {segment.from, segment.to});
  }
  const double high = values.high.value_or(largest);
  Geometry geometry;
  const ColourMap map = tone(ColourMap::contribution());
  for (const RaySegment& segment : segments) {
    const double share = high > 0 ? std::clamp(segment.value / high, 0.0, 1.0) : 0.0;
    // Mixed with the background, not translucent: VTK smooths the edges of opaque lines only.
    geometry.add_line(segment.from, segment.to,
                      mix(tone(theme::sky), map.at(share), faintest + (1 - faintest) * std::sqrt(share)));
  }
  mapper_->SetInputDataObject(geometry.polydata());
  std::vector<Legend> legends;
  if (!segments.empty()) {
    const std::string beyond = largest > high ? "and more" : "";
    legends.push_back(
        {values.name, {}, Legend::Range{map, 0.0, high, values.unit, "", beyond}, values.high.has_value()});
  }
  describe(std::move(points), std::move(legends));
}

}  // namespace nextview
