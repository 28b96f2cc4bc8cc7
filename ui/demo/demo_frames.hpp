#pragma once
#include <functional>
#include <stop_token>

#include "core/config/configuration.hpp"
#include "core/results/output_folder.hpp"
#include "ui/appearance/picture_size.hpp"
#include "ui/commands/demo_file.hpp"
#include "ui/render_target/render_target.hpp"

namespace nextview {

struct DemoPictures {
  PictureSize size{1280, 720};
  int frames_per_second = 30;
};

/// Plays a demo without a display, by its own time: the same frames every time, on any number of threads, and those
/// that the window shows. `take` is given each frame, and its number from 1. Returns the configuration that it
/// ended with.
/// @throws std::runtime_error "FILE:LINE: reason" for the first line that is not done, Stopped.
Configuration play_demo(const Demo& demo, const DemoPictures& pictures,
                        const std::function<void(const Image&, int number)>& take, const std::stop_token& stop = {});

/// The same in a target of one's own, such as a window.
Configuration play_demo(const Demo& demo, RenderTarget& target, int frames_per_second,
                        const std::function<void(const Image&, int number)>& take, const std::stop_token& stop = {});

/// The same into frame_00001.png, … and config.toml. Returns how many frames there are.
int write_demo(const Demo& demo, const DemoPictures& pictures, OutputFolder& folder,
               const std::function<void(int number)>& progress, const std::stop_token& stop);

}  // namespace nextview
