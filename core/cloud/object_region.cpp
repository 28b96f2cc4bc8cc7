#include "core/cloud/object_region.hpp"

#include <fmt/format.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "core/cloud/object_box.hpp"
#include "core/cloud/point_spacing.hpp"
#include "core/cloud/thinned_points.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

constexpr double points_across = 250.0;    // the diagonal of all that was seen
constexpr double sparse = 1.5;             // surfaces seen aslant have fewer points [usual distances of points]
constexpr std::size_t most_planes = 6;     // that are looked at, largest first
constexpr double least_share = 0.1;        // of what was seen, that a plane behind the object is
constexpr double in_front = 0.95;          // of the rest, that lies on the side from which the plane was seen
constexpr double cluster_gap = 3.0;        // between pieces [spacings]
constexpr std::size_t least_cluster = 20;  // points
constexpr int directions = 24;             // in a plane, in which it may go on beyond the object
constexpr double going_on = 0.7;           // of those
constexpr double beyond = 0.1;             // of the object's diameter, how far

using Indices = std::vector<std::size_t>;

/// What was seen, thinned, and from which side.
struct Seen {
  ThinnedPoints thinned;
  std::vector<Vector3> towards_camera;  ///< of each thinned point: the sum of the unit vectors of those it stands for
  double spacing = 0.0;                 ///< [m]
  double thickness = 0.0;               ///< of a plane, to either side [m]
};

struct Plane {
  Vector3 normal;  ///< to the side from which it was seen
  double offset = 0.0;
  Indices points;

  double height(const Vector3& p) const { return normal.dot(p) + offset; }
};

PointCloud all_hits(std::span<const std::shared_ptr<const Scan>> scans) {
  PointCloud all;
  for (const auto& scan : scans) all.insert(all.end(), scan->hits.begin(), scan->hits.end());
  return all;
}

Seen look(std::span<const std::shared_ptr<const Scan>> scans, const PointCloud& hits, double noise) {
  Seen seen;
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : hits) box.extend(p);
  seen.spacing =
      std::max({double(box.diagonal().norm()) / points_across, 2.0 * noise, sparse * point_spacing(hits), 1e-6});
  seen.thickness = std::max(seen.spacing, 3.0 * noise);
  seen.thinned = thinned(hits, seen.spacing);
  seen.towards_camera.assign(seen.thinned.positions.size(), Vector3::Zero());
  std::size_t hit = 0;
  for (const auto& scan : scans)
    for (std::size_t i = 0; i < scan->hits.size(); ++i) {
      const std::uint32_t at = seen.thinned.of_point[hit++];
      seen.towards_camera[at] += (scan->origin - seen.thinned.positions[at]).normalized();
    }
  return seen;
}

pcl::PointCloud<pcl::PointXYZ>::Ptr to_pcl(const Seen& seen, const Indices& points) {
  auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const std::size_t i : points) {
    const Eigen::Vector3f p = (seen.thinned.positions[i] - seen.thinned.positions.front()).cast<float>();
    cloud->emplace_back(p.x(), p.y(), p.z());
  }
  return cloud;
}

/// The plane with the most of these points. PCL draws its samples from a fixed seed.
Plane largest_plane(const Seen& seen, const Indices& points) {
  const auto model = std::make_shared<pcl::SampleConsensusModelPlane<pcl::PointXYZ>>(to_pcl(seen, points));
  pcl::RandomSampleConsensus<pcl::PointXYZ> search(model, seen.thickness);
  search.setProbability(0.999);
  search.setMaxIterations(2000);
  Plane plane;
  if (points.size() < 3 || !search.computeModel()) return plane;
  Eigen::VectorXf coefficients, refined;
  std::vector<int> inliers;
  search.getInliers(inliers);
  search.getModelCoefficients(coefficients);
  model->optimizeModelCoefficients(inliers, coefficients, refined);
  model->selectWithinDistance(refined, seen.thickness, inliers);
  plane.normal = refined.head<3>().cast<double>();
  plane.offset = double(refined[3]) - plane.normal.dot(seen.thinned.positions.front());
  double seen_from = 0.0;
  for (const int i : inliers) {
    plane.points.push_back(points[std::size_t(i)]);
    seen_from += plane.normal.dot(seen.towards_camera[plane.points.back()]);
  }
  if (seen_from < 0.0) {
    plane.normal = -plane.normal;
    plane.offset = -plane.offset;
  }
  return plane;
}

Indices without(const Indices& points, const Indices& others) {  // both ascending
  Indices left;
  std::ranges::set_difference(points, others, std::back_inserter(left));
  return left;
}

/// Whether what else was seen lies on the side from which the plane was.
bool lies_behind(const Seen& seen, const Plane& plane) {
  std::size_t front = 0, back = 0;
  for (const Vector3& p : seen.thinned.positions) {
    const double height = plane.height(p);
    front += height > seen.thickness;
    back += height < -seen.thickness;
  }
  return front > 0 && double(front) >= in_front * double(front + back);
}

/// Whether the plane goes on around the object, not just to one side.
bool goes_on_around(const Seen& seen, const Plane& plane, const Indices& object) {
  const Vector3 u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
  Eigen::AlignedBox3d box;
  for (const std::size_t i : object) box.extend(seen.thinned.positions[i]);
  const double enough = beyond * box.diagonal().norm();
  int count = 0;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / directions;
    const Vector3 direction = std::cos(angle) * u + std::sin(angle) * v;
    const auto along = [&](std::size_t i) { return direction.dot(seen.thinned.positions[i]); };
    const auto farthest = [&](const Indices& points) { return along(*std::ranges::max_element(points, {}, along)); };
    count += farthest(plane.points) > farthest(object) + enough;
  }
  return double(count) >= going_on * directions;
}

/// The connected pieces of these points, largest first.
std::vector<Indices> pieces(const Seen& seen, const Indices& points) {
  if (points.empty()) return {};
  const auto cloud = to_pcl(seen, points);
  const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(cluster_gap * seen.spacing);
  extraction.setMinClusterSize(int(least_cluster));
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> found;
  extraction.extract(found);
  std::vector<Indices> all;
  for (const pcl::PointIndices& piece : found) {
    Indices& own = all.emplace_back();
    for (const int i : piece.indices) own.push_back(points[std::size_t(i)]);
    std::ranges::sort(own);
  }
  std::ranges::stable_sort(all, [](const Indices& a, const Indices& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return all;
}

Indices everything(const Seen& seen) {
  Indices all(seen.thinned.positions.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  return all;
}

std::vector<Plane> planes_behind(const Seen& seen, const std::stop_token& stop) {
  std::vector<Plane> behind;
  Indices rest = everything(seen);
  const double least = least_share * double(rest.size());
  for (std::size_t k = 0; k < most_planes && double(rest.size()) >= least; ++k) {
    throw_if_stopped(stop);
    Plane plane = largest_plane(seen, rest);
    if (double(plane.points.size()) < least) break;
    rest = without(rest, plane.points);
    if (lies_behind(seen, plane)) behind.push_back(std::move(plane));
  }
  return behind;
}

std::vector<Indices> pieces_without(const Seen& seen, const std::vector<Plane>& planes) {
  Indices rest = everything(seen);
  for (const Plane& plane : planes) rest = without(rest, plane.points);
  return pieces(seen, rest);
}

void fill(ObjectRegion& region, const Seen& seen, const PointCloud& hits, const Indices& object, double margin) {
  std::vector<bool> kept(seen.thinned.positions.size());
  for (const std::size_t i : object) kept[i] = true;
  for (std::size_t i = 0; i < hits.size(); ++i)
    if (kept[seen.thinned.of_point[i]]) region.points.push_back(hits[i]);
  if (region.points.empty()) return;
  Vector3 towards_cameras = Vector3::Zero();
  for (const std::size_t i : object) towards_cameras += seen.towards_camera[i];
  std::vector<Vector3> normals;
  for (const BackgroundPlane& plane : region.planes) normals.push_back(plane.normal);
  region.box = object_box(region.points, towards_cameras / double(region.points.size()), normals);
  const Vector3 around = Vector3::Constant(std::max(margin * region.box.sizes().maxCoeff(), seen.thickness));
  region.box = {region.box.min() - around, region.box.max() + around};
}

}  // namespace

ObjectRegion find_object(std::span<const std::shared_ptr<const Scan>> scans, const ObjectRegionConfig& config,
                         const std::stop_token& stop) {
  if (!(config.margin >= 0.0) || !(config.range_noise >= 0.0))
    throw std::invalid_argument("region of an object: margin and noise must be at least 0");
  ObjectRegion region;
  const PointCloud hits = all_hits(scans);
  if (hits.empty()) return region;
  const Seen seen = look(scans, hits, config.range_noise);
  region.spacing = seen.spacing;
  std::vector<Plane> planes;
  if (config.remove_planes) planes = planes_behind(seen, stop);
  std::vector<Indices> found = pieces_without(seen, planes);
  // Without a plane that was one of the object's the object is another: each is looked at again.
  for (auto plane = planes.begin(); plane != planes.end();) {
    throw_if_stopped(stop);
    if (!found.empty() && goes_on_around(seen, *plane, found.front())) {
      ++plane;
      continue;
    }
    planes.erase(plane);
    found = pieces_without(seen, planes);
    plane = planes.begin();
  }
  for (const Plane& plane : planes)
    region.planes.push_back(
        {plane.normal, plane.offset, double(plane.points.size()) / double(seen.thinned.positions.size())});
  region.clusters = found.size();
  if (!found.empty()) fill(region, seen, hits, found.front(), config.margin);
  return region;
}

std::string ObjectRegion::text() const {
  if (points.empty()) return "no object was found in the scan";
  const Vector3 size = 1e3 * box.sizes();
  std::string text =
      fmt::format("the object lies in a box of {:.0f} x {:.0f} x {:.0f} mm", size.x(), size.y(), size.z());
  for (const BackgroundPlane& plane : planes)
    text += fmt::format("; left out: a plane, {:.0f} % of what was seen", 100.0 * plane.share);
  if (clusters > 1) text += fmt::format("; left out: {} smaller pieces", clusters - 1);
  return text;
}

}  // namespace nextview
