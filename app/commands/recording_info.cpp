#include "app/commands/recording_info.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "app/commands/extents_text.hpp"
#include "core/cloud/range_scan_folder.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/recording/dataset_guess.hpp"
#include "core/recording/recording.hpp"
#include "core/session/saved_session.hpp"
#include "core/setting/length_text.hpp"

namespace nextview {

namespace fs = std::filesystem;

std::string scene_info(const RecordedScene& scene) {
  std::size_t points = 0;
  Eigen::AlignedBox3d box;
  for (const RecordedScan& scan : scene.scans) {
    points += scan.points.size();
    for (const Vector3& point : scan.points) box.extend(scan.T_world_camera * point);
  }
  std::string text = fmt::format("{} with {}, and {} to be scored", counted(scene.scans.size(), "scan"),
                                 counted(points, "point"), counted(scene.views.size(), "view"));
  if (points > 0) text += "\n  " + extents_text(box);
  for (const auto& [name, value] : scene.parameters) text += fmt::format("\n  {} {:g}", name, value);
  return text;
}

std::string recording_info(const fs::path& path) {
  const Recording recording = open_recording(path);
  const PinholeCamera& camera = recording.camera;
  std::string text = fmt::format(
      "recorded data ({}): {} with {}\n  {}\n  camera of {} x {} pixels, fx {:.6g}, fy {:.6g}, cx {:.6g}, cy {:.6g}; "
      "ranges up to {}",
      recording.format, counted(recording.frames.size(), "frame"), counted(recording.points, "point"),
      extents_text(recording.extent), camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy,
      length_text(recording.max_range));
  if (recording.region) text += "\n  region of interest: " + extents_text(*recording.region);
  for (const std::string& line : recording.guessed) text += "\n  " + printable(line);
  return text;
}

std::string write_dataset(const fs::path& folder) {
  const fs::path file = folder / "dataset.toml";
  if (!fs::is_directory(folder))
    throw std::runtime_error(fmt::format("{}: is no folder; --write-dataset takes folders", folder.string()));
  if (is_session(folder))
    throw std::runtime_error(
        fmt::format("{}: is a session, whose captures are read as they are; no dataset.toml is needed: "
                    "nextview scan --recorded {}",
                    folder.string(), folder.string()));
  if (is_there(file))
    throw std::runtime_error(fmt::format("{}: is there already; it is not written over", file.string()));
  const auto guess = guess_dataset(folder);
  if (!guess) {
    DatasetDescription example;
    example.frames = "depth/*.png";
    example.poses = "poses/*.txt";
    example.intrinsics = "525 525 319.5 239.5";
    write_file(file, to_toml(example));
    return "dataset.toml is written as a template: nothing about the folder is known, so fill it in";
  }
  write_file(file, to_toml(guess->description));
  try {
    return "dataset.toml is written\n  " + recording_info(folder);
  } catch (const std::runtime_error& error) {  // a wrong guess is what the file is for
    return fmt::format("dataset.toml is written, and is to be corrected: {}", error.what());
  }
}

std::string range_scans_info(const fs::path& folder) {
  std::string notice;
  const RecordedScene scene =
      read_range_scan_folder(folder, default_stand_off, 0.0, [&](const std::string& text) { notice += "\n  " + text; });
  return fmt::format(
      "range scans (Stanford): {}{}\n  the scanner's distance is not told: it is taken to stand {} m off each scan's "
      "nearest point (recorded.stand_off, --stand-off)",
      scene_info(scene), notice, default_stand_off);
}

}  // namespace nextview
