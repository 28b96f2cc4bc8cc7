#pragma once
#include <optional>

#include "core/cloud/point_cloud.hpp"
#include "ui/appearance/styles.hpp"
#include "ui/layers/layer.hpp"

class vtkActor;
class vtkPolyDataMapper;

namespace nextview {

/// Measured points and what is known of each. Spans need to live during show() only.
struct CloudPicture {
  std::span<const Eigen::Vector3f> points;  ///< [m, world]
  std::span<const std::uint16_t> views;     ///< in which view it was measured, from 0; one a point or none
  std::span<const float> distances;         ///< [m], not a number without a truth; one a point or none
  CloudColouring colouring = CloudColouring::single;
  /// Of the colours by height [m], locked; that of the points if not given.
  std::optional<ValueRange> heights = {};
  double farthest = 0.005;                        ///< [m] points at this distance and beyond take the last colour
  double point_size = 2.5;                        ///< [px]
  std::span<const Eigen::Vector3f> normals = {};  ///< that light is shed by; one a point, or none: small balls
};

/// The measured points.
class CloudLayer : public Layer {
 public:
  explicit CloudLayer(vtkRenderer& renderer);

  void show(const PointCloud& cloud, double point_size = 2.5);  ///< in one colour; point size in pixels
  /// @throws std::invalid_argument if there are views or distances but not one a point, none though the points are to
  ///         be coloured by them, or a range is empty.
  void show(const CloudPicture& picture);
  /// Points are flat squares rather than spheres, and of many every third is drawn, larger: a software renderer feels
  /// each.
  void set_coarse(bool coarse);

 private:
  void show_thin(const CloudPicture& picture, const std::optional<Legend::Range>& range);
  void show_points();
  void on_scale() override { show_points(); }

  /// Each keeps on the graphics card what it draws: only what is looked at goes there.
  vtkSmartPointer<vtkPolyDataMapper> full_, thin_;
  vtkSmartPointer<vtkActor> actor_;
  double point_size_ = 2.5;  ///< [px]
  bool coarse_ = false, has_normals_ = false, has_thin_ = false;
};

}  // namespace nextview
