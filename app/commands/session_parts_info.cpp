#include "app/commands/session_parts_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands/session_info.hpp"
#include "core/file/counted.hpp"
#include "core/file/npy_file.hpp"
#include "core/journal/journal.hpp"
#include "core/session/state_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// Of the folder that something lies in, however it was named: with a slash at its end, or from within.
fs::path folder_around(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return (normal.has_filename() ? normal : normal.parent_path()).parent_path();
}

std::string last_name(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return (normal.has_filename() ? normal : normal.parent_path()).filename().string();
}

}  // namespace

std::string depth_image_info(const fs::path& file) {
  const NpyTable table = read_npy(file);
  std::size_t measured = 0, beyond = 0;
  float nearest = INFINITY, farthest = 0;
  for (const float value : table.values) {
    beyond += value == INFINITY;
    if (!std::isfinite(value) || value <= 0) continue;
    ++measured;
    nearest = std::min(nearest, value);
    farthest = std::max(farthest, value);
  }
  const bool is_capture =
      last_name(folder_around(file)) == scans_name && has_journal(folder_around(folder_around(file)));
  std::string text = fmt::format("a {} of {} x {} pixels: {} measured",
                                 is_capture ? "session's capture" : "depth image", table.columns, table.rows, measured);
  if (measured > 0) text += fmt::format(", from {:.4g} to {:.4g}{}", nearest, farthest, is_capture ? " m" : "");
  if (beyond > 0) text += fmt::format(", {} beyond range", beyond);
  if (!is_capture) text += "\n  its unit is what dataset.toml says of the recording (depth.scale)";
  return text;
}

std::optional<std::string> session_part_info(const fs::path& path) {
  const fs::path folder = folder_around(path);
  if (!has_journal(folder)) return std::nullopt;
  std::error_code error;
  if (fs::is_directory(path, error) && last_name(path) == scans_name) {
    const auto files = std::distance(fs::directory_iterator(path), fs::directory_iterator());
    return fmt::format("the captures of a session: {}\n{}", counted(std::size_t(files), "file"), session_info(folder));
  }
  if (fs::is_regular_file(path, error) && last_name(path) == state_file_name)
    return "what was computed of a session, so that --resume need not compute it again; deleting it loses nothing";
  return std::nullopt;
}

}  // namespace nextview
