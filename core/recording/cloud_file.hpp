#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/cloud/point_cloud.hpp"

namespace nextview {

/// A cloud as its file holds it: in the file's unit, in the sensor's frame.
struct CloudFile {
  PointCloud points;                   ///< finite ones
  std::optional<Pose> viewpoint = {};  ///< PCD's VIEWPOINT, T_world_sensor, if it is not the identity
  std::size_t left_out = 0;            ///< points that are not finite
};

/// Reads PLY, or PCD with float32 fields x y z (ascii or binary), plain or compressed with gzip (.gz). Points that are
/// not finite, as some have where nothing was measured, are left out.
/// @throws std::runtime_error "FILE: reason"
CloudFile read_cloud_file(const std::filesystem::path& file);
/// CloudFile::viewpoint alone, without the points. @throws likewise, if the header is damaged
std::optional<Pose> read_viewpoint(const std::filesystem::path& file);

/// For people: "20000 points (3 that are not finite left out)".
std::string points_text(std::size_t points, std::size_t left_out);

}  // namespace nextview
