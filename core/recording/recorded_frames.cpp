#include "core/recording/recorded_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "core/cloud/range_scan_folder.hpp"
#include "core/file/counted.hpp"
#include "core/recording/cloud_file.hpp"
#include "core/recording/frame_poses.hpp"
#include "core/recording/scan_graph_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

std::vector<FrameFile> find_frames(const DescribedDataset& dataset) {
  std::vector<FrameFile> frames = find_frame_files(dataset.folder, dataset.description.frames);
  if (frames.empty())
    throw std::runtime_error(
        fmt::format("{}: there is no file '{}'", dataset.folder.string(), dataset.description.frames));
  return frames;
}

/// Of graphs and scenes. One that the caller named is taken as it is.
fs::path single_file(const DescribedDataset& dataset) {
  if (dataset.description_file.empty()) return dataset.folder / dataset.description.frames;
  return find_frames(dataset).front().file;
}

/// Leaves out what has no pose, and says so.
void place_frames(Recording& recording, const FramePoses& poses, const Pose& T_posed_camera) {
  std::vector<RecordedFrame> placed;
  std::string first;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    if (poses.T_world_camera[i]) {
      placed.push_back(std::move(recording.frames[i]));
      placed.back().T_world_camera = *poses.T_world_camera[i] * T_posed_camera;
    } else if (first.empty()) {
      first = recording.frames[i].name;
    }
  }
  if (const std::size_t missing = recording.frames.size() - placed.size(); missing > 0)
    recording.guessed.push_back(fmt::format("{} without a pose {} left out, {} for example", counted(missing, "frame"),
                                            missing == 1 ? "is" : "are", first));
  recording.frames = std::move(placed);
  recording.guessed.insert(recording.guessed.end(), poses.guessed.begin(), poses.guessed.end());
  recording.files.insert(recording.files.end(), poses.files.begin(), poses.files.end());
}

void scale(FramePoses& poses, double unit) {
  for (auto& pose : poses.T_world_camera)
    if (pose) pose->translation() *= unit;
}

void list_images(const DescribedDataset& dataset, double unit, Recording& recording) {
  const DatasetDescription& d = dataset.description;
  const std::vector<FrameFile> files = find_frames(dataset);
  std::shared_ptr<const ImageMask> mask;
  if (const std::vector<FrameFile> masks = find_frame_files(dataset.folder, d.mask); !masks.empty()) {
    mask = std::make_shared<ImageMask>(read_mask(masks.front().file));
    recording.files.push_back(masks.front().file);
  } else if (!d.mask.empty()) {
    throw std::runtime_error(fmt::format("{}: there is no file '{}'", dataset.folder.string(), d.mask));
  }
  for (const FrameFile& frame : files) {
    recording.files.push_back(frame.file);
    recording.frames.push_back(
        {frame.name, Pose::Identity(), [file = frame.file, format = d.depth, camera = d.camera(), mask]() -> Measured {
           return read_depth_image(file, format, camera, mask.get());
         }});
  }
  FramePoses poses = find_poses(dataset.folder, files, d);
  scale(poses, unit);
  place_frames(recording, poses, d.offset());
}

std::vector<Vector3> cloud_points(const fs::path& file, double unit, PoseAxes axes,
                                  std::atomic<std::size_t>& all_left_out) {
  const auto [cloud, viewpoint, left_out] = read_cloud_file(file);
  all_left_out += left_out;
  const Eigen::Matrix3d to_camera =
      axes == PoseAxes::body ? Eigen::Matrix3d(camera_in_body().linear().transpose()) : Eigen::Matrix3d::Identity();
  std::vector<Vector3> points;
  points.reserve(cloud.size());
  for (const Eigen::Vector3f& point : cloud) points.push_back(to_camera * (unit * point.cast<double>()));
  return points;
}

/// Where the clouds' files say themselves that the sensor was.
FramePoses viewpoints(const std::vector<FrameFile>& files, PoseAxes axes) {
  FramePoses poses;
  for (const FrameFile& frame : files) {
    const Pose T_world_sensor = read_viewpoint(frame.file).value_or(Pose::Identity());
    poses.T_world_camera.push_back(axes == PoseAxes::body ? T_world_sensor * camera_in_body() : T_world_sensor);
  }
  return poses;
}

void list_clouds(const DescribedDataset& dataset, double unit, Recording& recording) {
  const DatasetDescription& d = dataset.description;
  const std::vector<FrameFile> files = find_frames(dataset);
  for (const FrameFile& frame : files) {
    recording.files.push_back(frame.file);
    recording.frames.push_back(
        {frame.name, Pose::Identity(),
         [file = frame.file, unit, axes = d.pose_axes, left_out = recording.left_out]() -> Measured {
           return cloud_points(file, unit, axes, *left_out);
         }});
  }
  FramePoses poses = d.poses.empty() ? viewpoints(files, d.pose_axes) : find_poses(dataset.folder, files, d);
  scale(poses, unit);
  place_frames(recording, poses, d.offset());
}

void list_graph(const DescribedDataset& dataset, Recording& recording) {
  const fs::path file = single_file(dataset);
  recording.files.push_back(file);
  std::size_t number = 0;
  for (const ScanGraphNode& node : read_scan_graph(file))
    recording.frames.push_back({fmt::format("scan {}", ++number), node.T_world_camera,
                                [file, node]() -> Measured { return read_scan_graph_points(file, node); }});
}

/// The scans of a scene, which is read as a whole.
void list_scans(const std::shared_ptr<const RecordedScene>& scene, const std::vector<std::string>& names,
                Recording& recording) {
  for (std::size_t i = 0; i < scene->scans.size(); ++i)
    recording.frames.push_back({i < names.size() ? names[i] : fmt::format("scan {}", i + 1),
                                scene->scans[i].T_world_camera,
                                [scene, i]() -> Measured { return scene->scans[i].points; }});
}

void list_stanford(const DescribedDataset& dataset, double stand_off, double unit, Recording& recording) {
  const auto notice = [&](const std::string& text) { recording.guessed.push_back(text); };
  const auto scene =
      std::make_shared<RecordedScene>(read_range_scan_folder(dataset.folder, stand_off, 0.0, notice, unit));
  recording.guessed.push_back(fmt::format(
      "the scanner's distance is not told: it is taken to stand {} m off each scan's nearest point", stand_off));
  const fs::path conf = find_frame_files(dataset.folder, "*.conf").front().file;
  recording.files.push_back(conf);
  std::vector<std::string> names;
  for (const NamedPose& pose : read_poses(conf, PoseFormat::conf)) {
    names.push_back(fs::path(pose.heading).stem().string());
    const fs::path plain = dataset.folder / pose.heading;
    recording.files.push_back(fs::is_regular_file(plain) ? plain : fs::path(plain.string() + ".gz"));
  }
  list_scans(scene, names, recording);
}

void list_scene(const DescribedDataset& dataset, Recording& recording) {
  const fs::path file = single_file(dataset);
  const auto scene = std::make_shared<RecordedScene>(read_recorded_scene(file));
  recording.files.push_back(file);
  Eigen::AlignedBox3d box;
  int given = 0;
  for (const int axis : {0, 1, 2})
    for (const bool least : {true, false}) {
      const auto found = scene->parameters.find(fmt::format("bbox_{}_{}_m", least ? "min" : "max", "xyz"[axis]));
      if (found == scene->parameters.end()) continue;
      (least ? box.min() : box.max())[axis] = found->second;
      ++given;
    }
  if (given == 6 && (box.sizes().array() > 0.0).all()) recording.region = box;
  list_scans(scene, {}, recording);
}

}  // namespace

Recording list_frames(const DescribedDataset& dataset, const RecordingOptions& options, double unit) {
  Recording recording;
  recording.format = name(dataset.description.format);
  recording.guessed = dataset.guessed;
  recording.region = dataset.description.region_box();
  if (!dataset.description_file.empty()) recording.files.push_back(dataset.description_file);
  switch (dataset.description.format) {
    case RecordingFormat::depth_images:
      list_images(dataset, unit, recording);
      break;
    case RecordingFormat::clouds:
      list_clouds(dataset, unit, recording);
      break;
    case RecordingFormat::stanford:
      list_stanford(dataset, options.stand_off, unit, recording);
      break;
    case RecordingFormat::scan_graph:
      list_graph(dataset, recording);
      break;
    case RecordingFormat::scene:
      list_scene(dataset, recording);
      break;
  }
  std::vector<RecordedFrame> taken;
  for (std::size_t i = 0; i < recording.frames.size(); i += static_cast<std::size_t>(options.every))
    taken.push_back(std::move(recording.frames[i]));
  recording.frames = std::move(taken);
  return recording;
}

}  // namespace nextview
