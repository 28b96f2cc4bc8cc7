#pragma once
#include <string>

#include "ui/charts/page.hpp"
#include "ui/scene/scene.hpp"

namespace nextview {

/// A painted surface from three sides. The pictures are drawn before the page they stand on: one picture cannot be
/// begun within another.
class SurfaceViews {
 public:
  /// `large` has the heading, the legend and the scale bar. Each is drawn in the target, which is as large as it was
  /// afterwards.
  SurfaceViews(RenderTarget& target, const TriangleMesh& mesh, const MeshPaint& paint, const std::string& heading,
               const PageArea& large, const PageArea& other_side, const PageArea& below);

  void paint(vtkContext2D& context) const;

 private:
  struct View {
    PageArea panel;
    Image image;
  };
  std::array<View, 3> views_;
};

}  // namespace nextview
