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
#include <vector>

namespace nextview {
namespace {

constexpr float reach = 1.6f;              // [radii]
constexpr float widest_gap = 2.1f;         // that has no border in it [rad]
constexpr float fewest = 5.0f;             // points around one that say anything
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

/// Points by coordinate, so that many are looked at together [radii].
class Points {
 public:
  std::size_t size() const { return x_.size(); }
  Eigen::Vector3f operator[](std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  void clear() { x_.clear(), y_.clear(), z_.clear(); }
  void add(const Eigen::Vector3f& point) { x_.push_back(point.x()), y_.push_back(point.y()), z_.push_back(point.z()); }
  void add(const Points& from, std::size_t begin, std::size_t end) {
    const auto some = [&](std::vector<float>& to, const std::vector<float>& of) {
      to.insert(to.end(), of.begin() + std::ptrdiff_t(begin), of.begin() + std::ptrdiff_t(end));
    };
    some(x_, from.x_), some(y_, from.y_), some(z_, from.z_);
  }
  /// Makes them a multiple of `lanes`, by points that are far from all.
  void fill_up() {
    while (size() % lanes != 0) add(Eigen::Vector3f::Constant(1e15f));
  }
  /// How many lie within reach of a point, itself among them.
  struct Around {
    float count = 0.0f;
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();  ///< of the ways there
  };
  /// @pre fill_up()
  Around around(const Eigen::Vector3f& point) const {
    Lanes count = Lanes::Zero(), x_sum = count, y_sum = count, z_sum = count;
    for_each_lanes(point, [&](const Lanes& is_near, const Lanes& x, const Lanes& y, const Lanes& z) {
      count += is_near, x_sum += is_near * x, y_sum += is_near * y, z_sum += is_near * z;
    });
    return {count.sum(), Eigen::Vector3f(x_sum.sum(), y_sum.sum(), z_sum.sum()) / count.sum()};
  }
  /// How the ways to those are spread around their mean. @pre fill_up()
  Eigen::Matrix3f spread(const Eigen::Vector3f& point, const Around& around) const {
    Lanes xx = Lanes::Zero(), xy = xx, xz = xx, yy = xx, yz = xx, zz = xx;
    for_each_lanes(point, [&](const Lanes& is_near, const Lanes& x, const Lanes& y, const Lanes& z) {
      const Lanes near_x = is_near * x, near_y = is_near * y;
      xx += near_x * x, xy += near_x * y, xz += near_x * z;
      yy += near_y * y, yz += near_y * z, zz += is_near * z * z;
    });
    Eigen::Matrix3f squares;
    squares << xx.sum(), xy.sum(), xz.sum(), xy.sum(), yy.sum(), yz.sum(), xz.sum(), yz.sum(), zz.sum();
    return squares - around.count * around.mean * around.mean.transpose();
  }

 private:
  static constexpr int lanes = 8;
  using Lanes = Eigen::Array<float, lanes, 1>;
  /// Calls `visit(is_near, x, y, z)` with the ways to all points, and 1 for those within reach, else 0.
  template <class Visit>
  void for_each_lanes(const Eigen::Vector3f& point, Visit visit) const {
    for (std::size_t i = 0; i < size(); i += lanes) {
      const Lanes x = Lanes::Map(&x_[i]) - point.x(), y = Lanes::Map(&y_[i]) - point.y(),
                  z = Lanes::Map(&z_[i]) - point.z();
      // Without a branch: a comparison would not be made in lanes.
      visit(((reach * reach - (x * x + y * y + z * z)) * 1e30f).max(0.0f).min(1.0f), x, y, z);
    }
  }

  std::vector<float> x_, y_, z_;
};

/// A surface's points, cell by cell in the order of the cells.
struct PointsOfCells {
  std::vector<std::uint64_t> order;  ///< of the cells
  std::vector<std::uint32_t> begin;  ///< of each cell's points, and the end of all
  std::vector<Eigen::Vector3i> at;
  Points points;

  explicit PointsOfCells(const ScannedSurface& surface) {
    for (const ScannedSurface::Cell& cell : surface.cells()) {
      order.push_back(ScannedSurface::order(cell.at));
      begin.push_back(std::uint32_t(points.size()));
      at.push_back(cell.at);
      for_each_eighth(cell, [&](const Eigen::Vector3f& point) { points.add(point); });
    }
    begin.push_back(std::uint32_t(points.size()));
  }
  std::size_t cells() const { return at.size(); }
};

/// The points up to two cells around a cell. Cells are asked for in their order, so that the rows around them are found
/// by going on.
class Surroundings {
 public:
  explicit Surroundings(const PointsOfCells& all) : all_(all) {}

  const Points& of(std::size_t cell) {
    points_.clear();
    for (int row = 0; row < rows * rows; ++row) {
      const Eigen::Vector3i first = all_.at[cell] + Eigen::Vector3i(-2, row % rows - 2, row / rows - 2);
      const std::uint64_t lowest = ScannedSurface::order(first);
      std::size_t& begin = begins_[std::size_t(row)];
      if (is_first_) begin = std::size_t(std::ranges::lower_bound(all_.order, lowest) - all_.order.begin());
      while (begin < all_.cells() && all_.order[begin] < lowest) ++begin;
      std::size_t end = begin;
      while (end < all_.cells() && all_.order[end] < lowest + rows) ++end;
      points_.add(all_.points, all_.begin[begin], all_.begin[end]);
    }
    is_first_ = false;
    points_.fill_up();
    return points_;
  }

 private:
  static constexpr int rows = 5;  ///< of five cells each
  const PointsOfCells& all_;
  std::array<std::size_t, std::size_t{rows} * rows> begins_{};
  bool is_first_ = true;
  Points points_;
};

/// In which sixteenth of the full turn a direction lies, from 0 to 15, roughly counterclockwise from +x.
int sixteenth(float x, float y) {
  constexpr float tangent = 0.41421356f;  // of 22.5 degrees
  const float ax = std::abs(x), ay = std::abs(y);
  const int in_quarter = ay < ax ? (ay < tangent * ax ? 0 : 1) : (ax < tangent * ay ? 3 : 2);
  if (y < 0.0f) return x < 0.0f ? 8 + in_quarter : 15 - in_quarter;
  return x < 0.0f ? 7 - in_quarter : in_quarter;
}

/// Whether four sixteenths side by side are empty: they are wherever a gap is as wide as a border's.
bool may_have_gap(unsigned sixteenths) {
  unsigned empty = ~sixteenths & 0xffffu;
  empty |= empty << 16;  // around
  empty &= empty >> 1;
  return (empty & empty >> 2) != 0;
}

/// Which way the surface is open around a point, if it is.
std::optional<Eigen::Vector3f> open_way(const Points& near, const Eigen::Vector3f& point) {
  const Points::Around around = near.around(point);
  if (around.count < 1.0f + fewest || around.mean.norm() < lopsided) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(near.spread(point, around));
  const Eigen::Vector3f u = axes.eigenvectors().col(2), v = axes.eigenvectors().col(1);
  if (std::hypot(around.mean.dot(u), around.mean.dot(v)) < lopsided) return std::nullopt;  // it is in the skin of noise
  PointCloud ways;
  unsigned sixteenths = 0;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (const Eigen::Vector3f way = near[i] - point; way.squaredNorm() < reach * reach && way != way.Zero()) {
      ways.push_back(way);
      sixteenths |= 1u << sixteenth(way.dot(u), way.dot(v));
    }
  if (!may_have_gap(sixteenths)) return std::nullopt;
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
  const std::size_t every = std::max<std::size_t>(1, all.points.size() / most);
  std::vector<SurfaceBorder> parts((all.cells() + every - 1) / every);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, parts.size(), 256), [&](const auto& range) {
    Surroundings surroundings(all);
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      const Points& near = surroundings.of(p * every);
      for (std::size_t i = all.begin[p * every]; i < all.begin[p * every + 1]; ++i) {
        const Eigen::Vector3f point = all.points[i];
        ++parts[p].looked_at;
        if (const auto outward = open_way(near, point))
          parts[p].points.push_back({float(surface.radius()) * point, *outward});
      }
    }
  });
  SurfaceBorder border;
  border.spacing = 0.5 * surface.radius() * double(every);
  for (const SurfaceBorder& part : parts) {
    border.points.insert(border.points.end(), part.points.begin(), part.points.end());
    border.looked_at += part.looked_at;
  }
  return border;
}

}  // namespace nextview
