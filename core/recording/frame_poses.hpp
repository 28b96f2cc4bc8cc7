#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/recording/dataset.hpp"
#include "core/recording/frame_files.hpp"

namespace nextview {

/// The pose of each frame, none where the recording has none for it, and the files they were read from.
struct FramePoses {
  std::vector<std::optional<Pose>> T_world_camera;
  std::vector<std::filesystem::path> files;
  std::vector<std::string> guessed = {};  ///< a line each, for people
};

/// Finds out which pose belongs to which frame. One file a frame: by what the wildcards stand for, or where nothing
/// fits but the counts do, by order. One file for all: by timestamps (tum, within 0.02 s), by headings that contain a
/// frame's name, by headings whose last numbers are the frames', or by order. Only what a frame takes must be a pose:
/// intrinsics may stand among them.
/// @throws std::runtime_error in one line, also if no frame has a pose
FramePoses find_poses(const std::filesystem::path& folder, const std::vector<FrameFile>& frames,
                      const DatasetDescription& description);

}  // namespace nextview
