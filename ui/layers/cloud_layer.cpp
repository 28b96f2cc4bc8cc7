#include "ui/layers/cloud_layer.hpp"

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include "ui/layers/geometry.hpp"

namespace nextview {

CloudLayer::CloudLayer(vtkRenderer& renderer)
    : Layer(renderer), mapper_(vtkSmartPointer<vtkPolyDataMapper>::New()), actor_(vtkSmartPointer<vtkActor>::New()) {
  mapper_->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->SetRenderPointsAsSpheres(true);
  actor_->GetProperty()->SetAmbient(0.35);
  set_colour(*actor_->GetProperty(), theme::cloud);
  add(*actor_);
}

void CloudLayer::show(const PointCloud& cloud, double point_size) {
  mapper_->SetInputDataObject(point_polydata(cloud));
  actor_->GetProperty()->SetPointSize(static_cast<float>(point_size));
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& point : cloud) box.extend(point.cast<double>());
  std::vector<Legend> legends;
  if (!cloud.empty()) legends.push_back({"", {{"measured points", theme::cloud}}, {}});
  describe(corners(box), std::move(legends));
}

}  // namespace nextview
