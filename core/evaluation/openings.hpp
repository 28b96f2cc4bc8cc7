#pragma once
#include <optional>
#include <span>

#include "core/evaluation/truth_convention.hpp"
#include "core/map/bit_mask.hpp"
#include "core/map/occupancy.hpp"
#include "core/map/voxel_bricks.hpp"
#include "core/mesh/parts.hpp"

namespace nextview {

/// How a map shows an opening (a slot or a bore through a wall, in the map's frame). Counts, so that several openings
/// add up before a share is taken. In all of them a voxel is *called free* if it is measured and p < 0.5, *called
/// occupied* if it is measured and p >= 0.5; outside of the grid nothing is measured.
///
/// - Rows cut the opening across, one voxel edge apart along `along`, centred: as many as fit if one voxel edge at each
///   end is left to the voxels that the end walls touch, and at least one.
/// - A row has parallel lines along the opening's `axis`, spread evenly over its width at (j + 1/2) / n, j = 0 .. n-1,
///   n the larger of 5 and two a voxel edge. A line begins one voxel edge before the mouth and ends one behind it. It
///   is open if all voxels it passes are called free. A row is open if any of its lines is.
/// - Opening recall counts voxels whose centre is in the opening and that are free in truth: how many are called free.
/// - Leak control: the opening moved across by its width and two voxel edges, to either side. Of such a strip the rows
///   count that are solid in truth: all voxels on all lines have their centre inside, from one voxel edge within the
///   one mouth to one within the other (of walls thinner than two: halfway). A row that is open there is a leak.
struct OpeningScore {
  std::size_t rows = 0, open_rows = 0;
  std::size_t free_voxels = 0, called_free = 0;
  std::size_t control_rows = 0, leaking_rows = 0;

  // Nothing where there is nothing to take a share of (recall: a narrow slot may hold no free voxel under `touch`).
  std::optional<double> row_openness() const { return share(open_rows, rows); }
  std::optional<double> recall() const { return share(called_free, free_voxels); }
  std::optional<double> leaks() const { return share(leaking_rows, control_rows); }

  OpeningScore& operator+=(const OpeningScore& other);

 private:
  static std::optional<double> share(std::size_t part, std::size_t whole) {
    return whole == 0 ? std::nullopt : std::optional(double(part) / double(whole));
  }
};

/// `map`: one voxel a voxel of the truth's grid. With a mask `scored` recall counts only voxels where it is not 0.
/// @throws std::invalid_argument if lengths differ or the opening is not valid.
OpeningScore score_opening(const Opening& opening, std::span<const Voxel> map, const GroundTruth& truth,
                           TruthConvention convention, std::span<const std::uint8_t> scored = {});

/// Surface recall: the share of the truly occupied voxels that are called occupied; nothing if there are none. With a
/// mask `scored` only voxels where it is not 0 count.
/// @throws std::invalid_argument if lengths differ.
std::optional<double> surface_recall(std::span<const Voxel> map, const GroundTruth& truth, TruthConvention convention,
                                     std::span<const std::uint8_t> scored = {});
/// The same of a map's voxels as they are kept. @throws as above
std::optional<double> surface_recall(const VoxelBricks& map, const GroundTruth& truth, TruthConvention convention,
                                     const BitMask& scored);

}  // namespace nextview
