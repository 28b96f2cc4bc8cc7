#pragma once
#include <optional>
#include <string>

#include "core/view/pinhole_camera.hpp"
#include "ui/layers/layer.hpp"

class vtkActor;
class vtkPolyDataMapper;

namespace nextview {

/// Candidate views, what was scored, chosen and visited. Spans need to live during show() only.
struct ViewsPicture {
  PinholeCamera camera;                  ///< gives the frustums' shape
  std::span<const Pose> candidates;      ///< T_world_camera
  std::span<const double> scores;        ///< one a candidate, or none
  std::span<const std::size_t> visited;  ///< candidates
  std::optional<std::size_t> chosen;     ///< a candidate
  std::span<const Pose> path;            ///< the views taken so far, in order; T_world_camera
  std::string score_name = "score";
  std::string score_unit;
  double size = 0.07;  ///< depth of a frustum [m]
  double reach = 0.5;  ///< depth of the chosen view's frustum [m]
};

/// Candidates as frustums coloured by score, visited ones grey, the chosen one with its full frustum, and the path so
/// far.
class ViewsLayer : public Layer {
 public:
  explicit ViewsLayer(vtkRenderer& renderer);

  /// @throws std::invalid_argument if there are scores, but not one a candidate, or an index is no candidate's.
  void show(const ViewsPicture& picture);

 private:
  struct Part {
    vtkSmartPointer<vtkPolyDataMapper> mapper;
    vtkSmartPointer<vtkActor> actor;
  };
  Part make_part(double line_width, double opacity);

  Part frustums_, outlines_, path_, chosen_faces_, chosen_outline_;
};

}  // namespace nextview
