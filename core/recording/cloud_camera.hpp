#pragma once
#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "core/view/pinhole_camera.hpp"

namespace nextview {

/// Finds the smallest pinhole camera that holds the rays to all points it is shown.
class CloudCamera {
 public:
  void see(const Vector3& point_in_camera);
  void end_of_frame();

  /// Its pixels are as dense as the points of a frame are where there are any, in the median frame; at most 640 a side;
  /// at most 150 degrees wide and high. @pre a point was seen
  PinholeCamera camera() const;
  /// For people: how many rays it does not hold; empty if it holds all.
  std::string outside() const;

 private:
  std::size_t points_ = 0, outside_ = 0;
  Eigen::Array2d low_ = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity()),
                 high_ = -low_;        ///< of x / z and y / z
  std::vector<Eigen::Array2d> frame_;  ///< of the points since the last frame's end
  std::vector<double> densities_;      ///< of each frame [points per unit of x / z times y / z]
};

}  // namespace nextview
