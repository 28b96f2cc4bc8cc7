#include "core/recording/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/file/counted.hpp"
#include "core/progress/make_ahead.hpp"
#include "core/progress/stopped.hpp"
#include "core/recording/cloud_camera.hpp"
#include "core/recording/cloud_file.hpp"
#include "core/recording/doubted_unit.hpp"
#include "core/recording/recorded_frames.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// Where points lie.
struct PointsExtent {
  Eigen::AlignedBox3d box;              ///< [m, world]
  double farthest = 0.0, ranges = 0.0;  ///< the largest range, and their sum [m]
  std::size_t count = 0;

  void add(const Pose& T_world_camera, const Vector3& point) {
    const double range = point.norm();
    box.extend(T_world_camera * point);
    farthest = std::max(farthest, range);
    ranges += range;
    ++count;
  }
  void add(const PointsExtent& others) {
    box.extend(others.box);
    farthest = std::max(farthest, others.farthest);
    ranges += others.ranges;
    count += others.count;
  }
};

PointsExtent extent_of(const DepthImage& image, const Pose& T_world_camera) {
  PointsExtent extent;
  std::size_t i = 0;
  for (int v = 0; v < image.camera.height; ++v)
    for (int u = 0; u < image.camera.width; ++u, ++i)
      if (const float range = image.range[i]; DepthImage::is_range(range))
        extent.add(T_world_camera, range * image.camera.direction(u, v));
  return extent;
}

/// What a frame measured.
struct ReadFrame {
  Measured measured;
  PointsExtent extent;  ///< of an image
};

/// What all frames together measured.
class Survey {
 public:
  void add(const RecordedFrame& frame, const ReadFrame& read) {
    const std::size_t before = points_.count;
    if (const auto* image = std::get_if<DepthImage>(&read.measured)) {
      require_same_size(image->camera);
      points_.add(read.extent);
    } else {
      add_points(frame, std::get<std::vector<Vector3>>(read.measured));
    }
    if (points_.count == before) empty_.push_back(frame.name);
  }

  /// With lengths times `unit` [m].
  void tell(Recording& recording, double unit, const DescribedDataset& dataset) const {
    recording.camera = camera_ ? *camera_ : cloud_camera_.camera();
    recording.extent = {points_.box.min() * unit, points_.box.max() * unit};
    recording.max_range = 1.01 * points_.farthest * unit;
    recording.points = points_.count;
    if (const std::string outside = cloud_camera_.outside(); !camera_ && !outside.empty())
      recording.guessed.push_back(outside);
    Eigen::AlignedBox3d cameras;
    for (const RecordedFrame& frame : recording.frames) cameras.extend(frame.T_world_camera.translation());
    recording.doubt = doubted_unit(dataset, cameras.diagonal().norm(), unit * points_.ranges / double(points_.count));
    if (!recording.doubt.empty()) recording.guessed.push_back(recording.doubt);
    if (!empty_.empty())
      recording.guessed.push_back(
          fmt::format("{} measured nothing, {} for example", counted(empty_.size(), "frame"), empty_.front()));
  }
  std::size_t points() const { return points_.count; }
  double longest_side() const { return points_.box.sizes().maxCoeff(); }

 private:
  void require_same_size(const PinholeCamera& camera) {
    if (!camera_) camera_ = camera;
    if (camera_->width != camera.width || camera_->height != camera.height)
      throw std::runtime_error(fmt::format("the image has {} x {} pixels, those before it {} x {}", camera.width,
                                           camera.height, camera_->width, camera_->height));
  }
  void add_points(const RecordedFrame& frame, const std::vector<Vector3>& points) {
    for (const Vector3& point : points) {
      points_.add(frame.T_world_camera, point);
      cloud_camera_.see(point);
    }
    cloud_camera_.end_of_frame();
  }

  std::optional<PinholeCamera> camera_;  ///< of images
  CloudCamera cloud_camera_;
  PointsExtent points_;
  std::vector<std::string> empty_;  ///< names of frames
};

/// With all that takes long and follows from one frame alone.
ReadFrame read_frame(const RecordedFrame& frame) {
  ReadFrame read{frame.read(), {}};
  if (const auto* image = std::get_if<DepthImage>(&read.measured))
    read.extent = extent_of(*image, frame.T_world_camera);
  return read;
}

Survey survey(const fs::path& path, const Recording& recording, const Progress& progress, const std::stop_token& stop) {
  Survey survey;
  const std::vector<RecordedFrame>& frames = recording.frames;
  const auto begin = [&](std::size_t i) {
    throw_if_stopped(stop);
    if (progress) progress(double(i) / double(frames.size()), "reading " + frames[i].name);
  };
  std::vector<ReadFrame> read(frames.size());
  const auto add = [&](std::size_t i) {
    try {
      survey.add(frames[i], std::exchange(read[i], {}));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}: {}: {}", path.string(), frames[i].name, error.what()));
    }
  };
  make_ahead(
      frames.size(), begin, [&](std::size_t i) { read[i] = read_frame(frames[i]); }, add);
  if (progress) progress(1.0, "reading");
  if (survey.points() == 0)
    throw std::runtime_error(
        fmt::format("{}: its {} measured nothing", path.string(), counted(frames.size(), "frame")));
  return survey;
}

double unit_length(CloudUnit unit) { return unit == CloudUnit::mm ? 1e-3 : unit == CloudUnit::cm ? 1e-2 : 1.0; }

}  // namespace

Recording open_recording(const fs::path& path, const RecordingOptions& options, const Progress& progress,
                         const std::stop_token& stop) {
  if (options.every < 1)
    throw std::invalid_argument(fmt::format("each n-th frame: n must be 1 or more, not {}", options.every));
  const DescribedDataset dataset = describe_dataset(path);
  const DatasetDescription& description = dataset.description;
  Recording recording = list_frames(dataset, options, unit_length(description.unit));
  const Survey found = survey(path, recording, progress, stop);
  constexpr double longest_in_metres = 10.0;  // as of objects
  const bool is_guess = description.format == RecordingFormat::clouds && description.unit == CloudUnit::automatic;
  const std::size_t left_out = *recording.left_out;
  const bool in_mm = is_guess && found.longest_side() > longest_in_metres;
  if (in_mm) recording = list_frames(dataset, options, unit_length(CloudUnit::mm));
  if (is_guess)
    recording.guessed.push_back(fmt::format("the clouds' unit is taken as {}, for they span {:.4g} (unit overrules it)",
                                            in_mm ? "mm" : "m", found.longest_side()));
  if (left_out > 0) recording.guessed.push_back("clouds of " + points_text(found.points(), left_out));
  found.tell(recording, in_mm ? unit_length(CloudUnit::mm) : 1.0, dataset);
  return recording;
}

}  // namespace nextview
