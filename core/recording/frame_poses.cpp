#include "core/recording/frame_poses.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>

#include "core/file/counted.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr double largest_time_difference = 0.02;  // [s]

Pose pose_in(const fs::path& file, const DatasetDescription& d) {
  const std::vector<NamedPose> poses = read_poses(file, d.poses_format, d.pose_direction, d.pose_axes);
  if (poses.size() != 1)
    throw std::runtime_error(
        fmt::format("{}: holds {} poses where one frame's is expected", file.string(), poses.size()));
  return poses.front().T_world_camera;
}

FramePoses from_a_file_each(const std::vector<FrameFile>& frames, const std::vector<FrameFile>& files,
                            const DatasetDescription& d) {
  FramePoses found;
  bool any = false;
  std::vector<const FrameFile*> file_of;
  for (const FrameFile& frame : frames) {
    const auto file = std::ranges::find_if(files, [&](const FrameFile& f) { return same_key(f.key, frame.key); });
    file_of.push_back(file == files.end() ? nullptr : &*file);
    any |= file_of.back() != nullptr;
  }
  if (!any && files.size() == frames.size())
    for (std::size_t i = 0; i < files.size(); ++i) file_of[i] = &files[i];
  for (const FrameFile* file : file_of) {
    found.T_world_camera.push_back(file ? std::optional(pose_in(file->file, d)) : std::nullopt);
    if (file) found.files.push_back(file->file);
  }
  return found;
}

std::optional<double> time_of(const FrameFile& frame) {
  double time = 0.0;
  const auto [end, error] = std::from_chars(frame.key.data(), frame.key.data() + frame.key.size(), time);
  if (error != std::errc() || end != frame.key.data() + frame.key.size()) return std::nullopt;
  return time;
}

std::optional<Pose> by_time(const FrameFile& frame, const std::vector<NamedPose>& poses) {
  const std::optional<double> time = time_of(frame);
  if (!time) return std::nullopt;
  const auto difference = [&](const NamedPose& pose) { return std::abs(*pose.time - *time); };
  const auto nearest_pose = std::ranges::min_element(poses, {}, difference);
  return difference(*nearest_pose) <= largest_time_difference ? std::optional(nearest_pose->T_world_camera)
                                                              : std::nullopt;
}

/// Whether a text holds a word, not as a part of a longer word or number.
bool contains_word(const std::string& text, const std::string& word) {
  const auto goes_on = [&](std::size_t at) {
    return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at]));
  };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if ((at == 0 || !goes_on(at - 1)) && !goes_on(at + word.size())) return true;
  return false;
}

std::optional<Pose> by_heading(const FrameFile& frame, const std::vector<NamedPose>& poses) {
  for (const NamedPose& pose : poses)
    if (contains_word(pose.heading, frame.name)) return pose.T_world_camera;
  const std::optional<std::string> number = last_number(frame.key.empty() ? frame.name : frame.key);
  for (const NamedPose& pose : poses)
    if (number && last_number(pose.heading) == number) return pose.T_world_camera;
  return std::nullopt;
}

FramePoses from_one_file(const std::vector<FrameFile>& frames, const fs::path& file, const DatasetDescription& d) {
  const std::vector<NamedPose> poses = read_poses(file, d.poses_format, d.pose_direction, d.pose_axes);
  FramePoses found{{}, {file}};
  bool any = false;
  for (const FrameFile& frame : frames) {
    found.T_world_camera.push_back(d.poses_format == PoseFormat::tum ? by_time(frame, poses)
                                                                     : by_heading(frame, poses));
    any |= found.T_world_camera.back().has_value();
  }
  if (any) return found;
  if (d.poses_format == PoseFormat::tum)
    throw std::runtime_error(fmt::format("{}: no frame's name is a time within {} s of a pose's, {} for example",
                                         file.string(), largest_time_difference, frames.front().name));
  if (poses.size() != frames.size())
    throw std::runtime_error(fmt::format("{}: holds {} for {}, and no headings that name them", file.string(),
                                         counted(poses.size(), "pose"), counted(frames.size(), "frame")));
  for (std::size_t i = 0; i < poses.size(); ++i) found.T_world_camera[i] = poses[i].T_world_camera;
  return found;
}

}  // namespace

FramePoses find_poses(const fs::path& folder, const std::vector<FrameFile>& frames, const DatasetDescription& d) {
  const std::vector<FrameFile> files = find_frame_files(folder, d.poses);
  if (files.empty())
    throw std::runtime_error(fmt::format("{}: there is no file '{}' of poses", folder.string(), d.poses));
  FramePoses found = d.poses.find('*') == std::string::npos ? from_one_file(frames, files.front().file, d)
                                                            : from_a_file_each(frames, files, d);
  if (std::ranges::none_of(found.T_world_camera, [](const auto& pose) { return pose.has_value(); }))
    throw std::runtime_error(fmt::format("{}: none of the files '{}' has the name or number of a frame, {} for example",
                                         folder.string(), d.poses, frames.front().name));
  return found;
}

}  // namespace nextview
