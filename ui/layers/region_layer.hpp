#pragma once
#include <string>

#include "ui/layers/layer.hpp"

class vtkActor;
class vtkPolyDataMapper;

namespace nextview {

/// The region of interest as a box, labelled with its edges' lengths.
class RegionLayer : public Layer {
 public:
  explicit RegionLayer(vtkRenderer& renderer);

  void show(const Eigen::AlignedBox3d& region);

 private:
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace nextview
