#pragma once
#include <vtkContextItem.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "core/view/pose.hpp"
#include "ui/appearance/legend.hpp"

namespace nextview {

class Painter;
class SceneRenderer;

/// The flat part of a 3D scene: caption, orientation axes, scale bar, legends. Follows the renderer's camera.
class SceneOverlay : public vtkContextItem {
 public:
  static SceneOverlay* New();
  vtkTypeMacro(SceneOverlay, vtkContextItem)

      double legends_height() const;  ///< from the upper border [px at scale 1]
  double legends_begin() const;       ///< likewise
  Eigen::Vector2d axes_size() const;  ///< of the lower left corner that the axes take [px at scale 1]
  bool Paint(vtkContext2D* context) override;

  SceneRenderer* renderer = nullptr;          ///< whose camera is followed; it owns this item's scene
  bool backed = false;                        ///< paper lies behind the legends
  bool dark = false;                          ///< on dark paper
  std::string caption;                        ///< upper left
  std::vector<Legend> legends;                ///< upper right, from top to bottom
  double legend_size = 1.0;                   ///< of what they usually are
  std::vector<Label> labels;                  ///< beside their places
  Vector3 scale_reference = Vector3::Zero();  ///< where the scale bar is true [m, world]
  bool axes = true, scale_bar = true;
  double scale = 1.0;  ///< pixels of the display a pixel of the design

  /// So far from the upper right corner the legends reached when they were painted last [px at scale 1].
  const Eigen::Vector2d& legends_reach() const { return legends_reach_; }

 private:
  std::vector<Label> seen_labels() const;

  Eigen::Vector2d legends_reach_ = Eigen::Vector2d::Zero();
};

}  // namespace nextview
