#include "core/map/surface_border.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace nextview {
namespace {

constexpr float reach = 2.0f;              // [radii]
constexpr float widest_gap = 2.1f;         // that has no border in it [rad]
constexpr int fewest = 5;                  // points around one that say anything
constexpr float lopsided = 0.15f * reach;  // less is never a border: half a disc is 0.42, two thirds are 0.28

/// A surface's points, one a cell, in the order of the cells [radii].
struct PointsOfCells {
  std::vector<std::uint64_t> order;  ///< of the cells
  std::vector<Eigen::Vector3f> points;

  explicit PointsOfCells(const ScannedSurface& surface) {
    const std::vector<ScannedSurface::Cell> cells = surface.cells();
    order.resize(cells.size()), points.resize(cells.size());
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t c) {
      order[c] = ScannedSurface::order(cells[c].at);
      points[c] = cells[c].middle();
    });
  }
  std::size_t size() const { return points.size(); }
};

/// The ways from a point to those within reach of it. Points are asked for in their order, so that the rows of cells
/// around them are found by going on.
class Ways {
 public:
  /// `first`: the point that will be asked for first, or one before it.
  Ways(const PointsOfCells& all, std::size_t first) : all_(all) {
    for (int r = 0; r < int(rows_.size()); ++r) {
      const Eigen::Vector3i way(-2, r % length - 2, r / length - 2);
      Row& row = rows_[std::size_t(r)];
      row.way = ScannedSurface::order(way) - ScannedSurface::order(Eigen::Vector3i::Zero());
      row.begin = std::size_t(std::ranges::lower_bound(all.order, all.order[first] + row.way) - all.order.begin());
    }
  }

  void find(std::size_t point) {
    const Eigen::Vector3f from = all_.points[point];
    const std::uint64_t* order = all_.order.data();
    const std::size_t size = all_.size();
    std::size_t count = 0;
    for (Row& row : rows_) {
      const std::uint64_t lowest = order[point] + row.way;
      std::size_t i = row.begin;
      while (i < size && order[i] < lowest) ++i;
      row.begin = i;
      for (; i < size && order[i] < lowest + length; ++i) {
        const Eigen::Vector3f way = all_.points[i] - from;
        ways_[count] = way;
        count += unsigned(way.squaredNorm() < reach * reach) & unsigned(i != point);  // without a branch
      }
    }
    count_ = count;
  }
  std::span<const Eigen::Vector3f> ways() const { return {ways_.data(), count_}; }

 private:
  /// Of cells beside each other along x.
  struct Row {
    std::uint64_t way = 0;  ///< from a point's cell to the row's first, in the order of cells
    std::size_t begin = 0;  ///< no cell before it is in the row
  };
  static constexpr int length = 5;  ///< of a row, and as many of them side by side
  const PointsOfCells& all_;
  std::array<Row, std::size_t{length} * length> rows_;
  std::array<Eigen::Vector3f, std::size_t{length} * length * length> ways_;
  std::size_t count_ = 0;
};

/// Which way the surface is open around a point, if it is.
std::optional<Eigen::Vector3f> open_way(std::span<const Eigen::Vector3f> ways) {
  if (ways.size() < fewest) return std::nullopt;
  const float count = float(ways.size() + 1);  // itself, too
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& way : ways) mean += way;
  mean /= count;
  if (mean.norm() < lopsided) return std::nullopt;
  Eigen::Matrix3f spread = -count * mean * mean.transpose();
  for (const Eigen::Vector3f& way : ways) spread += way * way.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes;
  axes.computeDirect(spread);
  const Eigen::Vector3f u = axes.eigenvectors().col(2), v = axes.eigenvectors().col(1);
  if (std::hypot(mean.dot(u), mean.dot(v)) < lopsided) return std::nullopt;  // it is in the skin of noise
  std::vector<float> angles;
  for (const Eigen::Vector3f& way : ways) angles.push_back(std::atan2(way.dot(v), way.dot(u)));
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
  const PointsOfCells all(surface);
  const std::size_t every = std::max<std::size_t>(1, all.size() / most);
  std::vector<std::optional<Eigen::Vector3f>> outward((all.size() + every - 1) / every);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, outward.size(), 512), [&](const auto& range) {
    Ways ways(all, range.begin() * every);
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      ways.find(i * every);
      outward[i] = open_way(ways.ways());
    }
  });
  SurfaceBorder border;
  border.spacing = surface.radius() * double(every);
  for (std::size_t i = 0; i < outward.size(); ++i)
    if (outward[i]) border.points.push_back({float(surface.radius()) * all.points[i * every], *outward[i]});
  return border;
}

}  // namespace nextview
