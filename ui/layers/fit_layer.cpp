#include "ui/layers/fit_layer.hpp"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

#include "ui/layers/geometry.hpp"

namespace nextview {

FitLayer::FitLayer(vtkRenderer& renderer)
    : Layer(renderer), mapper_(vtkSmartPointer<vtkPolyDataMapper>::New()), actor_(vtkSmartPointer<vtkActor>::New()) {
  mapper_->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->SetRenderPointsAsSpheres(true);
  actor_->GetProperty()->SetAmbient(0.5);
  actor_->GetProperty()->SetPointSize(2.5f);
  add(*actor_);
}

void FitLayer::show(std::span<const Cloud> clouds) {
  std::vector<Eigen::Vector3f> points;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  Eigen::AlignedBox3d box;
  for (const Cloud& cloud : clouds) {
    for (const Eigen::Vector3f& point : cloud.points) {
      points.push_back(point);
      box.extend(point.cast<double>());
      for (const double channel : cloud.colour)
        colours->InsertNextValue(static_cast<unsigned char>(std::lround(channel * 255)));
    }
  }
  const auto polydata = point_polydata(points);
  polydata->GetPointData()->SetScalars(colours);
  mapper_->SetInputDataObject(polydata);
  describe(corners(box), {});
}

}  // namespace nextview
