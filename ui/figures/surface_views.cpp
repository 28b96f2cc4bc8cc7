#include "ui/figures/surface_views.hpp"

#include <vtkContext2D.h>
#include <vtkGenericOpenGLRenderWindow.h>

namespace nextview {
namespace {

constexpr std::size_t framing_points = 20'000;  // at most about; as many leave no more than a hair of a surface out

/// Of the surface itself: its bounding box would leave much room around it.
std::vector<Vector3> points_to_frame(const TriangleMesh& mesh) {
  std::vector<Vector3> points;
  const std::size_t stride = mesh.vertices.size() / framing_points + 1;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += stride) points.push_back(mesh.vertices[i].cast<double>());
  if (points.empty()) points.push_back(Vector3::Zero());
  return points;
}

/// The scene as large as a panel. The target is so afterwards.
Image draw(RenderTarget& target, Scene& scene, std::span<const Vector3> points, const PageArea& panel,
           const std::string& heading, const ViewDirection& direction, bool legend) {
  target.window().SetSize(int(panel.width), int(panel.height));
  scene.set_caption(heading);
  scene.set_axes(true, legend);
  scene.set_legends(legend);
  scene.frame(points, direction);
  target.render();
  return target.read_back();
}

}  // namespace

SurfaceViews::SurfaceViews(RenderTarget& target, const TriangleMesh& mesh, const MeshPaint& paint,
                           const std::string& heading, const PageArea& large, const PageArea& other_side,
                           const PageArea& below) {
  const int width = target.width(), height = target.height();
  const std::vector<Vector3> points = points_to_frame(mesh);
  Scene scene;  // one for all: a surface may have a million triangles
  scene.attach(target);
  scene.mesh().show(mesh, paint);
  views_ = {View{large, draw(target, scene, points, large, heading, {-50, 24}, true)},
            View{other_side, draw(target, scene, points, other_side, "From the other side", {130, 24}, false)},
            View{below, draw(target, scene, points, below, "From below", {-50, -50}, false)}};
  target.window().SetSize(width, height);
}

void SurfaceViews::paint(vtkContext2D& context) const {
  Painter painter(context);
  for (const auto& [panel, image] : views_) {
    paint_image(context, panel.left, panel.bottom, image);
    painter.frame(panel.left - 1, panel.bottom - 1, panel.width + 2, panel.height + 2, theme::hairline);
  }
}

}  // namespace nextview
