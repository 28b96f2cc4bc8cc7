#pragma once
#include <cstdint>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/file/bytes.hpp"

namespace nextview {

/// The surface that scans have met so far, so that it can be told how much of it the next one meets for the first time:
/// no truth is needed for that. A value; points are told apart to an eighth of the radius.
class ScannedSurface {
 public:
  /// `radius` [m]: a point that is nearer to one of an earlier scan shows nothing new.
  /// @throws std::invalid_argument if it is not over 0.
  explicit ScannedSurface(double radius);

  /// Adds a scan and returns the area across its rays of what it shows for the first time [m^2]: r^2 dOmega, summed
  /// over its new points at range r, each a pixel of solid angle dOmega, which is `central_solid_angle` [sr] on the
  /// optical axis (of unit length, world). The same on any number of threads.
  double add(const Scan& scan, const Vector3& optical_axis, double central_solid_angle);

  double area() const { return area_; }      ///< of all scans [m^2]
  double radius() const { return radius_; }  ///< [m]

  /// Points are told apart in cells as large as the radius.
  struct Cell {
    Eigen::Vector3i at;        ///< [radii]
    std::uint64_t points = 0;  ///< a bit each, of 4 x 4 x 4 places, x fastest
    /// Of its points [radii]. @pre it has any
    Eigen::Vector3f middle() const;
  };
  std::vector<Cell> cells() const;  ///< that hold any point, in the order of their places
  /// Of cells, and two beyond: x fastest, then y, then z. Along x they are numbered one by one.
  static std::uint64_t order(const Eigen::Vector3i& at) {
    return (std::uint64_t(at.z() + offset) << 42) | (std::uint64_t(at.y() + offset) << 21) |
           std::uint64_t(at.x() + offset);
  }

  /// Points around which there are few: within the radius fewer than `share` of what is usual, the median over all
  /// points. Points are those told apart, each at the middle of its place. The same order every time.
  std::vector<Eigen::Vector3f> sparse_points(double share) const;

  std::size_t bytes() const { return slots_.size() * sizeof(Slot) + keys_.size() * sizeof(std::uint64_t); }

  /// Writes what was seen, or reads it again: the radius stays. @throws std::runtime_error if it is none
  void archive(ByteWriter& writer) const;
  void archive(ByteReader& reader);

 private:
  static constexpr int offset = 1 << 20;  ///< in the order no part is below 0
  struct Slot {
    std::uint64_t key = 0;        ///< 1 + the order of its cell; 0: no cell
    std::uint64_t sub_cells = 0;  ///< those with a point, of 4 x 4 x 4, a bit each
  };
  /// Where a point lies: its cell, and its sub-cell there.
  struct Place {
    Eigen::Vector3i cell;
    int sub_cell;
  };
  Place place(const Eigen::Vector3f& point) const;
  bool is_new(const Place& place) const;
  int points_around(const Place& place) const;
  static std::uint64_t key_of(const Eigen::Vector3i& cell) { return 1 + order(cell); }
  static Eigen::Vector3i cell_of(std::uint64_t key);
  std::uint64_t sub_cells(const Eigen::Vector3i& cell) const;
  bool mark(const Place& place);  ///< whether its cell is a new one, which is not in keys_ yet
  void grow();

  double radius_;
  double area_ = 0.0;
  std::vector<Slot> slots_;          ///< a hash table with open addressing, of a power of two
  std::vector<std::uint64_t> keys_;  ///< of the cells in it, ascending: all of them are sorted only once
};

}  // namespace nextview
