#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/gain/occupied_hull.hpp"
#include "core/gain/surface_slant.hpp"
#include "core/map/bit_rows.hpp"
#include "core/map/surface_border.hpp"
#include "core/map/voxel_bricks.hpp"
#include "core/map/voxel_grid.hpp"

namespace nextview {

/// What the map says of where the surface goes on: of each voxel around what is known of the object, the features from
/// which a NewSurfaceModel makes a probability. Lengths are shares of the object's size as far as it is known (the
/// diagonal of its box), so that a part of 80 mm and one of 10 m are alike.
class SurfaceEvidence {
 public:
  enum class Kind : std::uint8_t { unmeasured, free, occupied };
  /// Of an unmeasured voxel: 1; ln of the distance to the nearest occupied voxel; ln of that to the nearest free one,
  /// and its square; 1 if no surface was seen in front of it, else 0; ln of how far it lies behind that surface, else
  /// 0; how far outside the hull of the occupied voxels it lies: root, as it is, and negative if inside.
  using Unmeasured = std::array<float, 9>;
  /// Of a measured voxel: 1; its log-odds; ln(1 + its unmeasured neighbours); 1 if it has an occupied neighbour, else
  /// 0; its occupied neighbours, of 26 each; ln(1 + 4 length), where `length` [blocks] is that of the border at which
  /// the scanned surface goes on into its block or the 26 beside it.
  using Measured = std::array<float, 6>;

  /// Voxels that are smaller than this share of the object are unmeasured in blocks of more: finer is not known where
  /// nothing was measured, and the work would grow with the volume.
  static constexpr double finest_share = 1.0 / 64;

  /// `occlusions` knows how far voxels lie behind a surface; it is the conventional map where `voxels` are another's.
  /// What occupied_hull takes for outliers the object's box leaves out. A measured voxel that holds scanned surface is
  /// occupied, whatever its probability is: rays that graze a face take it away from the voxels that the face cuts off.
  SurfaceEvidence(const VoxelGrid& grid, const VoxelBricks& voxels, const VoxelBricks& occlusions,
                  double occupancy_threshold, const OpenBorder& border = {}, double finest = finest_share);

  /// The part of the map that is looked at, in the same lattice; of no voxels if none is occupied.
  const VoxelGrid& grid() const { return grid_; }
  const Eigen::AlignedBox3d& object() const { return object_; }  ///< what is known of it [m, world]
  double size() const { return size_; }                          ///< of the object as far as it is known [voxels]
  Kind kind(const Eigen::Vector3i& cell) const {
    return occupied_.at(cell) ? Kind::occupied : unmeasured_.at(cell) ? Kind::unmeasured : Kind::free;
  }
  /// Of a block of unmeasured voxels, those of its first one, x fastest; distances are its own, to blocks that hold any
  /// such voxel. @pre it holds an unmeasured voxel
  Unmeasured unmeasured(const Eigen::Vector3i& block) const;
  /// Along its edge [voxels], a power of two; 1: voxels are looked at one by one.
  int block_edge() const { return block_edge_; }
  Eigen::Vector3i block_of(const Eigen::Vector3i& cell) const { return cell / block_edge_; }
  /// The blocks that hold an unmeasured voxel.
  const BitRows& unmeasured_blocks() const { return unmeasured_blocks_; }
  /// How surface in a block of voxels is likely to lie: towards the free blocks beside it, of 26; where there are none
  /// or they are all around, as the nearest side of the object's box. A block is free if all its voxels are.
  CoarseNormal normal(const Eigen::Vector3i& block) const;
  /// @pre kind(cell) != Kind::unmeasured
  Measured measured(const Eigen::Vector3i& cell) const;
  /// Whether a voxel is unmeasured or occupied, or has such a one beside it: no surface is in any other.
  bool may_hold_surface(const Eigen::Vector3i& cell) const { return may_hold_surface_.at(cell); }
  /// Those voxels.
  const BitRows& all_that_may_hold_surface() const { return may_hold_surface_; }

 private:
  void set_region(const VoxelGrid& whole);
  void read_kinds(double occupancy_threshold);
  void occupy(std::span<const Eigen::Vector3f> scanned);
  void measure_distances();
  void measure_border(const OpenBorder& border);
  Eigen::Vector3i first_unmeasured(const Eigen::Vector3i& block) const;
  float log_share(std::size_t squared_distance) const;
  float log_share_of_blocks(std::int32_t squared_distance) const;

  VoxelGrid grid_;
  Eigen::Vector3i offset_ = Eigen::Vector3i::Zero();  ///< of grid_ in the whole grid [voxels]
  Eigen::AlignedBox3d object_;
  double size_ = 1.0;
  OccupiedHull hull_;                ///< in the whole grid
  VoxelBricks voxels_, occlusions_;  ///< of the whole grid
  BitRows occupied_, unmeasured_, may_hold_surface_;
  int block_edge_ = 1;
  BitRows unmeasured_blocks_, free_blocks_, beside_free_blocks_;
  std::vector<std::uint32_t> blocks_before_;         ///< BitRows::counts_before of unmeasured_blocks_
  std::vector<std::int32_t> to_occupied_, to_free_;  ///< of those, squared [blocks^2]
  VoxelGrid blocks_;
  std::vector<float> going_on_;    ///< by block: the `length` of Measured's last
  std::vector<float> log_shares_;  ///< by squared distance
};

}  // namespace nextview
