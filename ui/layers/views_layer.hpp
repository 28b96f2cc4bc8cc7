#pragma once
#include <optional>
#include <string>

#include "core/view/pinhole_camera.hpp"
#include "ui/layers/layer.hpp"

class vtkActor;
class vtkPolyDataMapper;

namespace nextview {

/// Candidate views, what was scored, chosen and taken. Spans need to live during show() only.
struct ViewsPicture {
  PinholeCamera camera;                           ///< gives the frustums' shape
  std::span<const Pose> candidates;               ///< T_world_camera
  std::span<const double> scores;                 ///< one per candidate, or none
  std::span<const std::size_t> taken;             ///< candidates
  std::span<const std::size_t> unreachable = {};  ///< candidates
  std::span<const std::size_t> hidden = {};       ///< candidates that are not drawn, but count for the colours
  std::span<const std::size_t> numbered = {};     ///< candidates with small numbers: as sentences and tables name them
  std::optional<std::size_t> chosen;              ///< a candidate
  std::optional<Pose> custom_view =
      {};                           ///< no candidate, but chosen by hand; its full frustum takes the chosen one's place
  std::optional<Vector3> eye = {};  ///< views from here (or nearly) are not drawn: they would be in the way [m, world]
  std::span<const Pose> path;       ///< the views taken so far, in order; T_world_camera
  bool numbered_path = false;       ///< small numbers at the views taken, from 1
  std::string score_name = "score";
  std::string score_unit;
  std::optional<ValueRange> range = {};  ///< of the colours, locked; that of the candidates not taken if not given
  double size = 0.07;                    ///< depth of a frustum [m]
  double reach = 0.5;                    ///< depth of the chosen view's frustum [m]
};

/// How deep frustums are drawn that stand around a target [m]: a small part of the way there.
double frustum_depth(std::span<const Pose> candidates, const Vector3& target);
/// Whether an eye stands where a camera does, or nearly: it would look out of the camera's own pyramid, which is drawn
/// so deep [m].
bool stands_at(const Vector3& eye, const Vector3& camera, double depth);

/// Candidates as frustums coloured by score, taken ones grey, the chosen one with its full frustum, and the path so
/// far.
class ViewsLayer : public Layer {
 public:
  explicit ViewsLayer(vtkRenderer& renderer);

  /// @throws std::invalid_argument if there are scores, but not one per candidate, an index is no candidate's, or the
  ///         range is empty.
  void show(const ViewsPicture& picture);

 private:
  struct Part {
    vtkSmartPointer<vtkPolyDataMapper> mapper;
    vtkSmartPointer<vtkActor> actor;
  };
  Part make_part(double line_width, double opacity);

  void show_full_frustum(const ViewsPicture& picture, const Pose& T_world_camera);

  Part frustums_, outlines_, path_, chosen_faces_, chosen_outline_;
};

}  // namespace nextview
