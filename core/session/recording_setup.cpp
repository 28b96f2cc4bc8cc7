#include "core/session/recording_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/config/object_lengths.hpp"
#include "core/journal/journal.hpp"
#include "core/recording/frame_files.hpp"
#include "core/session/saved_session.hpp"
#include "core/session/session_parts.hpp"
#include "core/session/taken_views.hpp"
#include "core/source/simulated_source.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr double margin = 0.1;  // around what was measured, of its longest side

/// What a session captured, in its order, from where it was believed to be.
Recording captured_by(const fs::path& folder, const Configuration& of_scan) {
  Recording recording;
  recording.format = "session";
  recording.camera = of_scan.sensor.camera();
  recording.max_range = of_scan.sensor.max_range;
  for (const JournalStep& step : read_journal(folder).line())
    recording.frames.push_back({fmt::format("step {}", recording.frames.size() + 1), step.believed,
                                [step, folder] { return read_capture(step, folder).measured; }});
  if (recording.frames.empty()) throw std::runtime_error(fmt::format("{}: holds no view", folder.string()));
  recording.region = Eigen::AlignedBox3d(configured_region(of_scan).lower(), configured_region(of_scan).upper());
  if (!of_scan.map.region.empty()) recording.region = of_scan.map.region_box();
  return recording;
}

/// What was given for this session goes before what the scan had.
void adopt_settings(Configuration& c, Configuration of_scan) {
  auto to = settings(c), from = settings(of_scan);
  for (std::size_t i = 0; i < to.size(); ++i) {
    const std::string& key = to[i].key;
    const bool own = key.starts_with("recorded.") || key.starts_with("termination.") || key.starts_with("object.");
    if (own || key == "sensor.preset" || is_given(c, key) || to[i].text() == from[i].text()) continue;
    to[i].set(from[i].text());
    c.fitted[key] = to[i].text();
  }
}

/// The views of a simulated scan, taken again: the same bytes.
Recording simulated_again(const fs::path& folder, Configuration of_scan, const std::stop_token& stop) {
  const ConfiguredObject object = load_object(of_scan, stop);
  const std::vector<Pose> views = views_taken(folder / "views.csv", of_scan);
  const auto world = std::make_shared<const SimulatedWorld>(object.placed, of_scan.sensor, stop);
  Recording recording;
  recording.format = "scan";
  recording.camera = world->camera.camera();
  recording.max_range = of_scan.sensor.max_range;
  for (std::uint32_t k = 0; k < views.size(); ++k)
    recording.frames.push_back({fmt::format("step {}", k + 1), views[k], [world, pose = views[k], k, of_scan] {
                                  return Measured(world->camera.sense(world->scene, pose, of_scan.seed, k + 1));
                                }});
  recording.region = Eigen::AlignedBox3d(configured_region(of_scan).lower(), configured_region(of_scan).upper());
  return recording;
}

/// Frames of a recording in the order in which a scan took them.
Recording taken_again(const fs::path& folder, const RecordedSource& source) {
  Recording recording = source.recording();
  std::vector<RecordedFrame> taken;
  for (const View& view : frames_listed(folder / "views.csv", source)) taken.push_back(recording.frames[*view.frame]);
  recording.frames = std::move(taken);
  return recording;
}

Recording open_scan_folder(Configuration& c, const fs::path& folder, const Progress& progress,
                           const std::stop_token& stop) {
  Configuration of_scan = read_configuration(folder / "config.toml");
  Recording recording;
  if (has_journal(folder)) {
    recording = captured_by(folder, of_scan);
  } else if (of_scan.recorded.folder.empty()) {
    recording = simulated_again(folder, of_scan, stop);
  } else {
    const auto source = open_configured_recording(of_scan, progress, stop);
    recording = taken_again(folder, *source);
    recording.region = of_scan.map.region_box();
  }
  adopt_settings(c, std::move(of_scan));
  std::vector<RecordedFrame> each;
  for (std::size_t k = 0; k < recording.frames.size(); k += std::size_t(c.recorded.every))
    each.push_back(std::move(recording.frames[k]));
  recording.frames = std::move(each);
  return recording;
}

void follow_camera(Configuration& c, const PinholeCamera& camera) {
  decide_camera(c, camera, "the recording");
  auto all = settings(c);
  for (const char* key : {"sensor.width", "sensor.height", "sensor.intrinsics"})
    c.fitted[key] = find_setting(all, key).text();
}

void follow_region(Configuration& c, const Recording& recording) {
  Eigen::AlignedBox3d box = recording.region.value_or(recording.extent);
  if (!recording.region) {
    const Vector3 around = Vector3::Constant(margin * box.sizes().maxCoeff());
    box = {box.min() - around, box.max() + around};
  }
  if (c.map.region.empty() && is_given(c, "map.region_edge"))
    box = {box.center() - Vector3::Constant(0.5 * c.map.region_edge),
           box.center() + Vector3::Constant(0.5 * c.map.region_edge)};
  const double voxel = c.map.resolution;
  const Vector3 low = (box.min() / voxel).array().floor() * voxel, high = (box.max() / voxel).array().ceil() * voxel;
  set_unless_given(c, "map.region",
                   fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}", low.x(), low.y(), low.z(), high.x(),
                               high.y(), high.z()));
}

std::vector<Pose> poses_of(const Recording& recording) {
  std::vector<Pose> poses;
  for (const RecordedFrame& frame : recording.frames) poses.push_back(frame.T_world_camera);
  return poses;
}

/// A recording ends when its frames do; what else may end it holds where it was given.
void follow_end(Configuration& c, const Recording& recording) {
  Configuration endless;
  endless.termination = TerminationConfig::unlimited();
  endless.termination.views = int(recording.frames.size());
  for (const Setting& setting : settings(endless.termination)) set_unless_given(c, setting.key, setting.text());
}

/// All that follows from a recording, where nothing was given.
void follow(Configuration& c, const Recording& recording) {
  // A region that follows from the recording has a margin; to go by that would give the next session other lengths.
  const Eigen::AlignedBox3d seen = recording.region.value_or(recording.extent);
  const Eigen::AlignedBox3d region = is_given(c, "map.region") ? c.map.region_box() : seen;
  if (!is_session(c.recorded.folder)) fit_lengths(c, region.sizes().maxCoeff());
  follow_camera(c, recording.camera);
  set_unless_given(c, "sensor.min_range", "0");
  if (!c.sources.contains("sensor.max_range")) {
    c.sensor.max_range = recording.max_range;
    c.fitted["sensor.max_range"] = fmt::format("{}", recording.max_range);
  }
  follow_region(c, recording);
  lengthen_rays(c, poses_of(recording));
  set_unless_given(c, "planner.cost_weight", "0");  // every frame is at hand, and nothing moves
  follow_end(c, recording);
}

/// As Configuration::fitted.
std::map<std::string, std::string> followed_alone(const Recording& recording, const RecordedConfig& recorded) {
  Configuration alone;
  alone.recorded = recorded;
  follow(alone, recording);
  return alone.fitted;
}

}  // namespace

std::unique_ptr<RecordedSource> open_configured_recording(Configuration& c, const Progress& progress,
                                                          const std::stop_token& stop) {
  Recording recording;
  try {
    const fs::path path = c.recorded.folder;
    recording = is_session(path) ? open_scan_folder(c, path, progress, stop)
                                 : open_recording(path, {c.recorded.every, c.recorded.stand_off}, progress, stop);
    follow(c, recording);
    recording.follows = followed_alone(recording, c.recorded);
    recording.max_range = std::min(recording.max_range, c.sensor.max_range);
    recording.region.reset();  // which is the configuration's from here on
    c = affordable(validated(std::move(c)));
    return std::make_unique<RecordedSource>(std::move(recording));
  } catch (const std::invalid_argument& error) {
    // Of a wrong unit lengths follow that no setting may have.
    throw std::invalid_argument(c.as_given(error.what()) + (recording.doubt.empty() ? "" : "; " + recording.doubt));
  }
}

std::vector<View> frames_listed(const fs::path& file, const RecordedSource& source) {
  const std::vector<View>& frames = source.describe().frames;
  const std::vector<Pose> poses = poses_of(frames);
  std::vector<View> listed;
  for (const Pose& pose : views_taken(file, poses, poses.front())) {
    const auto frame =
        std::ranges::find_if(frames, [&](const View& view) { return view.T_world_camera.matrix() == pose.matrix(); });
    if (frame == frames.end())
      throw std::runtime_error(fmt::format("{}: names a view that is no frame of the recording", file.string()));
    listed.push_back(*frame);
  }
  return listed;
}

std::uint32_t start_frame(const Configuration& c, const Recording& recording) {
  const std::string& wanted = c.recorded.start;
  if (wanted.empty()) return 0;
  const auto& frames = recording.frames;
  auto found = std::ranges::find(frames, wanted, &RecordedFrame::name);
  const auto is_meant = [&](const RecordedFrame& frame) {
    return same_key(last_number(frame.name).value_or(""), wanted);
  };
  if (found == frames.end()) found = std::ranges::find_if(frames, is_meant);
  if (found != frames.end()) return std::uint32_t(found - frames.begin());
  throw std::invalid_argument(
      c.as_given(fmt::format("recorded.start: there is no frame '{}'; there are {}, from {} to {}", wanted,
                             recording.frames.size(), recording.frames.front().name, recording.frames.back().name)));
}

std::shared_ptr<const RecordedSurface> recorded_surface(const Configuration& c, const Recording& recording,
                                                        const Progress& progress, const std::stop_token& stop) {
  const VoxelGrid region = configured_region(c);
  const auto cloud_of = [&](std::size_t frame) {
    const RecordedFrame& f = recording.frames[frame];
    PointCloud hits = to_scan({f.read(), f.T_world_camera, recording.max_range}, &c.cloud, stop).scan.hits;
    std::erase_if(hits, [&](const Eigen::Vector3f& p) { return !region.contains(region.cell_at(p.cast<double>())); });
    return hits;
  };
  try {
    return std::make_shared<const RecordedSurface>(recording.frames.size(), cloud_of, c.evaluation.d_reg, progress,
                                                   stop);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(
        c.as_given(fmt::format("{}: {} within the region of interest (map.region)", c.recorded.folder, error.what())));
  }
}

}  // namespace nextview
