#include "core/surface/cloud_surface.hpp"

#include <fmt/format.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/surface/connected_pieces.hpp"
#include "core/surface/integrated_planes.hpp"
#include "core/surface/normal_orientation.hpp"

namespace nextview {
namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Tree = pcl::KdTreeFLANN<pcl::PointNormal>;

constexpr int neighbours = 20;      ///< of a point, for its normal and for a vertex's uncertainty
constexpr std::size_t fewest = 50;  ///< points that make a surface
constexpr std::size_t speck = 200;  ///< pieces with fewer triangles than this, some 10 x 10 cells, go
constexpr double largest_lattice = 1 << 28;

Eigen::Vector3f position(const pcl::PointNormal& p) { return p.getVector3fMap(); }
Eigen::Vector3f normal(const pcl::PointNormal& p) { return p.getNormalVector3fMap(); }

/// All hits that are finite; the normal is the direction to the camera.
Cloud::Ptr to_pcl(std::span<const Scan> scans) {
  auto cloud = std::make_shared<Cloud>();
  for (const Scan& scan : scans)
    for (const Eigen::Vector3f& point : scan.hits) {
      if (!point.allFinite()) continue;
      pcl::PointNormal p;
      p.getVector3fMap() = point;
      p.getNormalVector3fMap() = (scan.origin.cast<float>() - point).normalized();
      cloud->push_back(p);
    }
  return cloud;
}

/// Of some points of a scan, the squared distances to the nearest others that lie elsewhere.
std::vector<float> squared_spacings(const Scan& scan) {
  constexpr std::size_t samples = 500;
  const Cloud::Ptr cloud = to_pcl({&scan, 1});
  if (cloud->size() < 2) return {};
  Tree tree(false);
  tree.setInputCloud(cloud);
  pcl::Indices indices;
  std::vector<float> squared, found;
  for (std::size_t i = 0; i < cloud->size(); i += std::max<std::size_t>(1, cloud->size() / samples)) {
    tree.nearestKSearch((*cloud)[i], 2, indices, squared);  // the point finds itself first
    if (squared.back() > 0.0f) found.push_back(squared.back());
  }
  return found;
}

/// How far neighbouring points of one scan lie apart: the median over some points of some scans [m].
double point_spacing(std::span<const Scan> scans) {
  constexpr std::size_t looked_at = 4;  // scans
  std::vector<const Scan*> with_points;
  for (const Scan& scan : scans)
    if (!scan.hits.empty()) with_points.push_back(&scan);
  const std::size_t step = with_points.size() / looked_at + 1;
  std::vector<std::vector<float>> of_scan((with_points.size() + step - 1) / step);
  tbb::parallel_for(std::size_t{0}, of_scan.size(),
                    [&](std::size_t s) { of_scan[s] = squared_spacings(*with_points[s * step]); });
  std::vector<float> squared_distances;
  for (const std::vector<float>& some : of_scan)
    squared_distances.insert(squared_distances.end(), some.begin(), some.end());
  if (squared_distances.empty()) return 0.0;
  const auto middle = squared_distances.begin() + std::ptrdiff_t(squared_distances.size() / 2);
  std::nth_element(squared_distances.begin(), middle, squared_distances.end());
  return std::sqrt(double(*middle));
}

void check_lattice(const Cloud& points, double cell) {
  Eigen::AlignedBox3d box;
  for (const auto& p : points) box.extend(position(p).cast<double>());
  if ((box.sizes() / cell + Vector3::Constant(2.0 * integration_margin + 2.0)).prod() > largest_lattice)
    throw std::invalid_argument(
        fmt::format("surface of a cloud: cells of {:.3g} m are too small for points that lie {:.3g} m apart; remove "
                    "stray points or "
                    "take larger cells",
                    cell, box.sizes().maxCoeff()));
}

/// The points averaged in cells.
Cloud::Ptr averaged(const Cloud::Ptr& points, double cell) {
  pcl::VoxelGrid<pcl::PointNormal> filter;
  filter.setInputCloud(points);
  filter.setLeafSize(float(cell), float(cell), float(cell));
  auto result = std::make_shared<Cloud>();
  filter.filter(*result);
  return result;
}

/// Calls `visit(i, nearest)` for each of `count` positions with the indices of the nearest points of the tree's cloud.
template <class Position, class Visit>
void with_neighbours(const Tree& tree, std::size_t count, Position position_of, Visit visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024), [&](const auto& range) {
    pcl::Indices indices;
    std::vector<float> squared;
    pcl::PointNormal at;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      at.getVector3fMap() = position_of(i);
      tree.nearestKSearch(at, neighbours, indices, squared);
      visit(i, indices);
    }
  });
}

/// Normals of planes fitted to neighbours, turned to the side where the cameras were.
void fit_normals(Cloud& cloud, const Tree& tree) {
  with_neighbours(
      tree, cloud.size(), [&](std::size_t i) { return position(cloud[i]); },
      [&](std::size_t i, const pcl::Indices& nearest) {
        Vector3 mean = Vector3::Zero();
        for (const auto k : nearest) mean += position(cloud[k]).cast<double>() / double(nearest.size());
        Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
        for (const auto k : nearest) {
          const Vector3 d = position(cloud[k]).cast<double>() - mean;
          spread += d * d.transpose();
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
        const Eigen::Vector3f across = axes.eigenvectors().col(0).cast<float>();
        const bool turned = across.dot(normal(cloud[i])) < 0.0f;
        cloud[i].getNormalVector3fMap() = turned ? Eigen::Vector3f(-across) : across;
      });
}

std::vector<float> deviations(const TriangleMesh& mesh, const Cloud& cloud, const Tree& tree) {
  std::vector<float> result(mesh.vertices.size());
  with_neighbours(
      tree, result.size(), [&](std::size_t v) { return mesh.vertices[v]; },
      [&](std::size_t v, const pcl::Indices& nearest) {
        Eigen::Vector3f mean = Eigen::Vector3f::Zero();
        for (const auto k : nearest) mean += normal(cloud[k]);
        mean.normalize();
        float squares = 0.0f;
        for (const auto k : nearest) {
          const float d = mean.dot(position(cloud[k]) - mesh.vertices[v]);
          squares += d * d;
        }
        result[v] = std::sqrt(squares / float(nearest.size()));
      });
  return result;
}

std::vector<Eigen::Vector3f> positions(const Cloud& cloud) {
  std::vector<Eigen::Vector3f> all;
  for (const auto& p : cloud) all.push_back(position(p));
  return all;
}

std::vector<Eigen::Vector3f> normals(const Cloud& cloud) {
  std::vector<Eigen::Vector3f> all;
  for (const auto& p : cloud) all.push_back(normal(p));
  return all;
}

/// Of points that nobody knows the cameras of.
void fit_oriented_normals(Cloud& cloud, const Tree& tree) {
  constexpr std::size_t next_to = 10;
  fit_normals(cloud, tree);
  std::vector<std::vector<std::uint32_t>> nearest_of(cloud.size());
  with_neighbours(
      tree, cloud.size(), [&](std::size_t i) { return position(cloud[i]); },
      [&](std::size_t i, const pcl::Indices& nearest) {
        nearest_of[i].assign(nearest.begin(), nearest.begin() + std::ptrdiff_t(std::min(next_to, nearest.size())));
      });
  std::vector<Eigen::Vector3f> oriented = normals(cloud);
  orient_normals(positions(cloud), nearest_of, oriented);
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud[i].getNormalVector3fMap() = oriented[i];
}

/// How far points would lie apart in rows and columns: of a surface's density, the median over some points.
double grid_spacing(const Cloud::Ptr& cloud) {
  constexpr int around = 8;
  constexpr std::size_t samples = 2000;
  Tree tree(false);
  tree.setInputCloud(cloud);
  std::vector<float> squares;
  pcl::Indices indices;
  std::vector<float> squared;
  for (std::size_t i = 0; i < cloud->size(); i += std::max<std::size_t>(1, cloud->size() / samples)) {
    tree.nearestKSearch((*cloud)[i], around + 1, indices, squared);
    squares.push_back(squared.back());
  }
  const auto middle = squares.begin() + std::ptrdiff_t(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::sqrt(double(*middle) * std::numbers::pi / around);
}

Surface nothing(const std::string& reason) {
  Surface surface;
  surface.why_empty = reason;
  return surface;
}

Surface too_few(std::size_t points) {
  return nothing(fmt::format("{} for a surface",
                             points == 1 ? "1 point is too little" : fmt::format("{} points are too few", points)));
}

/// What both kinds of clouds go through, once it is known how wide cells are and how normals get their signs.
Surface surface_in_cells(const Cloud::Ptr& points, double cell, void (*fit)(Cloud&, const Tree&),
                         const std::function<bool(double, std::string_view)>& go_on) {
  check_lattice(*points, cell);
  const Cloud::Ptr cloud = averaged(points, cell);
  if (!go_on(0.2, "fitting normals")) return nothing("stopped");
  Tree tree(false);
  tree.setInputCloud(cloud);
  fit(*cloud, tree);
  if (!go_on(0.4, "integrating the points' planes")) return nothing("stopped");
  Surface surface;
  surface.mesh = without_small_pieces(integrated_planes(positions(*cloud), normals(*cloud), cell), speck);
  if (surface.empty()) return nothing("the points lie too far apart for a surface");
  if (!go_on(0.8, "measuring the uncertainty")) return nothing("stopped");
  surface.uncertainty = deviations(surface.mesh, *cloud, tree);
  surface.seen.assign(surface.mesh.vertices.size(), 1);
  return surface;
}

std::function<bool(double, std::string_view)> reporter(const SurfaceProgress& progress, const std::stop_token& stop) {
  return [&progress, stop](double fraction, std::string_view what) {
    if (progress) progress(fraction, what);
    return !stop.stop_requested();
  };
}

}  // namespace

Surface cloud_surface(std::span<const Scan> scans, double finest, const SurfaceProgress& progress,
                      std::stop_token stop) {
  if (!(finest > 0.0))
    throw std::invalid_argument(fmt::format("surface of a cloud: cells must be over 0 m wide, not {}", finest));
  const auto go_on = reporter(progress, stop);
  if (!go_on(0.0, "averaging the points")) return nothing("stopped");
  const Cloud::Ptr points = to_pcl(scans);
  if (points->size() < fewest) return too_few(points->size());
  return surface_in_cells(points, std::max(finest, 1.25 * point_spacing(scans)), fit_normals, go_on);
}

Surface cloud_surface(const PointCloud& cloud, const SurfaceProgress& progress, std::stop_token stop) {
  constexpr double finest = 1.0 / 500.0;     // of the longest side: averaged there, cells become some 1/280 of it
  constexpr double cells_per_spacing = 2.0;  // points at random leave gaps
  const auto go_on = reporter(progress, stop);
  if (!go_on(0.0, "averaging the points")) return nothing("stopped");
  const Scan from_nowhere{.origin = Vector3::Zero(), .hits = cloud, .misses = {}};
  const Cloud::Ptr points = to_pcl({&from_nowhere, 1});
  Eigen::AlignedBox3d box;
  for (auto& p : *points) {
    box.extend(position(p).cast<double>());
    p.getNormalVector3fMap().setZero();
  }
  if (points->size() < fewest) return too_few(points->size());
  const double longest = box.sizes().maxCoeff();
  if (!(longest > 0.0)) return nothing("all points lie at one place");
  const Cloud::Ptr fine = averaged(points, finest * longest);
  if (fine->size() < fewest) return too_few(fine->size());
  return surface_in_cells(points, std::max(finest * longest, cells_per_spacing * grid_spacing(fine)),
                          fit_oriented_normals, go_on);
}

}  // namespace nextview
