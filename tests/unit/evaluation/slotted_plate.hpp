#pragma once
#include <vector>

#include "core/evaluation/openings.hpp"

namespace nextview {

inline constexpr double edge = 0.01;
inline const Voxel free_voxel{0.12f, 0.37f, VoxelClass::free, true, 0};
inline const Voxel occupied_voxel{0.97f, 0.13f, VoxelClass::occupied, true, 0};

/// A plate, 30 x 30 x 3 cm, with a slot along y through it in z, 12 cm long; both computed from intervals, not from a
/// mesh.
struct Plate {
  explicit Plate(double width, Vector3 slot_centre = {0.0037, 0.0021, 0.0}) {
    slot = {Opening::Kind::slot, width, 0.12, 0.03, slot_centre, Vector3::UnitZ(), Vector3::UnitY()};
    truth.grid.first = {-20, -20, -8};
    truth.grid.size = {40, 40, 16};
    const std::size_t voxels = truth.grid.voxel_count();
    truth.touch = truth.centre = truth.near_surface = BitMask(voxels);
    const Vector3 half_plate(0.1501, 0.1497, 0.015), half_slot(0.5 * width, 0.06, 1.0);
    for (std::uint32_t i = 0; i < voxels; ++i) {
      const Vector3 from_plate = truth.grid.centre(i).cwiseAbs(),
                    from_slot = (truth.grid.centre(i) - slot_centre).cwiseAbs();
      const auto within = [](const Vector3& p, const Vector3& half, double margin) {
        return (p.array() < half.array() + margin).all();
      };
      const double h = 0.5 * edge;
      truth.centre.set(i, within(from_plate, half_plate, 0) && !within(from_slot, half_slot, 0));
      const bool outside = !within(from_plate, half_plate, h) || within(from_slot, half_slot, -h);
      const bool inside = within(from_plate, half_plate, -h) && !within(from_slot, half_slot, h);
      truth.touch.set(i, !outside && !inside);
    }
  }

  /// What a perfect sensor would know: hidden voxels stay unmeasured.
  std::vector<Voxel> perfect_map() const {
    std::vector<Voxel> map(truth.grid.voxel_count());
    for (std::size_t i = 0; i < map.size(); ++i)
      if (!truth.hidden(i)) map[i] = truth.touch[i] ? occupied_voxel : free_voxel;
    return map;
  }
  std::vector<Voxel> map_of(const Voxel& voxel) const { return std::vector<Voxel>(truth.grid.voxel_count(), voxel); }
  OpeningScore score(const std::vector<Voxel>& map, TruthConvention convention = TruthConvention::touch) const {
    return score_opening(slot, map, truth, convention);
  }
  Voxel& at(std::vector<Voxel>& map, const Vector3& point) const {
    return map[truth.grid.index(truth.grid.cell_at(point))];
  }

  GroundTruth truth;
  Opening slot;
};

}  // namespace nextview
