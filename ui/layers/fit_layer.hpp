#pragma once
#include <span>

#include "ui/appearance/theme.hpp"
#include "ui/layers/layer.hpp"

class vtkActor;
class vtkPolyDataMapper;

namespace nextview {

/// Clouds in a colour each, to see whether they fit; what the colours mean is said beside the question.
class FitLayer : public Layer {
 public:
  struct Cloud {
    std::span<const Eigen::Vector3f> points;  ///< [m, world]
    Colour colour;
  };

  explicit FitLayer(vtkRenderer& renderer);

  void show(std::span<const Cloud> clouds);

 private:
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace nextview
