#include "core/recording/dataset_guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "core/file/gzip_file.hpp"
#include "core/recording/depth_image_file.hpp"
#include "core/recording/frame_files.hpp"
#include "core/recording/number_lines.hpp"
#include "core/sensor/recorded_scans.hpp"
#include "core/setting/mistyped_path.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

void say(GuessedDataset& guess, std::string_view line) { guess.guessed.push_back(fmt::format("{}", line)); }

std::string intrinsics_text(const PinholeCamera& c) { return fmt::format("{} {} {} {}", c.fx, c.fy, c.cx, c.cy); }

bool has(const fs::path& folder, const std::string& pattern) { return !find_frame_files(folder, pattern).empty(); }

/// The first of some patterns that the folder has a file for; empty if there is none.
std::string first_there(const fs::path& folder, std::initializer_list<const char*> patterns) {
  for (const char* pattern : patterns)
    if (has(folder, pattern)) return pattern;
  return "";
}

std::optional<GuessedDataset> stanford(const fs::path& folder) {
  const std::vector<FrameFile> files = find_frame_files(folder, "*.conf");
  const auto places_scans = [](const FrameFile& file) {
    return read_text(file.file).find("bmesh ") != std::string::npos;
  };
  if (std::ranges::none_of(files, places_scans)) return std::nullopt;
  GuessedDataset guess;
  say(guess, "its .conf file says that these are range images as Stanford's");
  guess.description.format = RecordingFormat::stanford;
  return guess;
}

/// ViSP's raw depths begin with height and width. Debian's visp-images-data has folders for depths and poses.
std::optional<GuessedDataset> visp_castle(const fs::path& folder) {
  const std::string depths = first_there(folder, {"Depth_*.bin", "Depth/Depth_*.bin"});
  const std::string poses = first_there(folder, {"Camera_*.txt", "CameraPose/Camera_*.txt"});
  if (depths.empty() || poses.empty()) return std::nullopt;
  const std::vector<FrameFile> frames = find_frame_files(folder, depths);
  const std::string bytes = read_plain_or_gzip(frames.front().file);
  std::uint32_t size[2] = {0, 0};
  if (bytes.size() >= 8) std::memcpy(size, bytes.data(), 8);
  if (bytes.size() < 8 || size[0] > largest_image_side || size[1] > largest_image_side ||
      bytes.size() != 8 + 2 * std::uint64_t{size[0]} * size[1])
    throw std::runtime_error(fmt::format(
        "{}: is no raw depth image as ViSP's (height and width as uint32, then uint16)", frames.front().file.string()));
  GuessedDataset guess;
  DatasetDescription& d = guess.description;
  d.frames = depths;
  d.poses = poses;
  d.pose_direction = PoseDirection::world_to_sensor;
  d.depth.height = static_cast<int>(size[0]);
  d.depth.width = static_cast<int>(size[1]);
  d.depth.offset = 8;
  d.depth.scale = 0.000030518;
  d.depth.zero = ZeroDepth::beyond;  // it is drawn: there is nothing where it has no depth
  d.intrinsics = intrinsics_text(
      {0, 0, 700.0 * d.depth.width / 640, 700.0 * d.depth.width / 640, d.depth.width / 2.0, d.depth.height / 2.0});
  say(guess, fmt::format("its files' names and headers say that these are depths as of ViSP's simulated castle, {} "
                         "x {} pixels, free where there is no depth; intrinsics and the depths' scale of 0.000030518 m "
                         "are that scene's",
                         d.depth.width, d.depth.height));
  // Checked on its mesh: points lie 0.2 mm off it in the median; without the offset, 23 mm.
  d.camera_offset = "0.05 0 0";
  say(guess, "its poses are from world to the color camera; the depth camera stands 0.05 m to the right of that");
  return guess;
}

std::optional<GuessedDataset> princeton(const fs::path& folder) {
  if (!has(folder, "cam.info.txt") || !has(folder, "frame-*.depth.png")) return std::nullopt;
  GuessedDataset guess;
  DatasetDescription& d = guess.description;
  d.frames = "frame-*.depth.png";
  d.poses = "cam.info.txt";
  d.depth.scale = 1e-4;
  d.depth.encoding = DepthEncoding::rotate3;
  d.intrinsics = intrinsics_text(read_intrinsics(folder / "cam.info.txt", "Color camera intrinsic"));
  say(guess,
      "cam.info.txt says that this is a scene of Princeton's Amazon Picking Challenge: depths in 0.1 mm, their bits "
      "rotated by three, poses from camera to world");
  say(guess,
      "its depth images are aligned to the color camera: they take the color camera's intrinsics, and no "
      "depth-to-color transformation");
  return guess;
}

/// Structured light's usual camera (640 x 480 pixels, 525 px) with as many pixels as the first frame has.
PinholeCamera usual_camera(const fs::path& folder, const DatasetDescription& d) {
  PinholeCamera camera{640, 480};
  try {
    camera = read_depth_image(find_frame_files(folder, d.frames).front().file, d.depth, {}).camera;
  } catch (const std::runtime_error&) {  // it is refused by its name when it is read
  }
  camera.fx = camera.fy = 525.0 * camera.width / 640;
  camera.cx = 0.5 * (camera.width - 1), camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

/// Intrinsics from a file of the folder, or by their sensor; says which.
void guess_intrinsics(const fs::path& folder, GuessedDataset& guess) {
  const std::string file = first_there(
      folder, {"camera-intrinsics.txt", "intrinsics.txt", "intrinsic_depth.txt", "intrinsic.txt", "camera.txt"});
  if (!file.empty()) {
    guess.description.intrinsics = intrinsics_text(read_intrinsics(folder / file));
    say(guess, fmt::format("intrinsics are those of {}", file));
    return;
  }
  const PinholeCamera camera = usual_camera(folder, guess.description);
  guess.description.intrinsics = intrinsics_text(camera);
  say(guess, fmt::format("intrinsics are not told: {:.4g} px and the centre of {} x {}, usual of structured light",
                         camera.fx, camera.width, camera.height));
}

/// Of a .npy file; who keeps whole numbers counts millimetres.
bool holds_real_numbers(const fs::path& file) try {
  const std::string bytes = read_plain_or_gzip(file);
  return is_npy(bytes) && !decode_npy(bytes).real.empty();
} catch (const std::runtime_error&) {
  return false;  // it is refused by its name when it is read
}

std::optional<GuessedDataset> pose_beside_each(const fs::path& folder) {
  const std::string frames =
      first_there(folder, {"frame-*.depth.png", "frame-*.depth.pgm", "*.depth.png", "*.depth.npy"});
  const std::string poses = first_there(folder, {"frame-*.pose.txt", "*.pose.txt"});
  if (frames.empty() || poses.empty()) return std::nullopt;
  GuessedDataset guess;
  guess.description.frames = frames;
  guess.description.poses = poses;
  const bool in_metres = holds_real_numbers(find_frame_files(folder, frames).front().file);
  if (in_metres) guess.description.depth.scale = 1.0;
  say(guess,
      fmt::format("its files' names say that these are depth images as of 3DMatch or 7-Scenes: depths in {} along "
                  "z, poses from camera to world",
                  in_metres ? "m (they are no whole numbers)" : "mm"));
  guess_intrinsics(folder, guess);
  return guess;
}

std::optional<GuessedDataset> tum(const fs::path& folder) {
  const std::string frames = first_there(folder, {"depth/*.png"});
  const std::string poses = first_there(folder, {"groundtruth.txt", "poses.txt", "trajectory.txt"});
  if (frames.empty() || poses.empty()) return std::nullopt;
  GuessedDataset guess;
  guess.description.frames = frames;
  guess.description.poses = poses;
  guess.description.poses_format = PoseFormat::tum;
  guess.description.depth.scale = 1.0 / 5000.0;
  say(guess, fmt::format("depth/ and {} say that this is a recording as of TUM RGB-D: depths in 1/5000 m along z, "
                         "poses from camera to world, each frame's the nearest in time",
                         poses));
  guess_intrinsics(folder, guess);
  return guess;
}

PoseFormat format_of_poses(const fs::path& file) {
  for (const NumberLine& line : number_lines(read_text(file))) {
    if (line.numbers.size() == 7) return PoseFormat::quaternion_xyzw;
    if (line.numbers.size() == 8) return PoseFormat::tum;
    if (!line.numbers.empty()) break;
  }
  return PoseFormat::matrix4x4;
}

std::optional<GuessedDataset> clouds(const fs::path& folder) {
  const std::string frames = first_there(folder, {"*.pcd", "*.ply"});
  if (frames.empty()) return std::nullopt;
  const std::string poses = first_there(folder, {"poses.txt", "*.pose.txt", "*.pose", "*.txt", "poses/*.txt"});
  if (poses.empty() && frames != "*.pcd") return std::nullopt;
  GuessedDataset guess;
  DatasetDescription& d = guess.description;
  d.format = RecordingFormat::clouds;
  d.frames = frames;
  d.poses = poses;
  if (poses.empty()) {
    say(guess, "clouds whose own VIEWPOINT places them; their points are in the sensor's frame");
    return guess;
  }
  d.poses_format = format_of_poses(find_frame_files(folder, poses).front().file);
  say(guess, fmt::format("clouds, placed by {}: {}, sensor to world, optical axes (z forward)", poses,
                         d.poses_format == PoseFormat::matrix4x4 ? "matrices"
                         : d.poses_format == PoseFormat::tum     ? "time x y z qx qy qz qw"
                                                                 : "x y z qx qy qz qw"));
  return guess;
}

std::optional<GuessedDataset> scan_graph(const fs::path& folder) {
  const std::vector<FrameFile> graphs = find_frame_files(folder, "*.graph");
  if (graphs.size() != 1) return std::nullopt;
  GuessedDataset guess;
  guess.description.format = RecordingFormat::scan_graph;
  guess.description.frames = graphs.front().file.filename().string();
  return guess;
}

std::runtime_error unknown(const fs::path& folder) {
  return std::runtime_error(
      fmt::format("{}: holds neither results of Nextview (manifest.json) nor recorded data that are known; looked for "
                  "{}; a description of others can be begun with "
                  "`nextview info "
                  "{} --write-dataset`",
                  folder.string(), known_datasets(), folder.string()));
}

DescribedDataset described_file(const fs::path& file) {
  if (file.extension() == ".toml")
    return {file.has_parent_path() ? file.parent_path() : fs::path("."), read_dataset(file), {}, file};
  DescribedDataset found{file.parent_path(), {}, {}, {}};
  found.description.frames = file.filename().string();
  const fs::path extension = file.extension();
  if (extension == ".graph" || extension == ".log")
    found.description.format = RecordingFormat::scan_graph;
  else if (is_scene_file(file))
    found.description.format = RecordingFormat::scene;
  else
    throw std::runtime_error(fmt::format(
        "{}: is no recording; a folder, a scan graph (.graph, .log), a scene (.txt, .txt.gz) or a dataset.toml is",
        file.string()));
  return found;
}

}  // namespace

std::string known_datasets() {
  return "dataset.toml, *.conf (Stanford), Depth_*.bin with Camera_*.txt (ViSP), frame-*.depth.png with cam.info.txt "
         "(Princeton), *.depth.png with *.pose.txt (3DMatch), depth/*.png with groundtruth.txt (TUM), *.ply or *.pcd "
         "with "
         "poses, one *.graph (OctoMap)";
}

std::optional<GuessedDataset> guess_dataset(const fs::path& folder) {
  for (const auto guess : {stanford, visp_castle, princeton, pose_beside_each, tum, clouds, scan_graph})
    if (auto found = guess(folder)) return found;
  return std::nullopt;
}

DescribedDataset describe_dataset(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) {
    if (!fs::exists(path, ignored))
      throw std::runtime_error(
          fmt::format("{}: there is no such file or folder{}", path.string(), did_you_mean_path(path)));
    return described_file(path);
  }
  if (fs::is_empty(path, ignored))
    throw std::runtime_error(
        fmt::format("{}: is an empty folder: no recording and no session is in it", path.string()));
  if (fs::exists(path / "dataset.toml", ignored)) return described_file(path / "dataset.toml");
  if (fs::exists(path / "manifest.json", ignored))
    throw std::runtime_error(
        fmt::format("{}: holds results of Nextview (manifest.json), no scans of others", path.string()));
  auto guess = guess_dataset(path);
  if (!guess) throw unknown(path);
  return {path, std::move(guess->description), std::move(guess->guessed), {}};
}

}  // namespace nextview
