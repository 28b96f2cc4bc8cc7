#include "core/gibbs/surface_patch.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace nextview {
namespace {

constexpr int wide_reach = 2;  // [voxels]

/// How much the ends in a voxel count, so far away squared [voxels^2]: exp(-d^2 / (2 1.2^2)).
const std::array<float, 3 * wide_reach* wide_reach + 1> wide_shares = [] {
  std::array<float, 3 * wide_reach * wide_reach + 1> shares{};
  for (std::size_t squared = 0; squared < shares.size(); ++squared)
    shares[squared] = std::exp(-0.5f * float(squared) / (1.2f * 1.2f));
  return shares;
}();

}  // namespace

void RayEnds::Sums::add(const End& end, const Eigen::Vector3f& place, float share, float variance) {
  const float w = share * end.weight;
  weight += w;
  at += w * place;
  direction += w * end.direction;
  // A merged ray's range is the mean of as many.
  squares += w * (place * place.transpose()) - share * variance * (end.direction * end.direction.transpose());
}

void RayEnds::Sums::add(const Sums& other, const Eigen::Vector3f& way, float share) {
  weight += share * other.weight;
  at += share * (other.at + other.weight * way);
  direction += share * other.direction;
  const Eigen::Matrix3f cross = other.at * way.transpose();
  squares += share * (other.squares + cross + cross.transpose() + other.weight * (way * way.transpose()));
}

RayEnds::RayEnds(const RayLists& lists) : grid_(lists.grid()), ended_(grid_.size) {
  const double per_edge = 1.0 / grid_.resolution;
  variance_ = static_cast<float>(std::pow(lists.model().sigma * per_edge, 2));
  struct Ending {
    std::uint32_t ray;
    Eigen::Vector3i cell;
  };
  std::vector<Ending> endings;
  for (std::uint32_t ray = 0; ray < lists.rays(); ++ray) {
    const RangeMeasurement& m = lists.measurement(ray);
    const Eigen::Vector3i cell = grid_.cell_at(m.end.cast<double>());
    if (m.beyond_range || !grid_.contains(cell)) continue;
    endings.push_back({ray, cell});
    ended_.set(cell);
  }
  ended_before_ = ended_.counts_before();
  around_ = ended_;
  for (int voxels = 0; voxels < wide_reach; ++voxels) around_.grow({});
  begin_.resize(ended_before_.back());
  for (const Ending& ending : endings) ++begin_[ended_.rank(ending.cell, ended_before_)];
  std::exclusive_scan(begin_.begin(), begin_.end(), begin_.begin(), 0u);
  end_ = begin_;
  sums_.resize(begin_.size());
  ends_.resize(endings.size());
  for (const auto& [ray, cell] : endings) {
    const std::size_t place = ended_.rank(cell, ended_before_);
    const RangeMeasurement& m = lists.measurement(ray);
    const Vector3 at = (m.end.cast<double>() - grid_.centre(grid_.index(cell))) * per_edge;
    const End& end = ends_[end_[place]++] = {at.cast<float>(), lists.direction(ray).cast<float>(), float(m.weight)};
    sums_[place].add(end, end.at, 1.0f, variance_);
  }
}

/// Calls visit(place, way to its voxel's centre) for the places so many voxels around.
template <class Visit>
void RayEnds::visit_around(std::uint32_t voxel, int cells, Visit visit) const {
  const Eigen::Vector3i cell = grid_.cell(voxel);
  if (!around_.at(cell)) return;
  const Eigen::Vector3i first = (cell.array() - cells).max(0);
  const Eigen::Vector3i last = (cell.array() + cells).min(grid_.size.array() - 1);
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        const Eigen::Vector3i at(x, y, z);
        if (ended_.at(at)) visit(ended_.rank(at, ended_before_), Eigen::Vector3f((at - cell).cast<float>()));
      }
}

/// @pre the weight is over 0
RayEnds::Plane RayEnds::plane_of(const Sums& sums) {
  const Eigen::Vector3f mean = sums.at / sums.weight;
  const Eigen::Matrix3f scatter = sums.squares / sums.weight - mean * mean.transpose();
  // Few ends hardly tell a normal: as if some more lay around them, square to the rays.
  constexpr float as_if = 0.5f, spread = 0.3f;
  const Eigen::Vector3f towards = sums.direction.stableNormalized();
  const Eigen::Matrix3f across = Eigen::Matrix3f::Identity() - towards * towards.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(scatter + (as_if * spread / (sums.weight + as_if)) * across);
  Eigen::Vector3f normal = solver.eigenvectors().col(0);
  if (normal.dot(sums.direction) < 0.0f) normal = -normal;
  return {normal, mean, std::sqrt(std::max(0.0f, normal.dot(scatter * normal)))};
}

SurfacePatch RayEnds::patch(std::uint32_t voxel) const {
  const auto visit_ends = [&](const auto& visit) {
    visit_around(voxel, 1, [&](std::size_t place, const Eigen::Vector3f& way) {
      for (std::uint32_t k = begin_[place]; k < end_[place]; ++k) {
        const Eigen::Vector3f at = ends_[k].at + way;
        const float left = 1.0f - at.squaredNorm() / (reach * reach);
        if (left > 0.0f) visit(ends_[k], at, left * left);
      }
    });
  };
  Sums sums;
  visit_ends([&](const End& end, const Eigen::Vector3f& at, float share) { sums.add(end, at, share, variance_); });
  if (sums.weight < 1e-3f) return {};
  const Plane plane = plane_of(sums);
  SurfacePatch patch;
  float front = 0.0f, behind = 0.0f, cosines = 0.0f;
  visit_ends([&](const End& end, const Eigen::Vector3f& at, float share) {
    const float cosine = end.direction.dot(plane.normal), weight = share * end.weight;
    cosines += weight * std::abs(cosine);
    (cosine >= 0.0f ? front : behind) += weight;
    (cosine >= 0.0f ? patch.distance : patch.distance_from_behind) += weight * at.dot(plane.normal);
  });
  if (front > 0.0f) patch.distance /= front;
  if (behind > 0.0f) patch.distance_from_behind /= behind;
  patch.ends = sums.weight;
  patch.half = 0.5f * plane.normal.cwiseAbs().sum();
  patch.roughness = plane.roughness;
  patch.incidence = cosines / sums.weight;
  patch.from_behind = behind / sums.weight;
  return patch;
}

SurfacePatch RayEnds::wide_patch(std::uint32_t voxel) const {
  Sums sums;
  visit_around(voxel, wide_reach, [&](std::size_t place, const Eigen::Vector3f& way) {
    sums.add(sums_[place], way, wide_shares[std::size_t(way.squaredNorm())]);
  });
  if (sums.weight < 1e-3f) return {};
  const Plane plane = plane_of(sums);
  return {sums.weight, plane.through.dot(plane.normal), 0.5f * plane.normal.cwiseAbs().sum(), plane.roughness,
          sums.direction.dot(plane.normal) / sums.weight};
}

}  // namespace nextview
