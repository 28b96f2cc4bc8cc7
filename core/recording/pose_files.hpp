#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/view/pinhole_camera.hpp"

namespace nextview {

/// How a file of poses is written. Lines that begin with # and blank lines are passed over, but for the headings of
/// matrices; numbers are apart by blanks, commas or semicolons.
enum class PoseFormat {
  matrix4x4,        ///< four or three rows of four numbers; or all of them, 16 or 12, in a line, maybe behind a name
  quaternion_xyzw,  ///< px py pz qx qy qz qw, maybe behind a name or a whole number
  quaternion_wxyz,  ///< px py pz qw qx qy qz, likewise
  tum,              ///< timestamp tx ty tz qx qy qz qw
  conf              ///< Stanford: bmesh NAME tx ty tz qx qy qz qw, where q turns the other way
};
enum class PoseDirection { sensor_to_world, world_to_sensor };
enum class PoseAxes { optical, body };  ///< of the sensor: z forward and y down, or x forward and z up

/// One pose of a file, and what it says whose pose that is.
struct NamedPose {
  Pose T_world_camera = Pose::Identity();
  std::string heading;              ///< the line above a matrix, or the name in the line; may be empty
  std::optional<double> time = {};  ///< of tum [s]
  std::size_t line = 0;             ///< in the file, from 1
  bool is_unknown = false;          ///< its numbers are not finite: so recorders say that they did not know it
  std::string fault = {};           ///< "FILE:LINE: reason" of what stands there and is no pose: no rotation within
                                    ///< 1e-3, over 1e6 m off; T_world_camera means nothing then

  /// None where it is unknown. @throws std::runtime_error with its fault
  std::optional<Pose> pose() const;
};

/// The poses of a file, at least one, as T_world_camera whatever the file holds. A matrix that is neither 4x4 nor 3x4
/// (intrinsics stand in such files too) is passed over. `notice`, if given, hears what was guessed: that matrices in a
/// line stand by columns, as their last numbers say.
/// @throws std::runtime_error "FILE:LINE: reason": not as many numbers as there must be
std::vector<NamedPose> read_poses(const std::filesystem::path& file, PoseFormat format,
                                  PoseDirection direction = PoseDirection::sensor_to_world,
                                  PoseAxes axes = PoseAxes::optical,
                                  const std::function<void(const std::string&)>& notice = {});

/// The 3x3 matrix K of a file as a camera (width and height 0): the first block of three rows of three numbers, or of a
/// 4x4 one, or four numbers fx fy cx cy in a line. With `heading`, the one below a line that contains that text.
/// @throws std::runtime_error "FILE: reason"
PinholeCamera read_intrinsics(const std::filesystem::path& file, const std::string& heading = "");

/// Turns the axes of a body (x forward, y left, z up) into those of a camera: T_body_camera.
Pose camera_in_body();

}  // namespace nextview
