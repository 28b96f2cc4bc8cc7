#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "ui/demo/demo_frames.hpp"

namespace nextview {

/// A number a frame of a demo, that another picture hardly has: played without a display.
std::vector<std::string> frame_hashes(const Demo& demo, const DemoPictures& pictures);

/// The same of the frames that a window on this display has, in a line each of a file. It is another process' job: with
/// `--play-in-window DEMO WxH FPS FILE` the tests' program calls this.
void write_frame_hashes_of_window(const std::string& demo, const DemoPictures& pictures,
                                  const std::filesystem::path& file);

}  // namespace nextview
