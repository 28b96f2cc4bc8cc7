#pragma once
#include "core/cloud/point_cloud.hpp"
#include "ui/layers/layer.hpp"

class vtkActor;
class vtkPolyDataMapper;

namespace nextview {

/// The measured points.
class CloudLayer : public Layer {
 public:
  explicit CloudLayer(vtkRenderer& renderer);

  void show(const PointCloud& cloud, double point_size = 2.5);  ///< point size in pixels

 private:
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace nextview
