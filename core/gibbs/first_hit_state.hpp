#pragma once
#include <vector>

#include "core/gibbs/ray_lists.hpp"

namespace nextview {

/// What a chain knows of its rays in the models `paper` and `cone`, kept up to date as voxels change: where the first
/// occupied voxel of each ray is, and so its range operator f(m, n). The interface is SurvivalState's.
class FirstHitState {
 public:
  FirstHitState(const RayLists& lists, const ForwardSensorModel& model);

  int levels() const { return 2; }
  std::span<const std::uint8_t> map() const { return map_; }
  void reset(std::vector<std::uint8_t> map);
  std::size_t bytes() const;
  double change(std::uint32_t voxel, std::uint8_t level);
  void set(std::uint32_t voxel, std::uint8_t level) { change(voxel, level); }
  /// What is negligible makes no difference: terms of either sign follow each other here. Returns false.
  bool conditional(std::uint32_t voxel, double log_negligible, std::span<double> log_weights) const;
  void prefetch_front(std::uint32_t) const {}
  void prefetch_near(std::uint32_t) const {}
  double log_likelihood() const;
  void add_reach(std::vector<float>& reach, float enough) const;

 private:
  std::uint32_t first_occupied(std::uint32_t ray, std::uint32_t from) const;
  float value(std::uint32_t ray, std::uint32_t first) const;

  const RayLists& lists_;
  std::vector<std::uint8_t> map_;
  std::vector<std::uint32_t> first_;  ///< of each ray: incidence of its first occupied voxel, or their end
};

}  // namespace nextview
