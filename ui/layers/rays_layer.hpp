#pragma once
#include <optional>
#include <string>

#include "ui/layers/layer.hpp"

class vtkActor;
class vtkPolyDataMapper;

namespace nextview {

/// A piece of a ray with the value to colour it by, for example the entropy it meets.
struct RaySegment {
  Vector3 from, to;  ///< [m, world]
  double value = 0.0;
  std::size_t index = 0;  ///< of the ray, for whoever asks which one is at a place
};

/// What the values of ray segments are, for the legend.
struct RayValues {
  std::string name = "information along rays";
  std::string unit;
  std::optional<double> high = {};  ///< upper end of the colours, locked; the largest value if not given
};

/// Rays of a view, coloured from 0 to the largest value or a locked end. What has no value (0) is nearly clear.
class RaysLayer : public Layer {
 public:
  explicit RaysLayer(vtkRenderer& renderer);

  void show(std::span<const RaySegment> segments, const RayValues& values);

 private:
  vtkSmartPointer<vtkPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace nextview
