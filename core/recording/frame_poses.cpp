#include "core/recording/frame_poses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>

#include "core/file/counted.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr double largest_time_difference = 0.02;  // [s]

/// Of a file; what is guessed is noted once, for all files are alike.
std::vector<NamedPose> poses_of(const fs::path& file, const DatasetDescription& d, FramePoses& found) {
  const auto note = [&](const std::string& text) {
    if (std::ranges::find(found.guessed, text) == found.guessed.end()) found.guessed.push_back(text);
  };
  return read_poses(file, d.poses_format, d.pose_direction, d.pose_axes, note);
}

using Taken = std::vector<const NamedPose*>;

/// So many poses, without what is none if there are more; none if that does not do.
Taken in_order(const std::vector<NamedPose>& poses, std::size_t count) {
  Taken taken;
  for (const NamedPose& pose : poses)
    if (poses.size() == count || pose.fault.empty()) taken.push_back(&pose);
  return taken.size() == count ? taken : Taken{};
}

std::optional<Pose> pose_in(const fs::path& file, const DatasetDescription& d, FramePoses& found) {
  const std::vector<NamedPose> poses = poses_of(file, d, found);
  const Taken one = in_order(poses, 1);
  if (one.empty())
    throw std::runtime_error(
        fmt::format("{}: holds {} poses where one frame's is expected", file.string(), poses.size()));
  return one.front()->pose();
}

/// Poses whose frames are not there. A file without a number may be anything.
void note_unused(const std::vector<FrameFile>& files, const std::vector<const FrameFile*>& used, FramePoses& found) {
  std::vector<const FrameFile*> unused;
  for (const FrameFile& file : files)
    if (last_number(file.key) && std::ranges::find(used, &file) == used.end()) unused.push_back(&file);
  if (!unused.empty())
    found.guessed.push_back(fmt::format("{} without a frame {} left out, {} for example",
                                        counted(unused.size(), "pose"), unused.size() == 1 ? "is" : "are",
                                        unused.front()->file.filename().string()));
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
  note_unused(files, file_of, found);
  for (const FrameFile* file : file_of) {
    found.T_world_camera.push_back(file ? pose_in(file->file, d, found) : std::nullopt);
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

const NamedPose* by_time(const FrameFile& frame, const std::vector<NamedPose>& poses) {
  const std::optional<double> time = time_of(frame);
  if (!time) return nullptr;
  const auto difference = [&](const NamedPose& pose) { return std::abs(*pose.time - *time); };
  const auto nearest_pose = std::ranges::min_element(poses, {}, difference);
  return difference(*nearest_pose) <= largest_time_difference ? &*nearest_pose : nullptr;
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

const NamedPose* by_name(const FrameFile& frame, const std::vector<NamedPose>& poses) {
  const auto names_it = [&](const NamedPose& pose) { return contains_word(pose.heading, frame.name); };
  const auto found = std::ranges::find_if(poses, names_it);
  return found == poses.end() ? nullptr : &*found;
}

const NamedPose* by_number(const FrameFile& frame, const std::vector<NamedPose>& poses) {
  const std::optional<std::string> number = last_number(frame.key.empty() ? frame.name : frame.key);
  const auto has_it = [&](const NamedPose& pose) { return number && last_number(pose.heading) == number; };
  const auto found = std::ranges::find_if(poses, has_it);
  return found == poses.end() ? nullptr : &*found;
}

bool is_each_ones_own(const Taken& taken) {
  return std::set<const NamedPose*>(taken.begin(), taken.end()).size() == taken.size() &&
         std::ranges::find(taken, nullptr) == taken.end();
}

/// Of a file without times. Numbers that do not tell the frames apart mean something else ("pose (4x4)").
Taken by_headings(const std::vector<FrameFile>& frames, const std::vector<NamedPose>& poses, const fs::path& file,
                  FramePoses& found) {
  Taken taken;
  bool any_name = false;
  for (const FrameFile& frame : frames) {
    const NamedPose* const named = by_name(frame, poses);
    any_name |= named != nullptr;
    taken.push_back(named ? named : by_number(frame, poses));
  }
  if (any_name || is_each_ones_own(taken)) return taken;
  Taken ordered = in_order(poses, frames.size());
  if (ordered.empty()) return taken;
  found.guessed.push_back(
      fmt::format("{}: no headings tell whose its poses are; they are taken in order", file.filename().string()));
  return ordered;
}

FramePoses from_one_file(const std::vector<FrameFile>& frames, const fs::path& file, const DatasetDescription& d) {
  FramePoses found{{}, {file}};
  const std::vector<NamedPose> poses = poses_of(file, d, found);
  Taken taken;
  if (d.poses_format == PoseFormat::tum)
    for (const FrameFile& frame : frames) taken.push_back(by_time(frame, poses));
  else
    taken = by_headings(frames, poses, file, found);
  for (const NamedPose* pose : taken) found.T_world_camera.push_back(pose ? pose->pose() : std::nullopt);
  if (std::ranges::any_of(taken, [](const NamedPose* pose) { return pose != nullptr; })) return found;
  if (d.poses_format == PoseFormat::tum)
    throw std::runtime_error(fmt::format("{}: no frame's name is a time within {} s of a pose's, {} for example",
                                         file.string(), largest_time_difference, frames.front().name));
  throw std::runtime_error(fmt::format("{}: holds {} for {}, and no headings that name them", file.string(),
                                       counted(poses.size(), "pose"), counted(frames.size(), "frame")));
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
