#include "core/registration/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nanoflann.hpp>
#include <stdexcept>
#include <vector>

#include "core/cloud/evenly_kept.hpp"
#include "core/mesh/surface_samples.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

constexpr std::size_t surface_points = 30'000, few_points = 800, many_points = 10'000;
constexpr double on_surface = 0.02;   // of the surface's longest side
constexpr double good_overlap = 0.9;  // is not searched for a better one
constexpr std::size_t min_points = 100;
constexpr double settled = 1e-9;  // of a step [rad, longest sides]

/// Points of a surface, and which of them is nearest.
class SurfacePoints {
 public:
  explicit SurfacePoints(const TriangleMesh& mesh) : tree_(3, *this, {15}) {
    const SurfaceSamples samples = sample_surface(mesh, surface_points, 1);
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
      const auto& [a, b, c] = mesh.triangles[samples.triangles[i]];
      const Vector3 at = mesh.vertices[a].cast<double>();
      points_.push_back(samples.points[i].cast<double>());
      normals_.push_back(
          (mesh.vertices[b].cast<double>() - at).cross(mesh.vertices[c].cast<double>() - at).normalized());
    }
    tree_.buildIndex();
  }
  SurfacePoints(const SurfacePoints&) = delete;

  struct Nearest {
    double squared;    ///< distance [m^2]
    double off_plane;  ///< distance from the surface's plane there, along its normal [m]
    Vector3 normal;
  };
  Nearest nearest(const Vector3& point) const {
    std::uint32_t index = 0;
    double squared = 0.0;
    tree_.knnSearch(point.data(), 1, &index, &squared);
    return {squared, (point - points_[index]).dot(normals_[index]), normals_[index]};
  }

  // As nanoflann asks for the points.
  std::size_t kdtree_get_point_count() const { return points_.size(); }
  double kdtree_get_pt(std::size_t point, std::size_t axis) const { return points_[point][Eigen::Index(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

 private:
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, SurfacePoints>, SurfacePoints,
                                                   3, std::uint32_t>;
  std::vector<Vector3> points_, normals_;
  Tree tree_;
};

std::vector<Vector3> thinned(const PointCloud& points, std::size_t count) {
  std::vector<Vector3> some;
  for (const Eigen::Vector3f& point : evenly_kept(points, count)) some.push_back(point.cast<double>());
  return some;
}

/// Moves points onto the planes that are nearest to them. PCL's own iterations end the program where too few points
/// are near, or where the surface leaves a direction free.
class Aligner {
 public:
  explicit Aligner(const TriangleMesh& surface)
      : longest_(surface.bounding_box().sizes().maxCoeff()), surface_(surface) {}

  /// Refined from a first guess: pairs as far apart as `reach`, a share of the longest side, then ever nearer ones.
  Alignment refine(const std::vector<Vector3>& points, Pose pose, double reach, int iterations) const {
    for (; reach > 0.5 * on_surface; reach *= 0.5)
      for (int i = 0; i < iterations; ++i)
        if (!step(points, pose, reach * longest_)) break;
    return judged(points, pose);
  }
  double longest() const { return longest_; }

 private:
  /// One step of least squares; false once it no longer moves.
  bool step(const std::vector<Vector3>& points, Pose& pose, double reach) const {
    Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero(), row;
    const Vector3 middle = pose * points[points.size() / 2];
    for (const Vector3& point : points) {
      const Vector3 moved = pose * point;
      const SurfacePoints::Nearest nearest = surface_.nearest(moved);
      if (nearest.squared > reach * reach) continue;
      row << (moved - middle).cross(nearest.normal) / longest_, nearest.normal;
      A += row * row.transpose();
      b -= row * nearest.off_plane;
    }
    // What the surface leaves free stays as it is.
    A.diagonal().array() += 1e-9 * (A.trace() + 1.0);
    const Eigen::Matrix<double, 6, 1> x = A.ldlt().solve(b);
    if (!x.allFinite()) return false;
    const Vector3 turn = x.head<3>() / longest_;
    const Eigen::AngleAxisd rotation(turn.norm(), turn.norm() > 0.0 ? turn.normalized() : Vector3::UnitZ());
    const Pose moved = Eigen::Translation3d(middle + x.tail<3>()) * rotation * Eigen::Translation3d(-middle) * pose;
    pose = make_pose(moved.translation(), Eigen::Quaterniond(moved.linear()));
    return turn.norm() > settled || x.tail<3>().norm() > settled * longest_;
  }

  Alignment judged(const std::vector<Vector3>& points, const Pose& T_surface_cloud) const {
    std::size_t near = 0;
    double squares = 0.0;
    for (const Vector3& point : points) {
      const SurfacePoints::Nearest nearest = surface_.nearest(T_surface_cloud * point);
      if (nearest.squared > std::pow(on_surface * longest_, 2)) continue;
      squares += nearest.off_plane * nearest.off_plane;  // to the plane: samples of the surface lie apart
      ++near;
    }
    return {T_surface_cloud, near > 0 ? std::sqrt(squares / double(near)) : longest_,
            double(near) / double(points.size())};
  }

  double longest_;
  SurfacePoints surface_;
};

bool better(const Alignment& a, const Alignment& b, double longest) {
  const auto loss = [&](const Alignment& x) { return (1.0 - x.overlap) + x.residual / (on_surface * longest); };
  return loss(a) < loss(b);
}

/// The ways to turn axes onto axes.
std::vector<Eigen::Quaterniond> axis_rotations() {
  std::vector<Eigen::Quaterniond> all;
  for (const int x : {0, 1, 2})
    for (const int y : {0, 1, 2})
      for (const double sx : {1.0, -1.0})
        for (const double sy : {1.0, -1.0}) {
          if (x == y) continue;
          Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
          R(x, 0) = sx;
          R(y, 1) = sy;
          R.col(2) = R.col(0).cross(R.col(1));
          all.emplace_back(R);
        }
  return all;
}

Vector3 middle(const PointCloud& cloud) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : cloud) box.extend(p);
  return box.center().cast<double>();
}

}  // namespace

Alignment align(const PointCloud& cloud, const TriangleMesh& surface, const std::stop_token& stop) {
  if (cloud.size() < min_points)
    throw std::invalid_argument("too few points to align with a mesh: at least 100 are needed");
  const Aligner aligner(surface);
  const std::vector<Vector3> few = thinned(cloud, few_points);
  Alignment best = aligner.refine(few, Pose::Identity(), 0.1, 20);
  const Vector3 from = middle(cloud), to = surface.bounding_box().center().cast<double>();
  if (best.overlap < good_overlap)
    for (const Eigen::Quaterniond& turn : axis_rotations()) {
      throw_if_stopped(stop);
      const Alignment found = aligner.refine(few, make_pose(to - turn * from, turn), 0.3, 20);
      if (better(found, best, aligner.longest())) best = found;
    }
  throw_if_stopped(stop);
  return aligner.refine(thinned(cloud, many_points), best.T_surface_cloud, on_surface, 50);
}

}  // namespace nextview
