#pragma once
#include <filesystem>

namespace nextview {

/// @throws std::invalid_argument, std::runtime_error in one line if the name ends otherwise than .mp4, .webm or .png,
/// or there is no ffmpeg on the PATH, which the first two need: before a long job.
void require_video(const std::filesystem::path& video);

/// Makes a video of frame_00001.png, … in a folder, by the program ffmpeg, or an animated PNG; one of this name is
/// replaced. @throws std::runtime_error naming it and the reason or ffmpeg's own words.
void write_video(const std::filesystem::path& frames, int frames_per_second, const std::filesystem::path& video);

}  // namespace nextview
