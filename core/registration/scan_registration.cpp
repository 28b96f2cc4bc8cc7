#include "core/registration/scan_registration.hpp"

#include <fmt/format.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/cloud/evenly_kept.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr std::size_t max_registered_points = 4000, min_registered_points = 100;
constexpr double farthest_reach = 8.0, nearest_reach = 2.0;  // of pairs [spacings]
constexpr int most_iterations = 30;                          // of each reach
constexpr double settled_move = 1e-3;                        // a move below this ends it [spacings]
constexpr double facing_alike = 0.7;                         // cosine between the normals of a pair
constexpr int neighbours_tried = 5;                          // for one that faces alike
/// What a direction must do to the mean squared distance to the planes, per squared move, to count as constrained:
/// this, and so many times what it seems to do on a plane, where normals differ by their noise alone.
constexpr double least_constraint = 0.002, over_noise = 6.0;
/// Against the prior, a pair's distance is taken to err by no less than this [spacings], and so many pairs to err
/// alike.
constexpr double least_pair_error = 0.25, pairs_that_err_alike = 40.0;

/// What was scanned before, to be searched.
class Target {
 public:
  explicit Target(std::vector<OrientedPoint> points, const Vector3& middle)
      : points_(std::move(points)), middle_(middle), cloud_(std::make_shared<pcl::PointCloud<pcl::PointXYZ>>()) {
    for (const OrientedPoint& p : points_) cloud_->push_back(at(p.position));
    if (!points_.empty()) tree_.setInputCloud(cloud_);
  }

  /// What a thread's searches find; kept from one to the next, for its memory.
  struct Found {
    std::vector<int> indices;
    std::vector<float> squared;
  };
  /// The nearest point that faces alike; null if none is within reach [m].
  const OrientedPoint* nearest(const Vector3& position, const Vector3& normal, double reach, Found& found) const {
    if (points_.empty()) return nullptr;
    const int count = tree_.nearestKSearch(at(position), neighbours_tried, found.indices, found.squared);
    for (int i = 0; i < count && double(found.squared[std::size_t(i)]) < reach * reach; ++i) {
      const OrientedPoint& point = points_[std::size_t(found.indices[std::size_t(i)])];
      if (point.normal.dot(normal) > facing_alike) return &point;
    }
    return nullptr;
  }

 private:
  /// Around the scan's middle: single precision is finest there.
  pcl::PointXYZ at(const Vector3& position) const {
    const Eigen::Vector3f p = (position - middle_).cast<float>();
    return {p.x(), p.y(), p.z()};
  }

  std::vector<OrientedPoint> points_;
  Vector3 middle_;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud_;
  pcl::search::KdTree<pcl::PointXYZ> tree_;
};

/// The scan's middle, and how far its points lie from there (root mean square): with it, turns count as lengths.
struct Extent {
  Vector3 middle = Vector3::Zero();  ///< [m, world]
  double radius = 0.0;               ///< [m]
};

Extent extent_of(const std::vector<OrientedPoint>& points) {
  Extent extent;
  for (const OrientedPoint& p : points) extent.middle += p.position / double(points.size());
  for (const OrientedPoint& p : points)
    extent.radius += (p.position - extent.middle).squaredNorm() / double(points.size());
  extent.radius = std::max(std::sqrt(extent.radius), 1e-9);
  return extent;
}

/// The pairs of a scan at a pose, as point-to-plane ICP sees them. The first three unknowns are a turn about the middle
/// times the radius [m], the others a shift [m].
struct Pairs {
  Matrix6 normal_matrix = Matrix6::Zero();  ///< sum of w J J^T
  Vector6 pull = Vector6::Zero();           ///< sum of w J d
  double weight = 0.0, squares = 0.0;       ///< sum of d^2 [m^2]
  std::vector<double> normals_apart = {};   ///< of each pair, the squared difference of its normals

  std::size_t count() const { return normals_apart.size(); }
  /// Below this, an eigenvalue of the normal matrix, per weight, says nothing.
  double noise_floor() const;
};

double Pairs::noise_floor() const {
  std::vector<double> apart = normals_apart;
  const auto middle = apart.begin() + std::ptrdiff_t(apart.size() / 2);
  std::ranges::nth_element(apart, middle);
  // Two normals differ by errors of variance s^2 along two axes each: the median of the square is 2 s^2 of 2 ln 2.
  const double variance = *middle / (4.0 * std::numbers::ln2);
  return std::max(least_constraint, over_noise * variance);
}

class Registrar {
 public:
  Registrar(std::vector<OrientedPoint> scan, Target target, const Extent& extent)
      : scan_(std::move(scan)), target_(std::move(target)), extent_(extent) {}

  Pairs pairs(const Pose& T, double reach) const {
    std::vector<const OrientedPoint*> nearest_of(scan_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scan_.size(), 128), [&](const auto& range) {
      Target::Found found;
      for (std::size_t i = range.begin(); i != range.end(); ++i)
        nearest_of[i] = target_.nearest(T * scan_[i].position, T.linear() * scan_[i].normal, reach, found);
    });
    Pairs all;
    for (std::size_t i = 0; i < scan_.size(); ++i) {
      const OrientedPoint* const nearest = nearest_of[i];
      if (!nearest) continue;
      const Vector3 position = T * scan_[i].position, normal = T.linear() * scan_[i].normal;
      const double distance = nearest->normal.dot(nearest->position - position);
      // Tukey's weight: a pair at the end of the reach counts for nothing, so none comes or goes at once.
      const double weight = std::pow(1.0 - (nearest->position - position).squaredNorm() / (reach * reach), 2);
      Vector6 J;
      J << (position - extent_.middle).cross(nearest->normal) / extent_.radius, nearest->normal;
      all.normal_matrix += weight * J * J.transpose();
      all.pull += weight * distance * J;
      all.weight += weight;
      all.squares += distance * distance;
      all.normals_apart.push_back((nearest->normal - normal).squaredNorm());
    }
    return all;
  }

  double share(const Pairs& pairs) const { return double(pairs.count()) / double(scan_.size()); }

  /// Moves the scan once, along the directions that the pairs constrain; along the others, and where pairs say little,
  /// back to where it is believed to be. Returns how far [m], and how many directions those are.
  double step(Pose& T, double reach, const RegistrationLimits& limits, int& constrained) const {
    const Pairs all = pairs(T, reach);
    constrained = 0;
    if (all.count() < min_registered_points) return 0.0;
    const Vector6 prior = weight_of_belief(all, limits);
    Matrix6 normal_matrix = prior.asDiagonal();
    Vector6 pull = -prior.cwiseProduct(moved_by(T));
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(all.normal_matrix / all.weight);
    const double floor = all.noise_floor();
    for (int i = 0; i < 6; ++i) {
      if (solver.eigenvalues()[i] < floor) continue;
      const Vector6 direction = solver.eigenvectors().col(i);
      normal_matrix += solver.eigenvalues()[i] * direction * direction.transpose();
      pull += direction * direction.dot(all.pull / all.weight);
      ++constrained;
    }
    const Vector6 move = normal_matrix.ldlt().solve(pull);
    const Vector3 turn = move.head<3>() / extent_.radius;
    const Eigen::AngleAxisd rotation(turn.norm(), turn.norm() > 0.0 ? turn.normalized() : Vector3::UnitX());
    // About the middle where it was at the start, as the unknowns are.
    const Pose change =
        Eigen::Translation3d(extent_.middle + move.tail<3>()) * rotation * Eigen::Translation3d(-extent_.middle);
    const Pose next = change * T;
    T = make_pose(next.translation(), Eigen::Quaterniond(next.linear()).normalized());
    return move.norm();
  }

 private:
  /// Of each unknown, what the prior adds to the normal matrix per weight of the pairs.
  Vector6 weight_of_belief(const Pairs& pairs, const RegistrationLimits& limits) const {
    const double variance = std::max(pairs.squares / double(pairs.count()),  // of a pair's distance
                                     std::pow(least_pair_error * limits.spacing, 2));
    const double of_all = variance / std::max(1.0, double(pairs.count()) / pairs_that_err_alike);
    const double turn = limits.expected.rotation * std::numbers::pi / 180.0 * extent_.radius;
    Vector6 deviations;
    deviations << Vector3::Constant(turn), Vector3::Constant(limits.expected.shift);
    return of_all * deviations.cwiseProduct(deviations).cwiseInverse();
  }

  /// How far a pose is from the believed one, as the unknowns are.
  Vector6 moved_by(const Pose& T) const {
    const Eigen::AngleAxisd turn(T.linear());
    Vector6 moved;
    moved << turn.angle() * turn.axis() * extent_.radius, T * extent_.middle - extent_.middle;
    return moved;
  }

  std::vector<OrientedPoint> scan_;
  Target target_;
  Extent extent_;
};

double root_mean_square(const Pairs& pairs) {
  return pairs.count() > 0 ? std::sqrt(pairs.squares / double(pairs.count())) : 0.0;
}

/// Why nothing may be corrected; empty if it may.
std::string doubt(const ScanRegistration& found, const RegistrationLimits& limits, bool has_settled) {
  if (found.overlap < limits.min_overlap)
    return fmt::format("{:.0f} % of the scan's points lie on what was scanned before; {:.0f} % are needed",
                       100.0 * found.overlap, 100.0 * limits.min_overlap);
  if (found.constrained == 0) return "the shape of what was scanned before does not tell where the scan lies";
  if (!has_settled) return "it does not settle anywhere";
  return "";
}

}  // namespace

std::vector<OrientedPoint> RegistrationTarget::of(std::span<const std::shared_ptr<const Scan>> scans, double spacing,
                                                  const std::stop_token& stop) {
  const bool goes_on =
      spacing == spacing_ && scans_.size() <= scans.size() && std::ranges::equal(scans_, scans.first(scans_.size()));
  if (!goes_on) {
    scans_.clear();
    spacing_ = spacing;
    merged_ = MergedPoints(spacing);
  }
  for (const auto& scan : scans.subspan(scans_.size())) {
    merged_.add(oriented_points(*scan, spacing, stop));
    scans_.push_back(scan);
  }
  return merged_.points();
}

ScanRegistration register_scan(const Scan& scan, std::span<const std::shared_ptr<const Scan>> so_far,
                               const RegistrationLimits& limits, const std::stop_token& stop) {
  RegistrationTarget target;
  return register_scan(scan, so_far, limits, target, stop);
}

ScanRegistration register_scan(const Scan& scan, std::span<const std::shared_ptr<const Scan>> so_far,
                               const RegistrationLimits& limits, RegistrationTarget& target,
                               const std::stop_token& stop) {
  ScanRegistration found;
  const auto points = evenly_kept(oriented_points(scan, limits.spacing, stop), max_registered_points);
  if (points.size() < min_registered_points) {
    found.why_not = fmt::format("the scan has too few points with neighbours within {:.3g} m", limits.spacing);
    return found;
  }
  const Extent extent = extent_of(points);
  const Registrar registrar(points, Target(target.of(so_far, limits.spacing, stop), extent.middle), extent);
  const double near = nearest_reach * limits.spacing;
  const Pairs before = registrar.pairs(found.T_corrected_believed, near);
  Pose T = Pose::Identity();
  double step = 0.0;
  for (double reach = farthest_reach; reach >= nearest_reach; reach *= 0.5)
    for (int i = 0; i < most_iterations; ++i) {
      throw_if_stopped(stop);
      step = registrar.step(T, reach * limits.spacing, limits, found.constrained);
      if (step < settled_move * limits.spacing) break;
    }
  const Pairs after = registrar.pairs(T, near);
  found.overlap = registrar.share(after);
  found.residual_before = root_mean_square(before);
  found.residual_after = root_mean_square(after);
  found.why_not = doubt(found, limits, step < 0.1 * limits.spacing);
  found.reliable = found.why_not.empty();
  if (!found.reliable) {
    found.residual_after = found.residual_before;
    return found;
  }
  found.T_corrected_believed = T;
  found.shift = (T * extent.middle - extent.middle).norm();
  found.rotation = rotation_angle(T, Pose::Identity());
  return found;
}

std::string beyond_limits(const ScanRegistration& found, const RegistrationLimits& limits) {
  const double degrees = found.rotation * 180.0 / std::numbers::pi;
  if (found.shift <= limits.max_shift && degrees <= limits.max_rotation) return "";
  return fmt::format(
      "the scan lies {:.1f} mm and {:.2f} deg off those before it; the limits are {:.1f} mm and {:.2f} deg",
      1e3 * found.shift, degrees, 1e3 * limits.max_shift, limits.max_rotation);
}

Scan moved(const Scan& scan, const Pose& T_corrected_believed) {
  Scan result = scan;
  result.origin = T_corrected_believed * scan.origin;
  for (PointCloud* points : {&result.hits, &result.misses})
    for (Eigen::Vector3f& p : *points) p = (T_corrected_believed * p.cast<double>()).cast<float>();
  return result;
}

}  // namespace nextview
