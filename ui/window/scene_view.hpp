#pragma once
#include <array>
#include <optional>

#include "ui/panels/layout.hpp"
#include "ui/render_target/drawn_apart.hpp"
#include "ui/scene/scene.hpp"
#include "ui/window/box_handles.hpp"
#include "ui/window/faces_ahead.hpp"
#include "ui/workbench/found_surface.hpp"
#include "ui/workbench/inspection.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// What a point of the scene shows.
struct Picked {
  std::optional<std::size_t> candidate, ray;
  std::optional<std::uint32_t> voxel;
};

/// How much of a scene is another one than before.
enum class SceneChange {
  none,
  little,  ///< what is looked at, beside what is there
  much     ///< what there is, or is shown of it
};

/// The 3D part of the window: a scene that follows snapshots and does again only what changed.
class SceneView {
 public:
  SceneView(RenderTarget& target, double scale);

  /// In the target as it is now; call it again when its size changed.
  void place(const Rectangle& rectangle);
  void set_scale(double scale);
  /// Returns how much the picture changed. While a scan is doubtful, it is shown with those before it, and nothing
  /// else.
  SceneChange show(std::shared_ptr<const SessionSnapshot> snapshot, const WindowState& window,
                   std::shared_ptr<const Inspection> inspection, std::shared_ptr<const DoubtfulScan> doubtful = nullptr,
                   std::shared_ptr<const FoundSurface> surface = nullptr);
  /// Of the map that is shown next, if they are: it need not look for them then.
  void take_faces(std::shared_ptr<const FoundFaces> faces) { faces_ = std::move(faces); }
  void move(const CameraMotion& motion);
  /// Frames the object from where it is seen if it lost its sides, as the scene got so many times narrower.
  void keep_in_sight(double narrowed);
  /// Unless it is still, objects and surfaces of many triangles have fewer, too.
  void set_quality(DrawingQuality quality);

  const Rectangle& rectangle() const { return rectangle_; }
  /// What of it is left of the legends, and what beneath them.
  std::array<Rectangle, 2> beside_legends() const;
  bool shows(const SessionSnapshot& snapshot) const { return shown_.get() == &snapshot; }
  vtkRenderer& renderer() { return scene_.renderer(); }
  /// Where a point of the world is in the window, unless it is behind the camera [px from the upper left corner].
  std::optional<Eigen::Vector2d> project(const Vector3& point);
  /// The line of sight through a point of the window [px from the upper left corner].
  Sight sight(double x, double y);
  /// The camera turns and zooms around this, which frame and look-through put into the middle of the region [m, world].
  const Vector3& pivot() const { return pivot_; }
  /// Takes for it what is measured at a point of the window, if anything is; false if nothing is.
  bool set_pivot(double x, double y);
  /// What is at a point of the window [px from the upper left corner].
  Picked pick(double x, double y);
  /// The point of what is shown at a point of the window: measured, or of the object, or the middle of a voxel.
  std::optional<Vector3> surface_point(double x, double y);
  std::size_t voxel_faces() { return scene_.octree().face_count(); }
  /// What is shown; tests look here for what its colours mean.
  Scene& layers() { return scene_; }
  /// The scene alone, at a size of its own or as it is in the window, the camera gone around the region's vertical axis
  /// by an angle. What the target shows has to be drawn anew.
  Image draw_apart(const std::optional<PictureSize>& size, bool transparent, double degrees = 0);
  /// Where the scene is looked at from: T_world_camera.
  Pose camera_pose();

 private:
  struct Changes;

  void show_what_is_there(const SessionSnapshot& snapshot, const LayerChoice& choice, const Changes& is_new);
  void show_missed(const SessionSnapshot& snapshot);
  void show_cloud(const SessionSnapshot& snapshot, const LayerChoice& choice);
  void show_voxels(const SessionSnapshot& snapshot, const LayerChoice& choice);
  void show_views(const SessionSnapshot& snapshot, const WindowState& window);
  void show_surface(const SessionSnapshot& snapshot, const LayerChoice& choice);
  void show_section(const SessionSnapshot& snapshot, const LayerChoice& choice);
  const TriangleMesh* shown_surface() const;
  /// Points that enclose what is scanned, as far as it is known [m, world].
  std::vector<Vector3> object_outline();
  void show_rays(const SessionSnapshot& snapshot, const ScoreExplanation* explanation, const Vector3& origin);
  /// Where the scene's camera is, if a view that is drawn is from there.
  std::optional<Vector3> eye_of_a_view(const SessionSnapshot& snapshot, const WindowState& window);
  void show_doubtful(const SessionSnapshot& snapshot);
  void leave_doubtful();
  std::optional<std::uint32_t> occupied_voxel(double x, double y);
  void set_visible(const SessionSnapshot& snapshot, const LayerChoice& choice);

  RenderTarget& target_;
  Rectangle rectangle_;
  double scale_;                            ///< of the display
  Vector3 annotated_in_ = Vector3::Zero();  ///< width, height and scale [px]: which legends there was room for
  Scene scene_;
  Vector3 pivot_ = Vector3::Zero();
  std::shared_ptr<const SessionSnapshot> shown_;
  LayerChoice choice_;
  Selection selection_;
  std::optional<Vector3> eye_;  ///< what is from there is not drawn
  std::shared_ptr<const ScoreExplanation> explanation_;
  std::vector<RaySegment> rays_;
  std::vector<bool> hidden_;  ///< of each candidate: it is not drawn
  std::shared_ptr<const DoubtfulScan> doubtful_;
  // What is not seen is not made.
  bool cloud_is_old_ = true, voxels_are_old_ = true, colours_are_old_ = true;
  std::shared_ptr<const FoundFaces> faces_;       ///< null: none were found yet
  std::shared_ptr<const MissedPicture> missed_;   ///< that its layer has
  std::shared_ptr<const TriangleMesh> outlined_;  ///< whose outline this is:
  std::vector<Vector3> outline_;
  std::shared_ptr<const FoundSurface> surface_;  ///< null, or another session's: there is none
  bool dark_ = false, orthographic_ = false;
  Scene::Stand stand_before_;  ///< of the camera, before it was shown

  // Colour ranges, kept while they are locked.
  ValueRange utilities_{0, 1}, heights_{0, 1};
  double max_contribution_ = 0;
  bool keep_ranges_ = false;  ///< they were locked in the picture before, too
};

}  // namespace nextview
