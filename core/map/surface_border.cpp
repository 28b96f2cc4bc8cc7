#include "core/map/surface_border.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace nextview {
namespace {

constexpr float reach = 1.6f;              // [radii]
constexpr float widest_gap = 2.1f;         // that has no border in it [rad]
constexpr std::size_t fewest = 5;          // points around one that say anything
constexpr float lopsided = 0.15f * reach;  // less is never a border: half a disc is 0.42, two thirds are 0.28

/// The points of a cell a half of its edge apart: each the mean of what lies in an eighth of it [radii].
template <class Take>
void for_each_eighth(const ScannedSurface::Cell& cell, Take take) {
  if (cell.points == 0) return;
  // Of the places, 4 along each axis, x fastest: those that are the second in their eighth.
  constexpr std::uint64_t odd_x = 0xaaaaaaaaaaaaaaaa, odd_y = 0xf0f0f0f0f0f0f0f0, odd_z = 0xffff0000ffff0000;
  constexpr std::uint64_t lowest = 0x00330033;
  for (int eighth = 0; eighth < 8; ++eighth) {
    const int x = 2 * (eighth & 1), y = eighth & 2, z = eighth >> 2 << 1;
    const std::uint64_t bits = cell.points & lowest << (x + 4 * y + 16 * z);
    if (bits == 0) continue;
    const auto share = [&](std::uint64_t odd) { return float(std::popcount(bits & odd)) / float(std::popcount(bits)); };
    const Eigen::Vector3f place(float(x) + share(odd_x), float(y) + share(odd_y), float(z) + share(odd_z));
    take(Eigen::Vector3f(cell.at.cast<float>() + (place + Eigen::Vector3f::Constant(0.5f)) / 4.0f));
  }
}

/// Which way the surface is open around a point, if it is; `around` are the ways to its neighbours.
std::optional<Eigen::Vector3f> open_way(std::span<const Eigen::Vector3f> around) {
  if (around.size() < fewest) return std::nullopt;
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& way : around) mean += way;
  mean /= float(around.size() + 1);  // the point itself is one
  if (mean.norm() < lopsided) return std::nullopt;
  Eigen::Matrix3f spread = mean * mean.transpose();
  for (const Eigen::Vector3f& way : around) spread += (way - mean) * (way - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(spread);
  const Eigen::Vector3f u = axes.eigenvectors().col(2), v = axes.eigenvectors().col(1);
  std::vector<float> angles;
  for (const Eigen::Vector3f& way : around) angles.push_back(std::atan2(way.dot(v), way.dot(u)));
  std::ranges::sort(angles);
  float gap = angles.front() + 2.0f * std::numbers::pi_v<float> - angles.back(), begin = angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (angles[i] - angles[i - 1] > gap) gap = angles[i] - angles[i - 1], begin = angles[i - 1];
  if (gap <= widest_gap) return std::nullopt;
  const float middle = begin + gap / 2.0f;
  return std::cos(middle) * u + std::sin(middle) * v;
}

}  // namespace

double border_reach(const ScannedSurface& surface) { return reach * surface.radius(); }

SurfaceBorder surface_border(const ScannedSurface& surface, std::size_t most) {
  constexpr std::size_t usual = 4;  // points in a cell
  const std::vector<ScannedSurface::Cell> cells = surface.cells();
  const std::size_t every = std::max<std::size_t>(1, usual * cells.size() / most);
  std::vector<SurfaceBorder> parts((cells.size() + every - 1) / every);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, parts.size(), 64), [&](const auto& range) {
    PointCloud near, around;
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      const ScannedSurface::Cell& cell = cells[p * every];
      near.clear();
      for (int z = -2; z <= 2; ++z)
        for (int y = -2; y <= 2; ++y)
          for (int x = -2; x <= 2; ++x)
            for_each_eighth(surface.cell(cell.at + Eigen::Vector3i(x, y, z)),
                            [&](const Eigen::Vector3f& point) { near.push_back(point); });
      for_each_eighth(cell, [&](const Eigen::Vector3f& point) {
        around.clear();
        for (const Eigen::Vector3f& other : near)
          if (const Eigen::Vector3f way = other - point; way.squaredNorm() < reach * reach && way != way.Zero())
            around.push_back(way);
        ++parts[p].looked_at;
        if (const auto outward = open_way(around))
          parts[p].points.push_back({float(surface.radius()) * point, *outward});
      });
    }
  });
  SurfaceBorder border;
  for (const SurfaceBorder& part : parts) {
    border.points.insert(border.points.end(), part.points.begin(), part.points.end());
    border.looked_at += part.looked_at;
  }
  return border;
}

}  // namespace nextview
