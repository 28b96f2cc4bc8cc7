#include "ui/layers/region_layer.hpp"

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "core/config/object_lengths.hpp"
#include "core/setting/length_text.hpp"
#include "ui/layers/geometry.hpp"

namespace nextview {
namespace {

/// "1.28 m" for a cube, otherwise the three lengths.
std::string edges(const Eigen::AlignedBox3d& region) {
  const Vector3 size = region.sizes();
  const bool cube = (size.array() - size.x()).abs().maxCoeff() < 1e-9;
  return cube ? length_text(size.x()) : size_text(region);
}

}  // namespace

RegionLayer::RegionLayer(vtkRenderer& renderer)
    : Layer(renderer), mapper_(vtkSmartPointer<vtkPolyDataMapper>::New()), actor_(vtkSmartPointer<vtkActor>::New()) {
  mapper_->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->LightingOff();
  add(*actor_);
}

void RegionLayer::show(const Eigen::AlignedBox3d& region) {
  const std::vector<Vector3> points = corners(region);
  Geometry geometry;
  for (int from = 0; from < 8; ++from) {
    for (int axis = 0; axis < 3; ++axis) {
      const int to = from | 1 << axis;  // corners differ in one bit along each edge
      if (to != from) geometry.add_line(points.at(from), points.at(to), theme::region);
    }
  }
  mapper_->SetInputDataObject(geometry.polydata());
  describe(points, {}, {{points, "region of interest, " + edges(region), theme::soft_ink}});
}

}  // namespace nextview
