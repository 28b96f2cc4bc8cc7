#include "ui/window/box_handles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nextview {
namespace {

constexpr double most_voxels = 512.0;  // that map.region takes along a side
/// Squared sine of the least angle between a line and a line of sight that tells where on it that points: 6 degrees.
constexpr double least_squared_sine = 0.01;

std::optional<Vector3> in_plane(const Vector3& point, const Vector3& normal, const Sight& sight) {
  const double towards = sight.direction.dot(normal), distance = (point - sight.origin).dot(normal);
  if (!(towards * distance > 0.0)) return {};
  return sight.origin + sight.direction * (distance / towards);
}

}  // namespace

Vector3 handle_place(const Eigen::AlignedBox3d& box, std::size_t handle) {
  Vector3 place = box.center();
  if (handle == centre_handle) return place;
  const auto axis = Eigen::Index(handle / 2);
  place[axis] = handle % 2 == 1 ? box.max()[axis] : box.min()[axis];
  return place;
}

std::optional<double> along_line(const Vector3& point, const Vector3& along, const Sight& sight) {
  const Vector3 direction = sight.direction.normalized(), from_eye = point - sight.origin;
  const double cosine = along.dot(direction), squared_sine = 1.0 - cosine * cosine;
  if (squared_sine < least_squared_sine) return {};
  return (cosine * direction.dot(from_eye) - along.dot(from_eye)) / squared_sine;
}

Eigen::AlignedBox3d dragged(const Eigen::AlignedBox3d& box, std::size_t handle, const Sight& from, const Sight& to,
                            const Vector3& forward, double voxel) {
  const Vector3 place = handle_place(box, handle);
  if (handle == centre_handle) {
    const auto start = in_plane(place, forward, from), end = in_plane(place, forward, to);
    if (!start || !end) return box;
    const Vector3 shift = ((*end - *start) / voxel).array().round() * voxel;
    return box.translated(shift);
  }
  const auto axis = Eigen::Index(handle / 2);
  const auto start = along_line(place, Vector3::Unit(axis), from), end = along_line(place, Vector3::Unit(axis), to);
  if (!start || !end) return box;
  const double moved = std::round((*end - *start) / voxel) * voxel, least = voxel, most = most_voxels * voxel;
  Eigen::AlignedBox3d result = box;
  if (handle % 2 == 1)
    result.max()[axis] = std::clamp(box.max()[axis] + moved, box.min()[axis] + least, box.min()[axis] + most);
  else
    result.min()[axis] = std::clamp(box.min()[axis] + moved, box.max()[axis] - most, box.max()[axis] - least);
  return result;
}

std::string region_text(const Eigen::AlignedBox3d& box) {
  const auto metres = [](double value) { return fmt::format("{:.6g}", std::abs(value) < 1e-9 ? 0.0 : value); };
  const Vector3 low = box.min(), high = box.max();
  return fmt::format("{} {} {} {} {} {}", metres(low.x()), metres(low.y()), metres(low.z()), metres(high.x()),
                     metres(high.y()), metres(high.z()));
}

}  // namespace nextview
