// Compiled once for each instruction set (Highway's foreach_target); the processor's best is chosen when it runs.
#include "core/map/surface_border.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/map/surface_border.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef NEXTVIEW_SURFACE_BORDER
#define NEXTVIEW_SURFACE_BORDER
namespace nextview::border {

constexpr float reach = 2.0f;       // [radii]
constexpr std::size_t length = 5;   // of a row of cells that may be within reach, and as many of them side by side
constexpr std::size_t at_once = 8;  // cells that are looked at
constexpr int fewest = 4;           // points in a cell that are no stray ones, of 64 at most
constexpr std::size_t most_ways = length * length * length;

/// A surface's points, one a cell, in the order of the cells [radii]; behind them there is room to read on.
struct PointsOfCells {
  std::size_t size;
  std::vector<std::uint64_t> order;  ///< of the cells; the largest number behind them
  std::array<std::vector<float>, 3> points;
  std::vector<std::uint8_t> is_stray;

  explicit PointsOfCells(const ScannedSurface& surface) {
    const std::vector<ScannedSurface::Cell> cells = surface.cells();
    size = cells.size();
    order.resize(size + at_once, ~std::uint64_t{0});
    for (auto& along : points) along.resize(order.size());
    is_stray.resize(size);
    tbb::parallel_for(std::size_t{0}, size, [&](std::size_t c) {
      order[c] = ScannedSurface::order(cells[c].at);
      is_stray[c] = std::popcount(cells[c].points) < fewest;
      const Eigen::Vector3f middle = cells[c].middle();
      for (int axis = 0; axis < 3; ++axis) points[std::size_t(axis)][c] = middle[axis];
    });
  }
  Eigen::Vector3f point(std::size_t i) const { return {points[0][i], points[1][i], points[2][i]}; }
};

/// The ways from a point to those within reach of it, a component after the other.
struct Ways {
  std::size_t count = 0;
  std::array<std::array<float, most_ways + at_once>, 3> parts;

  Eigen::Vector3f operator[](std::size_t i) const { return {parts[0][i], parts[1][i], parts[2][i]}; }
};

/// Which way the surface is open around a point, if it is.
std::optional<Eigen::Vector3f> open_way(const Ways& ways);

}  // namespace nextview::border
#endif

HWY_BEFORE_NAMESPACE();
namespace nextview::border::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Finds the ways of one point after the other, in their order, so that the rows of cells around them are found by
/// going on.
class WayFinder {
 public:
  /// `first`: the point that will be asked for first, or one before it.
  WayFinder(const PointsOfCells& all, std::size_t first) : all_(all) {
    for (int r = 0; r < int(rows_.size()); ++r) {
      const Eigen::Vector3i way(-2, r % int(length) - 2, r / int(length) - 2);
      Row& row = rows_[std::size_t(r)];
      row.way = ScannedSurface::order(way) - ScannedSurface::order(Eigen::Vector3i::Zero());
      row.begin = std::size_t(std::ranges::lower_bound(all.order, all.order[first] + row.way) - all.order.begin());
    }
  }

  void find(std::size_t point, Ways& ways) {
    ways.count = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const std::uint64_t lowest = all_.order[point] + rows_[r].way;
      const std::size_t begin = rows_[r].begin = go_on(rows_[r].begin, lowest);
      if (all_.order[begin] >= lowest + length) continue;  // empty, as it mostly was for the point before
      std::size_t cells = 0;
      for (std::size_t i = 0; i < length; ++i) cells += all_.order[begin + i] < lowest + length;
      take(point, begin, cells, ways);
    }
  }

 private:
  /// Of cells beside each other along x.
  struct Row {
    std::uint64_t way = 0;  ///< from a point's cell to the row's first, in the order of cells
    std::size_t begin = 0;  ///< no cell before it is in the row
  };

  /// From a cell to the first that is not before `lowest`.
  std::size_t go_on(std::size_t cell, std::uint64_t lowest) const {
    for (int i = 0; i < 4; ++i) cell += all_.order[cell] < lowest;  // mostly enough, and without a branch
    while (all_.order[cell] < lowest) ++cell;
    return cell;
  }

  /// Adds the ways to those of some cells beside each other that are within reach.
  HWY_INLINE void take(std::size_t point, std::size_t begin, std::size_t cells, Ways& ways) const {
    const hn::CappedTag<float, at_once> tag;
    for (std::size_t part = 0; part < length; part += hn::Lanes(tag)) {
      hn::Vec<decltype(tag)> way[3], squared = hn::Zero(tag);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float* const along = all_.points[axis].data();
        way[axis] = hn::Sub(hn::LoadU(tag, along + begin + part), hn::Set(tag, along[point]));
        squared = hn::Add(squared, hn::Mul(way[axis], way[axis]));
      }
      const std::size_t own = point - begin - part;  // beyond all lanes where the point is in another row
      auto within =
          hn::And(hn::FirstN(tag, cells > part ? cells - part : 0), hn::Lt(squared, hn::Set(tag, reach * reach)));
      if (own < hn::Lanes(tag)) within = hn::AndNot(hn::AndNot(hn::FirstN(tag, own), hn::FirstN(tag, own + 1)), within);
      // Not CompressStore: what writes to memory by a mask takes a hundred times longer on some processors (Zen 4, 5).
      for (std::size_t axis = 0; axis < 3; ++axis)
        hn::StoreU(hn::Compress(way[axis], within), tag, &ways.parts[axis][ways.count]);
      ways.count += hn::CountTrue(tag, within);
    }
  }

  const PointsOfCells& all_;
  std::array<Row, length * length> rows_;
};

void find_open_ways(const PointsOfCells& all, std::size_t every, std::vector<std::optional<Eigen::Vector3f>>& outward) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, outward.size(), 512), [&](const auto& range) {
    WayFinder finder(all, range.begin() * every);
    Ways ways;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      finder.find(i * every, ways);
      outward[i] = open_way(ways);
    }
  });
}

}  // namespace nextview::border::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nextview {
namespace border {

HWY_EXPORT(find_open_ways);

std::optional<Eigen::Vector3f> open_way(const Ways& ways) {
  constexpr float widest_gap = 2.1f;         // that has no border in it [rad]
  constexpr int fewest_ways = 5;             // to points around one that say anything
  constexpr float lopsided = 0.15f * reach;  // less is never a border: half a disc is 0.42, two thirds are 0.28
  if (ways.count < fewest_ways) return std::nullopt;
  const float count = float(ways.count + 1);  // itself, too
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < ways.count; ++i) mean += ways[i];
  mean /= count;
  if (mean.norm() < lopsided) return std::nullopt;
  Eigen::Matrix3f spread = -count * mean * mean.transpose();
  for (std::size_t i = 0; i < ways.count; ++i) spread += ways[i] * ways[i].transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes;
  axes.computeDirect(spread);
  const Eigen::Vector3f u = axes.eigenvectors().col(2), v = axes.eigenvectors().col(1);
  if (std::hypot(mean.dot(u), mean.dot(v)) < lopsided) return std::nullopt;  // it is in the skin of noise
  std::array<float, most_ways> all_angles;
  const std::span angles = std::span(all_angles).first(ways.count);
  for (std::size_t i = 0; i < ways.count; ++i) angles[i] = std::atan2(ways[i].dot(v), ways[i].dot(u));
  std::ranges::sort(angles);
  float gap = angles.front() + 2.0f * std::numbers::pi_v<float> - angles.back(), begin = angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (angles[i] - angles[i - 1] > gap) gap = angles[i] - angles[i - 1], begin = angles[i - 1];
  if (gap <= widest_gap) return std::nullopt;
  const float middle = begin + gap / 2.0f;
  return std::cos(middle) * u + std::sin(middle) * v;
}

}  // namespace border

double border_reach(const ScannedSurface& surface) { return border::reach * surface.radius(); }

SurfaceBorder surface_border(const ScannedSurface& surface, std::size_t most) {
  const border::PointsOfCells all(surface);
  const std::size_t every = std::max<std::size_t>(1, all.size / most);
  std::vector<std::optional<Eigen::Vector3f>> outward((all.size + every - 1) / every);
  HWY_DYNAMIC_DISPATCH(border::find_open_ways)(all, every, outward);
  SurfaceBorder border;
  border.spacing = surface.radius() * double(every);
  for (std::size_t i = 0; i < outward.size(); ++i)
    if (outward[i]) border.points.push_back({float(surface.radius()) * all.point(i * every), *outward[i]});
  for (std::size_t c = 0; c < all.size; ++c)
    if (!all.is_stray[c]) border.within.push_back(float(surface.radius()) * all.point(c));
  return border;
}

}  // namespace nextview
#endif
