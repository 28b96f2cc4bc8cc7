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

/// With its folders and its own name, however it was named: with a slash at its end, or from within.
fs::path whole(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
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
  const fs::path folder = whole(file).parent_path();
  const bool is_capture = folder.filename() == scans_name && has_journal(folder.parent_path());
  std::string text = fmt::format("a {} of {} x {} pixels: {} measured",
                                 is_capture ? "session's capture" : "depth image", table.columns, table.rows, measured);
  if (measured > 0) text += fmt::format(", from {:.4g} to {:.4g}{}", nearest, farthest, is_capture ? " m" : "");
  if (beyond > 0) text += fmt::format(", {} beyond range", beyond);
  if (!is_capture) text += "\n  its unit is what dataset.toml says of the recording (depth.scale)";
  return text;
}

std::optional<std::string> session_part_info(const fs::path& path) {
  const fs::path part = whole(path), folder = part.parent_path();
  if (!has_journal(folder)) return std::nullopt;
  std::error_code error;
  if (fs::is_directory(path, error) && part.filename() == scans_name) {
    const auto files = std::distance(fs::directory_iterator(path), fs::directory_iterator());
    return fmt::format("the captures of a session: {}\n{}", counted(std::size_t(files), "file"), session_info(folder));
  }
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  if (part.filename() == journal_name) return "the journal of a session\n" + session_info(folder);
  if (part.filename() == state_file_name)
    return "what was computed of a session, so that --resume need not compute it again; deleting it loses nothing";
  return std::nullopt;
}

}  // namespace nextview
