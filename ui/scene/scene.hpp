#pragma once
#include <array>
#include <memory>
#include <string>

#include "ui/drawing/viewport.hpp"
#include "ui/layers/cloud_layer.hpp"
#include "ui/layers/fit_layer.hpp"
#include "ui/layers/mesh_layer.hpp"
#include "ui/layers/octree_layer.hpp"
#include "ui/layers/rays_layer.hpp"
#include "ui/layers/region_layer.hpp"
#include "ui/layers/section_layer.hpp"
#include "ui/layers/views_layer.hpp"
#include "ui/render_target/render_target.hpp"
#include "ui/scene/camera_framing.hpp"

class vtkCamera;

namespace nextview {

class SceneRenderer;

/// A picture that somebody waits for takes less care.
enum class DrawingQuality {
  still,   ///< smooth edges
  quick,   ///< rough edges: where a processor draws, it takes a third of the time
  coarse,  ///< and where a processor draws, half of the pixels each way
  moving,  ///< and fewer voxels, if there are many: a fifth
};

/// Where the camera looks from, seen from what it looks at.
struct ViewDirection {
  double azimuth = -50.0;   ///< from the x axis towards the y axis [deg]
  double elevation = 24.0;  ///< above the horizon [deg]
};

/// One 3D picture: layers, light, background, orientation axes, scale bar and the legends of what is visible. z is up.
class Scene {
 public:
  static constexpr double vertical_angle = 28.0;  ///< of the picture [deg]: a long lens, little distortion

  Scene();
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Draws into this part of the target from now on. The target may go before the scene.
  void attach(RenderTarget& target, const Viewport& viewport = {});

  MeshLayer& mesh() { return *mesh_; }
  CloudLayer& cloud() { return *cloud_; }
  OctreeLayer& octree() { return *octree_; }
  ViewsLayer& views() { return *views_; }
  RaysLayer& rays() { return *rays_; }
  RegionLayer& region() { return *region_; }
  FitLayer& fit() { return *fit_; }
  MeshLayer& missed() { return *missed_; }    ///< the object, painted by what was seen of it; instead of mesh()
  MeshLayer& surface() { return *surface_; }  ///< reconstructed
  SectionLayer& section() { return *section_; }

  /// Cuts off what the section does not leave of object, surface and cloud; voxels are filtered where they are shown.
  void cut(const std::optional<Section>& section);
  /// On a dark ground from now on; layers that show values have to be shown again.
  void set_dark(bool dark);
  /// Without vanishing points: what is equally long is drawn so, wherever it is. What lies in the plane through a point
  /// [m, world] keeps its size.
  void set_orthographic(bool orthographic, const Vector3& point);

  void set_caption(const std::string& caption);
  void set_axes(bool axes, bool scale_bar);
  /// Pixels of the display per pixel of the design: 2 on a HiDPI display, 1 unless told otherwise. Lines, points, text
  /// and legends become as much larger.
  void set_scale(double scale);
  /// From the next drawing on. Edges are rough in the whole target then. Does nothing without a target.
  void set_quality(DrawingQuality quality);
  /// Whether paper lies behind the legends: for scenes that people move, where anything may come to lie there. It does
  /// not unless told otherwise.
  void set_backed(bool backed);
  /// Whether the layers' legends are shown, from the next annotate() on; they are unless told otherwise.
  void set_legends(bool legends) { legends_ = legends; }
  /// Whether framing leaves room for more legends, which come as a scan goes on; it does not unless told otherwise.
  void set_legends_to_come(bool to_come) { legends_to_come_ = to_come; }
  /// So far from the upper right corner the legends reached in the last drawing [px of the design].
  Eigen::Vector2d legends_reach() const;

  /// Whether framing leaves no room for axes and scale bar; it does unless told otherwise.
  void set_tight(bool tight) { tight_ = tight; }

  /// Frames all visible layers so that nothing is cut off or lies beneath a legend. Needs a target, for its
  /// proportions.
  void frame(const ViewDirection& direction = {});
  /// Points that enclose what is visible [m, world].
  std::vector<Vector3> outline() const;
  /// Frames these points [m, world].
  void frame(std::span<const Vector3> points, const ViewDirection& direction = {});

  /// So much of the lower end is covered by something else; framing keeps clear of it [px of the design].
  void set_covered_below(double height) { covered_below_ = height; }

  /// Where the camera stands, to come back to.
  struct Stand {
    vtkSmartPointer<vtkCamera> camera;
    Vector3 scale_reference = Vector3::Zero();
  };
  Stand stand() const;
  void restore(const Stand& stand);
  /// Where the camera stands once it has gone around the vertical axis through a point, from where it stood.
  void turn(const Stand& start, const Vector3& centre, double degrees);

  /// Takes over the layers' legends and labels; call it after layers changed. frame() does so too.
  void annotate();

  vtkRenderer& renderer();

 private:
  std::array<Layer*, 10> layers() const;  ///< in the order of their legends
  double legend_size() const;
  void drop_legends_without_room();
  void scale_layers();
  Vector3 camera_position(const Eigen::Matrix3d& R_world_camera, std::span<const Vector3> points) const;

  struct Overlay;
  bool legends_to_come_ = false;
  bool legends_ = true, tight_ = false;
  DrawingQuality quality_ = DrawingQuality::still;
  bool software_ = false;     ///< a processor draws
  double covered_below_ = 0;  ///< [px] of the design
  vtkSmartPointer<SceneRenderer> renderer_;
  std::unique_ptr<MeshLayer> mesh_;
  std::unique_ptr<CloudLayer> cloud_;
  std::unique_ptr<OctreeLayer> octree_;
  std::unique_ptr<ViewsLayer> views_;
  std::unique_ptr<RaysLayer> rays_;
  std::unique_ptr<RegionLayer> region_;
  std::unique_ptr<FitLayer> fit_;
  std::unique_ptr<MeshLayer> missed_, surface_;
  std::unique_ptr<SectionLayer> section_;
  std::unique_ptr<Overlay> overlay_;
};

}  // namespace nextview
