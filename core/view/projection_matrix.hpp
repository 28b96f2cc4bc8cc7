#pragma once
#include <functional>

#include "core/view/pose.hpp"

namespace nextview {

/// P = K [R | t], from the world in homogeneous coordinates to pixels.
using ProjectionMatrix = Eigen::Matrix<double, 3, 4>;

/// A camera projection matrix taken apart. K's skew is left out; P's sign and scale do not matter.
struct DecomposedProjection {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< [px]
  Pose T_world_camera = Pose::Identity();         ///< [P's unit of length]
};
/// @throws std::invalid_argument if P is not finite or is no camera's (its left part cannot be inverted)
DecomposedProjection decompose_projection(const ProjectionMatrix& projection);

/// Whether a text begins as projection matrices do: with a line of 4 or 12 numbers.
bool has_projections(const std::string& text);

/// The cameras of projection matrices, in the matrices' unit of length: those of a file (three lines of four numbers
/// each, or one line of twelve), or those of a folder with such files (DTU: pos_001.txt, pos_002.txt, …) in natural
/// order. Other files in a folder are passed over; `notice`, if given, hears of them.
/// @throws std::runtime_error "FILE:LINE: reason": no such matrix, not numbers, no camera's; a folder without any
std::vector<Pose> read_projections(const std::filesystem::path& file_or_folder,
                                   const std::function<void(const std::string&)>& notice = {});

}  // namespace nextview
