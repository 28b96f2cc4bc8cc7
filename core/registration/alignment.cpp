#include "core/registration/alignment.hpp"

#include <pcl/point_types.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "core/mesh/surface_samples.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;

constexpr std::size_t surface_points = 30'000, few_points = 800, many_points = 10'000;
constexpr double on_surface = 0.02;   // of the surface's longest side
constexpr double good_overlap = 0.9;  // is not searched for a better one
constexpr std::size_t least_points = 100;

Point point_at(const Vector3& position, const Vector3& normal = Vector3::Zero()) {
  Point point;
  point.x = float(position.x());
  point.y = float(position.y());
  point.z = float(position.z());
  point.normal_x = float(normal.x());
  point.normal_y = float(normal.y());
  point.normal_z = float(normal.z());
  return point;
}
Vector3 position(const Point& point) { return {point.x, point.y, point.z}; }
Vector3 normal(const Point& point) { return {point.normal_x, point.normal_y, point.normal_z}; }

Cloud::Ptr surface_cloud(const TriangleMesh& mesh) {
  auto cloud = std::make_shared<Cloud>();
  const SurfaceSamples samples = sample_surface(mesh, surface_points, 1);
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[samples.triangles[i]];
    const Vector3 at = mesh.vertices[a].cast<double>();
    const Vector3 across = (mesh.vertices[b].cast<double>() - at).cross(mesh.vertices[c].cast<double>() - at);
    cloud->push_back(point_at(samples.points[i].cast<double>(), across.normalized()));
  }
  return cloud;
}

Cloud::Ptr thinned(const PointCloud& points, std::size_t count) {
  auto cloud = std::make_shared<Cloud>();
  const double stride = std::max(1.0, double(points.size()) / double(count));
  for (double at = 0.0; at < double(points.size()); at += stride)
    cloud->push_back(point_at(points[std::size_t(at)].cast<double>()));
  return cloud;
}

/// Where pairs lie on a plane there is no one best move: PCL's is not a number then, and its search aborts at the next.
class FinitePointToPlane : public pcl::registration::TransformationEstimationPointToPlaneLLS<Point, Point> {
 public:
  using pcl::registration::TransformationEstimationPointToPlaneLLS<Point, Point>::estimateRigidTransformation;
  void estimateRigidTransformation(const Cloud& from, const Cloud& to, const pcl::Correspondences& pairs,
                                   Matrix4& T) const override {
    pcl::registration::TransformationEstimationPointToPlaneLLS<Point, Point>::estimateRigidTransformation(from, to,
                                                                                                          pairs, T);
    if (!T.allFinite()) T.setIdentity();
  }
};

class Aligner {
 public:
  explicit Aligner(const TriangleMesh& surface)
      : longest_(surface.bounding_box().sizes().maxCoeff()), target_(surface_cloud(surface)) {
    tree_ = std::make_shared<pcl::search::KdTree<Point>>();
    tree_->setInputCloud(target_);
    icp_.setInputTarget(target_);
    icp_.setSearchMethodTarget(tree_, true);
    icp_.setTransformationEstimation(std::make_shared<FinitePointToPlane>());
    icp_.setTransformationEpsilon(1e-10);
  }

  /// Refined from a first guess: pairs as far apart as `reach`, a share of the longest side, then ever nearer ones.
  Alignment refine(const Cloud::Ptr& cloud, Pose guess, double reach, int iterations) {
    for (; reach > 0.5 * on_surface; reach *= 0.5) {
      icp_.setInputSource(cloud);
      icp_.setMaxCorrespondenceDistance(reach * longest_);
      icp_.setMaximumIterations(iterations);
      Cloud moved;
      icp_.align(moved, guess.matrix().cast<float>());
      const Eigen::Matrix4d result = icp_.getFinalTransformation().cast<double>();
      if (!result.allFinite()) break;
      guess = make_pose(result.topRightCorner<3, 1>(), Eigen::Quaterniond(result.topLeftCorner<3, 3>().eval()));
    }
    return judged(*cloud, guess);
  }

 private:
  Alignment judged(const Cloud& cloud, const Pose& T_surface_cloud) const {
    Alignment alignment{T_surface_cloud, 0.0, 0.0};
    std::size_t near = 0;
    double squares = 0.0;
    std::vector<int> index(1);
    std::vector<float> squared(1);
    for (const Point& point : cloud) {
      const Vector3 moved = T_surface_cloud * position(point);
      if (tree_->nearestKSearch(point_at(moved), 1, index, squared) < 1) continue;
      if (squared[0] > std::pow(on_surface * longest_, 2)) continue;
      // To the plane: samples of the surface lie apart.
      const Point& nearest = (*target_)[std::size_t(index[0])];
      squares += std::pow((moved - position(nearest)).dot(normal(nearest)), 2);
      ++near;
    }
    alignment.overlap = double(near) / double(cloud.size());
    alignment.residual = near > 0 ? std::sqrt(squares / double(near)) : longest_;
    return alignment;
  }

  double longest_;
  Cloud::Ptr target_;
  pcl::search::KdTree<Point>::Ptr tree_;
  pcl::IterativeClosestPoint<Point, Point> icp_;
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
  if (cloud.size() < least_points)
    throw std::invalid_argument("too few points to align with a mesh: at least 100 are needed");
  Aligner aligner(surface);
  const double longest = surface.bounding_box().sizes().maxCoeff();
  const Cloud::Ptr few = thinned(cloud, few_points), many = thinned(cloud, many_points);
  Alignment best = aligner.refine(few, Pose::Identity(), 0.1, 20);
  const Vector3 from = middle(cloud), to = surface.bounding_box().center().cast<double>();
  if (best.overlap < good_overlap)
    for (const Eigen::Quaterniond& turn : axis_rotations()) {
      throw_if_stopped(stop);
      const Alignment found = aligner.refine(few, make_pose(to - turn * from, turn), 0.3, 20);
      if (better(found, best, longest)) best = found;
    }
  throw_if_stopped(stop);
  return aligner.refine(many, best.T_surface_cloud, on_surface, 50);
}

}  // namespace nextview
