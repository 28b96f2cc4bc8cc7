#include "core/recording/recording.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>

#include "core/file/counted.hpp"
#include "core/progress/stopped.hpp"
#include "core/recording/cloud_camera.hpp"
#include "core/recording/cloud_file.hpp"
#include "core/recording/doubted_unit.hpp"
#include "core/recording/recorded_frames.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// What all frames together measured.
class Survey {
 public:
  void add(const RecordedFrame& frame, const Measured& measured) {
    const std::size_t before = points_;
    if (const auto* image = std::get_if<DepthImage>(&measured))
      add_image(frame, *image);
    else
      add_points(frame, std::get<std::vector<Vector3>>(measured));
    if (points_ == before) empty_.push_back(frame.name);
  }

  /// With lengths times `unit` [m].
  void tell(Recording& recording, double unit, const DescribedDataset& dataset) const {
    recording.camera = camera_ ? *camera_ : cloud_camera_.camera();
    recording.extent = {extent_.min() * unit, extent_.max() * unit};
    recording.max_range = 1.01 * farthest_ * unit;
    recording.points = points_;
    if (const std::string outside = cloud_camera_.outside(); !camera_ && !outside.empty())
      recording.guessed.push_back(outside);
    Eigen::AlignedBox3d cameras;
    for (const RecordedFrame& frame : recording.frames) cameras.extend(frame.T_world_camera.translation());
    recording.doubt = doubted_unit(dataset, cameras.diagonal().norm(), unit * ranges_ / double(points_));
    if (!recording.doubt.empty()) recording.guessed.push_back(recording.doubt);
    if (!empty_.empty())
      recording.guessed.push_back(
          fmt::format("{} measured nothing, {} for example", counted(empty_.size(), "frame"), empty_.front()));
  }
  std::size_t points() const { return points_; }
  double longest_side() const { return extent_.sizes().maxCoeff(); }

 private:
  void add_point(const Pose& T_world_camera, const Vector3& point) {
    const double range = point.norm();
    extent_.extend(T_world_camera * point);
    farthest_ = std::max(farthest_, range);
    ranges_ += range;
    ++points_;
  }
  void add_image(const RecordedFrame& frame, const DepthImage& image) {
    if (!camera_) camera_ = image.camera;
    if (camera_->width != image.camera.width || camera_->height != image.camera.height)
      throw std::runtime_error(fmt::format("the image has {} x {} pixels, those before it {} x {}", image.camera.width,
                                           image.camera.height, camera_->width, camera_->height));
    std::size_t i = 0;
    for (int v = 0; v < image.camera.height; ++v)
      for (int u = 0; u < image.camera.width; ++u, ++i)
        if (const float range = image.range[i]; DepthImage::is_range(range))
          add_point(frame.T_world_camera, range * image.camera.direction(u, v));
  }
  void add_points(const RecordedFrame& frame, const std::vector<Vector3>& points) {
    for (const Vector3& point : points) {
      add_point(frame.T_world_camera, point);
      cloud_camera_.see(point);
    }
    cloud_camera_.end_of_frame();
  }

  std::optional<PinholeCamera> camera_;  ///< of images
  CloudCamera cloud_camera_;
  Eigen::AlignedBox3d extent_;
  double farthest_ = 0.0, ranges_ = 0.0;  ///< the largest range, and their sum
  std::size_t points_ = 0;
  std::vector<std::string> empty_;  ///< names of frames
};

/// What a frame measured, or why it cannot be read.
struct ReadFrame {
  Measured measured;
  std::exception_ptr failure;
};

/// By several threads: to take a file apart takes longer than what is then done with it.
std::vector<ReadFrame> read_frames(std::span<const RecordedFrame> frames) {
  std::vector<ReadFrame> all(frames.size());
  tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) {
    try {
      all[i].measured = frames[i].read();
    } catch (...) {  // it is told of when it is its turn, so that the first that is damaged is
      all[i].failure = std::current_exception();
    }
  });
  return all;
}

Survey survey(const fs::path& path, const Recording& recording, const Progress& progress, const std::stop_token& stop) {
  Survey survey;
  const std::span<const RecordedFrame> frames = recording.frames;
  // No more than are read at the same time: each may be large.
  const auto at_once = std::size_t(std::clamp(tbb::this_task_arena::max_concurrency(), 1, 8));
  std::vector<ReadFrame> ahead;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    throw_if_stopped(stop);
    const RecordedFrame& frame = frames[i];
    if (progress) progress(static_cast<double>(i) / static_cast<double>(frames.size()), "reading " + frame.name);
    if (i % at_once == 0) ahead = read_frames(frames.subspan(i, std::min(at_once, frames.size() - i)));
    const auto& [measured, failure] = ahead[i % at_once];
    if (failure) std::rethrow_exception(failure);
    try {
      survey.add(frame, measured);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}: {}: {}", path.string(), frame.name, error.what()));
    }
  }
  if (progress) progress(1.0, "reading");
  if (survey.points() == 0)
    throw std::runtime_error(
        fmt::format("{}: its {} measured nothing", path.string(), counted(recording.frames.size(), "frame")));
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
