#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/view/pose.hpp"

namespace nextview {

/// Where somebody looked at a scene from, under a name, to come back to.
struct CameraBookmark {
  std::string name;
  Pose T_world_camera = Pose::Identity();

  bool operator==(const CameraBookmark& other) const {
    return name == other.name && T_world_camera.matrix() == other.T_world_camera.matrix();
  }
};

constexpr const char* cameras_name = "cameras.json";  ///< of the file in a session's folder
constexpr std::size_t max_cameras = 200;              ///< that a session keeps

/// Puts it at the end, or in the place of the one of that name.
/// @throws std::invalid_argument if the name is empty or longer than 60 bytes, or there are too many
void keep(std::vector<CameraBookmark>& cameras, CameraBookmark camera);
/// @throws std::invalid_argument if there is none of this name
void forget(std::vector<CameraBookmark>& cameras, const std::string& name);

std::string cameras_json(const std::vector<CameraBookmark>& cameras);
/// Those of a session's folder; none where there is no such file.
/// @throws std::runtime_error naming the file and the reason
std::vector<CameraBookmark> read_cameras(const std::filesystem::path& folder);

}  // namespace nextview
