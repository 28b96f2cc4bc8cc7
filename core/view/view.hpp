#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/view/pose.hpp"

namespace nextview {

/// Where a camera is to look from.
struct View {
  Pose T_world_camera = Pose::Identity();
  std::optional<std::uint32_t> frame = {};  ///< of a recording: the view is this one

  bool operator==(const View& other) const {  // to the bit: a view is known again by what it was made of
    return T_world_camera.matrix() == other.T_world_camera.matrix() && frame == other.frame;
  }
};

inline std::vector<View> views_at(std::span<const Pose> poses) {
  std::vector<View> views;
  for (const Pose& pose : poses) views.push_back({pose});
  return views;
}

inline std::vector<Pose> poses_of(std::span<const View> views) {
  std::vector<Pose> poses;
  for (const View& view : views) poses.push_back(view.T_world_camera);
  return poses;
}

}  // namespace nextview
