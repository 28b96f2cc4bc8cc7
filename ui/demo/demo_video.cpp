#include "ui/demo/demo_video.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "core/driver/started_process.hpp"
#include "core/export/frame_folder.hpp"
#include "ui/render_target/animation.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// All that a program says on its standard error stream, until it ends.
std::string words_of(const Descriptor& errors) {
  std::string text;
  char part[4096];
  for (ssize_t read; (read = ::read(errors.get(), part, sizeof part)) > 0;) text.append(part, std::size_t(read));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

void write_animation(const fs::path& frames, int frames_per_second, const fs::path& file) {
  Animation animation(frames_per_second);
  for (int number = 1; fs::exists(frames / frame_name(number)); ++number)
    animation.add(read_png(frames / frame_name(number)));
  animation.write(file);
}

}  // namespace

void require_video(const fs::path& video) {
  if (video.extension() == ".png") return;
  if (video.extension() != ".mp4" && video.extension() != ".webm")
    throw std::invalid_argument(fmt::format("--video: {} must end in .mp4, .webm or .png", video.string()));
  if (!is_on_path("ffmpeg"))
    throw std::runtime_error("--video: there is no program ffmpeg; install it, or write an animated .png");
}

void write_video(const fs::path& frames, int frames_per_second, const fs::path& video) {
  if (video.extension() == ".png") return write_animation(frames, frames_per_second, video);
  // yuv420p wants even sides, and is what players know.
  const StartedProcess ffmpeg =
      start_process({"ffmpeg", "-y", "-nostdin", "-loglevel", "error", "-framerate", std::to_string(frames_per_second),
                     "-i", (frames / "frame_%05d.png").string(), "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt",
                     "yuv420p", fs::absolute(video).string()});
  const std::string words = words_of(ffmpeg.errors);
  int status = 0;
  ::waitpid(ffmpeg.process, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(fmt::format("{}: ffmpeg cannot write it: {}", video.string(), words));
}

}  // namespace nextview
