#include "tests/integration/demo_in_window.hpp"

#include <fmt/format.h>

#include "core/file/atomic_file.hpp"
#include "ui/panels/panel_table.hpp"
#include "ui/render_target/window_target.hpp"

namespace nextview {
namespace {

/// FNV-1a
std::string hash(const Image& image) {
  std::uint64_t value = 0xcbf29ce484222325u;
  for (const std::uint8_t byte : image.rgba) value = (value ^ byte) * 0x100000001b3u;
  return fmt::format("{}x{} {:016x}", image.width, image.height, value);
}

}  // namespace

std::vector<std::string> frame_hashes(const Demo& demo, const DemoPictures& pictures) {
  std::vector<std::string> hashes;
  play_demo(demo, pictures, [&](const Image& frame, int) { hashes.push_back(hash(frame)); });
  return hashes;
}

void write_frame_hashes_of_window(const std::string& demo, const DemoPictures& pictures,
                                  const std::filesystem::path& file) {
  announce_panels(standard_panels());
  WindowTarget target("Nextview", pictures.size.width, pictures.size.height);
  std::string lines;
  play_demo(read_demo(demo), target, pictures.frames_per_second,
            [&](const Image& frame, int) { lines += hash(frame) + '\n'; });
  write_file(file, lines);
}

}  // namespace nextview
