#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_grid.hpp"
#include "core/mesh/triangle_mesh.hpp"
#include "core/view/pinhole_camera.hpp"
#include "ui/charts/chart.hpp"
#include "ui/scene/scene.hpp"

namespace nextview {

/// All that one picture of a scanning step shows. Pointers and spans need to live while it is shown only; what is empty
/// is left out.
struct StepPicture {
  int step = 0;             ///< 1 for the first next best view
  int step_count = 0;       ///< 0: not known
  std::string object_name;  ///< for the title
  std::string gain_name;    ///< "occlusion aware"
  std::string gain_unit;    ///< "nats"; empty for dimensionless gains

  const TriangleMesh* object = nullptr;  ///< the true object, if known
  MeshStyle object_style = MeshStyle::ghost;
  VoxelGrid grid;             ///< the region of interest
  std::vector<Voxel> voxels;  ///< one per voxel of the grid
  PointCloud cloud;
  double point_size = 2.5;  ///< [px]

  PinholeCamera camera;
  std::vector<Pose> candidates;          ///< T_world_camera
  std::vector<double> scores;            ///< one per candidate [gain_unit]
  std::vector<double> utilities;         ///< one per candidate if the ranking is by utility, otherwise none
  std::vector<std::size_t> taken;        ///< candidates that no longer take part
  std::vector<std::size_t> unreachable;  ///< candidates that the robot cannot go to
  std::vector<std::size_t> numbered;     ///< candidates that are drawn with their numbers
  std::optional<std::size_t> chosen;     ///< a candidate: the next best view
  std::vector<Pose> path;                ///< views taken so far, the start view first; T_world_camera
  std::vector<RaySegment> rays;          ///< of the chosen view
  RayValues ray_values;
  std::string reason;        ///< of the choice
  std::string finished;      ///< why no view follows; empty if one does
  std::string ranking_note;  ///< for example that all candidates tie, and why

  ChartContent entropy{"Entropy of the map", "view", "", "entropy", "bits", {}, {}, true};
  ChartContent coverage{"Surface coverage", "view", "", "coverage", "%", {}, 100.0, true};  ///< or what else is known

  std::optional<ViewDirection> direction;  ///< where both 3D views look from; otherwise beside the chosen view
};

/// A scanning step as one picture, as for a paper: the views around the object, the map, the ranking, the curves.
class StepFigure {
 public:
  /// Draws over the whole target, which must live longer. Made for 1600 x 1000 pixels.
  explicit StepFigure(RenderTarget& target);
  ~StepFigure();
  StepFigure(const StepFigure&) = delete;
  StepFigure& operator=(const StepFigure&) = delete;

  void show(const StepPicture& picture);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The figure as an image, drawn headless (ensure_headless).
Image draw_step_figure(const StepPicture& picture, int width = 1600, int height = 1000);

/// The views of a picture, as the scene shows them.
ViewsPicture views_of(const StepPicture& picture);

/// A direction from which the view's frustum is seen from its side, slightly from above.
ViewDirection beside(const Pose& T_world_camera);

/// "Step 3 of 20 · next best view 17 · occlusion aware 1234.5 nats"
std::string step_title(const StepPicture& picture);

}  // namespace nextview
