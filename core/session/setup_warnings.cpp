#include "core/session/setup_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/evaluation/signed_distance.hpp"
#include "core/mesh/surface_samples.hpp"
#include "core/planner/policy.hpp"
#include "core/session/session_parts.hpp"
#include "core/setting/length_text.hpp"

namespace nextview {
namespace {

constexpr std::size_t samples = 1000;  // of the surface: near enough for what is said here
constexpr double min_voxels = 5.0;     // along the object's longest side
constexpr double min_in_image = 0.05;  // of the object, for a view to be more than a sliver

/// Where the views stand to the object. Points of the surface hide each other, which is left out here.
struct Standing {
  std::size_t views = 0, inside = 0, near = 0, far = 0, beyond_rays = 0, past = 0;
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;  ///< of all distances to the object [m]
  double max_in_image = 0.0;                                                 ///< share of the object, of all views
};

/// Distance from a point to the nearest of some [m].
double distance(const Vector3& from, std::span<const Eigen::Vector3f> points) {
  double squared = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& point : points) squared = std::min(squared, (point.cast<double>() - from).squaredNorm());
  return std::sqrt(squared);
}

double share_in_image(const Pose& T_world_camera, const PinholeCamera& camera,
                      std::span<const Eigen::Vector3f> points) {
  const Pose T_camera_world = T_world_camera.inverse();
  const auto in_image = std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3f& point) {
    const Vector3 p = T_camera_world * point.cast<double>();
    if (p.z() <= 0.0) return false;
    const Eigen::Vector2d pixel = camera.project(p);
    return pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < camera.width - 0.5 && pixel.y() < camera.height - 0.5;
  });
  return double(in_image) / double(points.size());
}

/// The corners and, as triangles may be large, points between them.
std::vector<Eigen::Vector3f> surface_points(const TriangleMesh& object) {
  std::vector<Eigen::Vector3f> points = sample_surface(object, samples, 1).points;
  const std::size_t stride = object.vertices.size() / samples + 1;
  for (std::size_t i = 0; i < object.vertices.size(); i += stride) points.push_back(object.vertices[i]);
  return points;
}

Standing standing(const Configuration& c, const TriangleMesh& object, std::span<const Pose> views) {
  const Eigen::AlignedBox3d box = object.bounding_box();
  const bool any_in_box = std::any_of(views.begin(), views.end(),
                                      [&](const Pose& view) { return box.contains(Vector3(view.translation())); });
  std::optional<SignedDistance> signed_distance;
  if (any_in_box) signed_distance.emplace(object);
  const std::vector<Eigen::Vector3f> points = surface_points(object);
  const PinholeCamera camera = c.sensor.camera();
  Standing s;
  s.views = views.size();
  for (const Pose& view : views) {
    const Vector3 at = view.translation();
    if (signed_distance && box.contains(at) && signed_distance->inside(at.cast<float>())) {
      ++s.inside;
      continue;
    }
    const double way = distance(at, points), in_image = share_in_image(view, camera, points);
    s.nearest = std::min(s.nearest, way);
    s.farthest = std::max(s.farthest, way);
    s.near += way < c.sensor.min_range;
    s.far += way > c.sensor.max_range;
    s.beyond_rays += way > c.planner.ray_length;
    s.past += in_image == 0.0;
    s.max_in_image = std::max(s.max_in_image, in_image);
  }
  return s;
}

/// What the views' warnings call them, and what changes where they are.
struct Naming {
  std::string whose, stand, radius;
};

void warn_of_views(const Configuration& c, const TriangleMesh& object, std::span<const Pose> views,
                   const Naming& naming, std::vector<std::string>& warnings) {
  const Standing s = standing(c, object, views);
  const double reach = 0.5 * object.bounding_box().diagonal().norm();
  const std::string& stand = naming.stand;
  const auto warn = [&](std::size_t count, const std::string& text) {
    if (count > 0) warnings.push_back(fmt::format("{} of {} views ({}): {}", count, s.views, naming.whose, text));
  };
  warn(s.inside, fmt::format("inside the object, where nothing of its outside is seen; it reaches {} from its centre: "
                             "change {} ({}), or scale it with object.longest_side",
                             length_text(reach), stand, naming.radius));
  warn(s.near, fmt::format("nearer to the object than sensor.min_range ({}), which gives no range; the nearest is {} "
                           "off: lower sensor.min_range, or change {}",
                           length_text(c.sensor.min_range), length_text(s.nearest), stand));
  warn(s.far, fmt::format("farther from the object than sensor.max_range ({}), where nothing is seen; the farthest is "
                          "{} off: raise sensor.max_range, or change {}",
                          length_text(c.sensor.max_range), length_text(s.farthest), stand));
  if (!policy_entry(c.planner.gain).baseline)
    warn(s.beyond_rays, fmt::format("scored by rays that end before the object: planner.ray_length is {}, and it is up "
                                    "to {} off: raise planner.ray_length",
                                    length_text(c.planner.ray_length), length_text(s.farthest)));
  if (s.inside < s.views && s.max_in_image < min_in_image)
    warnings.push_back(
        fmt::format("no view ({}) has more than {:.0f} % of the object in its image: widen "
                    "sensor.field_of_view ({:g} deg), or change {}",
                    naming.whose, std::ceil(100.0 * s.max_in_image), c.sensor.field_of_view, stand));
  else
    warn(s.past, fmt::format("nothing of the object in the image, which looks past it: change {}, or widen "
                             "sensor.field_of_view ({:g} deg)",
                             stand, c.sensor.field_of_view));
}

/// What makes the voxels of an object fine enough: there is a limit to how fine they are.
std::string finer_voxels(double longest) {
  MapConfig map;
  auto all = settings(map);
  const double finest = find_setting(all, "map.resolution").bounds->low;
  if (longest < min_voxels * finest)
    return fmt::format("none are finer than {}, so scan it larger: object.longest_side", length_text(finest));
  return fmt::format("lower map.resolution, for example to {}", length_text(std::max(finest, longest / 50.0)));
}

}  // namespace

std::vector<std::string> setup_warnings(const Configuration& c, const TriangleMesh& object,
                                        std::span<const Pose> candidates) {
  const double longest = object.bounding_box().sizes().maxCoeff();
  const bool from_file = c.views.layout == ViewLayout::file, own_start = !c.planner.start_view.empty();
  const std::string stand = from_file ? "the views of views.file" : "views.radius";
  const std::string radius = from_file ? c.views.file : length_text(c.views.radius);
  std::vector<std::string> warnings;
  std::vector<Pose> views(candidates.begin(), candidates.end());
  const Pose start = configured_start_view(c);
  if (own_start)
    warn_of_views(c, object, {&start, 1}, {"start view", "planner.start_view", c.planner.start_view}, warnings);
  else
    views.push_back(start);
  warn_of_views(c, object, views, {own_start ? "candidates" : "candidates and start view", stand, radius}, warnings);
  if (longest < min_voxels * c.map.resolution)
    warnings.push_back(fmt::format("voxels of {} are too coarse for an object {} long, which spans {:.1f} of them: {}",
                                   length_text(c.map.resolution), length_text(longest), longest / c.map.resolution,
                                   finer_voxels(longest)));
  if (!c.views.file.empty() && !from_file)
    warnings.push_back("views.file is not read: views.layout must be file for that");
  for (std::string& warning : warnings) warning = c.as_given(warning);
  return warnings;
}

}  // namespace nextview
