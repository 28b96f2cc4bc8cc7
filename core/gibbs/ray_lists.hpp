#pragma once
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "core/gibbs/forward_sensor_model.hpp"
#include "core/map/huge_pages.hpp"

namespace nextview {

/// Which rays pass through which voxels, both ways round: what the sampler walks instead of casting rays again.
///
/// A ray's voxels are in front of its range (they can only block it) or near it (it may have ended there). Only the
/// near ones are listed by ray; each has an *incidence*. In first-hit models every voxel has a say, so all count as
/// near.
///
/// Costs 4 bytes per pair of ray and front voxel, 20 bytes per incidence, 36 bytes per ray, 8 bytes per voxel of the
/// grid.
class RayLists {
 public:
  /// A voxel in front of a ray's range. The chord is rounded to sqrt(3) / 1023 voxel edges.
  struct FrontEntry {
    std::uint32_t bits;
    std::uint32_t ray() const { return bits >> 10; }
    std::uint32_t chord() const { return bits & 1023u; }
  };
  struct NearEntry {
    std::uint32_t ray, incidence;
  };
  /// Where a voxel near a ray's range lies.
  enum class Place : std::uint16_t { in_front, at_range, behind };
  /// A voxel near a ray's range.
  struct Incidence {
    std::uint32_t voxel;
    std::uint16_t chord;  ///< code
    Place place;
    /// beam, attenuation: density of the measured range if the ray ended here, over that of a random range.
    /// paper, cone: log p(z | f = this voxel).
    float value;
  };
  static constexpr std::uint32_t chord_codes = 1024;
  static double chord(std::uint32_t code);  ///< [voxel edges]

  /// The lists hold the rays that enter the grid, in their order: neighbours in an image stay neighbours in memory.
  /// @throws std::invalid_argument if there are too many rays or voxels to hold (8 GiB of lists); Stopped
  RayLists(const VoxelGrid& grid, const RangeMeasurements& measurements, const ForwardSensorModel& model,
           const std::stop_token& stop = {});
  /// Adds rays of more origins and the same maximum range: as if all had been listed together. Takes the memory of both
  /// lists for a moment.
  /// @throws as the constructor; the lists may not be used any more then.
  void append(const RangeMeasurements& measurements, const std::stop_token& stop = {});

  /// @throws std::invalid_argument if the grid has too many voxels, or is too long.
  static void require_holdable(const VoxelGrid& grid);

  const VoxelGrid& grid() const { return grid_; }
  const ForwardSensorModel& model() const { return model_; }
  std::size_t rays() const { return measurements_.rays.size(); }
  std::size_t incidence_count() const { return front_.size() + near_.size(); }
  std::size_t bytes() const;

  /// Entries that may be read along with the last one, whatever they are.
  static constexpr std::size_t entries_beyond = 15;
  std::span<const FrontEntry> front(std::uint32_t voxel) const { return front_.of(voxel); }
  std::span<const NearEntry> near(std::uint32_t voxel) const { return near_.of(voxel); }
  /// Ask the memory for what front() and near() will show of a voxel.
  void prefetch_front(std::uint32_t voxel) const { prefetch(front(voxel)); }
  void prefetch_near(std::uint32_t voxel) const { prefetch(near(voxel)); }
  bool observed(std::uint32_t voxel) const { return !front(voxel).empty() || is_near(voxel); }
  bool is_near(std::uint32_t voxel) const { return !near(voxel).empty(); }

  std::uint32_t incidences_begin(std::uint32_t ray) const { return incidences_begin_[ray]; }
  std::uint32_t incidences_end(std::uint32_t ray) const { return incidences_begin_[ray + 1]; }
  std::span<const Incidence> incidences(std::uint32_t ray) const {
    return {incidences_.data() + incidences_begin_[ray], incidences_.data() + incidences_begin_[ray + 1]};
  }
  const Incidence& incidence(std::uint32_t incidence) const { return incidences_[incidence]; }
  /// What is left when nothing on the ray is occupied. beam, attenuation: by how much 'beyond range' is then likelier
  /// than otherwise, less 1; 0 for hits. paper, cone: log p(z | nothing).
  float open_value(std::uint32_t ray) const { return open_value_[ray]; }
  /// The first ray of an origin or of those after it. @pre the rays came origin by origin
  std::uint32_t first_ray_of(std::uint32_t origin) const;
  const RangeMeasurement& measurement(std::uint32_t ray) const { return measurements_.rays[ray]; }
  Vector3 direction(std::uint32_t ray) const { return measurements_.direction(measurements_.rays[ray]); }
  std::uint32_t weight(std::uint32_t ray) const { return weight_[ray]; }  ///< measured rays that it stands for
  /// What its log-likelihood is multiplied by: its weight, as far as the rays are independent witnesses.
  double evidence(std::uint32_t ray) const { return weight_[ray] * model_.independence; }
  /// It depends on all rays; no list depends on it.
  void set_independence(double independence) { model_.independence = independence; }
  /// Where a ray's range lies from a voxel that it crosses, along the ray [voxel edges].
  struct RangeFrom {
    float centre;  ///< behind it; less than 0: in front
    float way;     ///< before or behind the ray's way through the voxel; 0: on it
  };
  RangeFrom range_from(std::uint32_t voxel, std::uint32_t ray) const;

  /// A voxel in front of a ray, and its chord's code.
  struct FrontVoxel {
    std::uint32_t voxel, chord;
  };
  /// The voxels in front of a ray, in order: cast anew, since they are listed by voxel only.
  void cast_front(std::uint32_t ray, std::vector<FrontVoxel>& voxels) const;

 private:
  struct Block;
  /// Entries of the voxels, one voxel's after the other's.
  template <class Entry>
  struct ByVoxel {
    std::vector<std::uint32_t> begin;
    std::vector<Entry, HugePages<Entry>> entries;

    std::span<const Entry> of(std::uint32_t voxel) const {
      return {entries.data() + begin[voxel], entries.data() + begin[voxel + 1]};
    }
    std::size_t size() const { return begin.back(); }
  };
  struct Places;
  template <class Entry>
  static void prefetch(std::span<const Entry> entries) {
    for (std::size_t k = 0; k < entries.size(); k += 64 / sizeof(Entry)) __builtin_prefetch(&entries[k]);
  }
  template <class Front, class Near>
  void walk(std::uint32_t ray, Front on_front, Near on_near) const;
  std::size_t take_rays(const RangeMeasurements& measurements);
  void count(Block& block, const std::stop_token& stop);
  template <class Entry>
  static Places place(const ByVoxel<Entry>& lists, std::vector<Block>& blocks,
                      std::vector<std::uint32_t> Block::*counts);
  void lay_out(std::vector<Block>& blocks);
  void require_memory_for(std::size_t front, std::size_t near) const;
  void fill(Block& block, const std::stop_token& stop);
  Place place_of(const RangeMeasurement& ray, const VoxelSegment& segment) const;
  float open_value_of(const RangeMeasurement& ray) const;
  float incidence_value_of(const RangeMeasurement& ray, const VoxelSegment& segment) const;

  VoxelGrid grid_;
  RangeMeasurements measurements_;  ///< those that enter the grid
  ForwardSensorModel model_;
  std::vector<std::uint32_t> weight_;
  std::vector<float> open_value_;
  std::vector<std::uint32_t> incidences_begin_;
  std::vector<Incidence> incidences_;
  ByVoxel<FrontEntry> front_;
  ByVoxel<NearEntry> near_;
};

}  // namespace nextview
