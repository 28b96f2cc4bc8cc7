#include "core/view/pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "core/file/read_file.hpp"

namespace nextview {
namespace {

/// Whether a line begins a file without a count: it has as many words as a view.
bool is_view(const std::string& line) {
  std::istringstream words(line);
  return std::distance(std::istream_iterator<std::string>(words), {}) >= 7;
}

/// 0 if the line is no count.
std::size_t count_of(const std::string& line) {
  std::istringstream text(line);
  std::size_t count = 0;
  return text >> count && (text >> std::ws).eof() ? count : 0;
}

}  // namespace

Pose look_at(const Vector3& position, const Vector3& target) {
  const Vector3 forward = (target - position).normalized();
  // Along the vertical the world's z axis gives no sense of up.
  const bool vertical = std::hypot(forward.x(), forward.y()) < 1e-6;
  const Vector3 up = vertical ? Vector3::UnitY() : Vector3::UnitZ();
  const Vector3 right = forward.cross(up).normalized();
  Pose T_world_camera = Pose::Identity();
  T_world_camera.linear() << right, forward.cross(right), forward;
  T_world_camera.translation() = position;
  return T_world_camera;
}

Pose make_pose(const Vector3& position, const Eigen::Quaterniond& orientation) {
  Pose pose = Pose::Identity();
  pose.linear() = orientation.normalized().toRotationMatrix();
  pose.translation() = position;
  return pose;
}

bool is_pose(const Pose& pose) {
  const Eigen::Matrix3d r = pose.linear();
  return pose.matrix().allFinite() && pose.translation().cwiseAbs().maxCoeff() <= farthest_pose &&
         (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6 && r.determinant() > 0.0;
}

double rotation_angle(const Pose& a, const Pose& b) {
  return Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()));
}

Pose parse_view(const std::string& text) {
  std::istringstream line(text);
  Eigen::Matrix<double, 7, 1> v;
  for (double& value : v)
    if (!(line >> value)) throw std::invalid_argument("expected a view as `x y z qx qy qz qw`");
  if (!(line >> std::ws).eof()) throw std::invalid_argument("more than a view's seven numbers `x y z qx qy qz qw`");
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!v.allFinite() || std::abs(q.norm() - 1.0) > 1e-3)
    throw std::invalid_argument("the view's quaternion (qx qy qz qw) must be finite and of length 1");
  if (v.head<3>().cwiseAbs().maxCoeff() > farthest_pose)
    throw std::invalid_argument(fmt::format("the view lies over {:g} m off", farthest_pose));
  return make_pose(v.head<3>(), q);
}

std::vector<Pose> read_views(const std::filesystem::path& file) {
  constexpr std::uintmax_t largest = std::uintmax_t{1} << 25;  // bytes; the most views take about half of that
  constexpr std::size_t most = 100'000;
  std::istringstream in(read_file(file, largest));
  const auto fail = [&](std::size_t line, const std::string& reason) {
    return std::runtime_error(fmt::format("{}:{}: {}", file.string(), line, reason));
  };
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  while (!lines.empty() && lines.back().find_first_not_of(" \t\r") == std::string::npos) lines.pop_back();
  std::size_t first = 0;
  while (first < lines.size() && lines[first].starts_with('#')) ++first;
  const bool counted = first < lines.size() && !is_view(lines[first]);
  const std::size_t count = counted ? count_of(lines[first]) : lines.size() - first;
  if (count == 0 || count > most)
    throw fail(first + 1,
               fmt::format("expected views as `x y z qx qy qz qw` a line, or first the number of views, from 1 "
                           "to {}, alone on a line",
                           most));
  if (counted) ++first;
  if (lines.size() - first > count)
    throw fail(first + count + 1, fmt::format("more than the {} views that the first line tells", count));
  std::vector<Pose> views;
  for (std::size_t i = first; i < lines.size(); ++i) try {
      views.push_back(parse_view(lines[i]));
    } catch (const std::invalid_argument& error) {
      throw fail(i + 1, error.what());
    }
  if (views.size() < count)
    throw fail(lines.size() + 1, fmt::format("expected {} views, found {}", count, views.size()));
  return views;
}

}  // namespace nextview
