#include "core/view/pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "core/file/read_file.hpp"

namespace nextview {

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

bool is_rigid(const Pose& pose) {
  const Eigen::Matrix3d r = pose.linear();
  return pose.matrix().allFinite() && (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6 &&
         r.determinant() > 0.0;
}

double rotation_angle(const Pose& a, const Pose& b) {
  return Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()));
}

std::vector<Pose> read_views(const std::filesystem::path& file) {
  constexpr std::uintmax_t largest = std::uintmax_t{1} << 25;  // bytes; the most views take about half of that
  std::istringstream in(read_file(file, largest));
  const auto fail = [&](std::size_t line, const std::string& reason) {
    return std::runtime_error(fmt::format("{}:{}: {}", file.string(), line, reason));
  };
  std::string text;
  std::size_t count = 0;
  const auto next_line = [&] { return std::getline(in, text) ? std::istringstream(text) : std::istringstream(); };
  std::istringstream first = next_line();
  if (!(first >> count) || !(first >> std::ws).eof() || count == 0 || count > 100'000)
    throw fail(1, "expected the number of views, from 1 to 100000, alone on the first line");
  std::vector<Pose> views;
  for (std::size_t i = 0; i < count; ++i) {
    std::istringstream line = next_line();
    if (!in) throw fail(i + 2, fmt::format("expected {} views, found {}", count, i));
    Eigen::Matrix<double, 7, 1> v;
    for (double& value : v)
      if (!(line >> value)) throw fail(i + 2, "expected a view as `x y z qx qy qz qw`");
    if (!(line >> std::ws).eof()) throw fail(i + 2, "more than a view's seven numbers `x y z qx qy qz qw`");
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (!v.allFinite() || std::abs(q.norm() - 1.0) > 1e-3)
      throw fail(i + 2, "the view's quaternion (qx qy qz qw) must be finite and of length 1");
    views.push_back(make_pose(v.head<3>(), q));
  }
  if (!(in >> std::ws).eof())
    throw fail(count + 2, fmt::format("more than the {} views that the first line tells", count));
  return views;
}

}  // namespace nextview
