#pragma once
#include <array>
#include <vector>

#include "core/gibbs/front_terms.hpp"
#include "core/gibbs/optical_depth.hpp"

namespace nextview {

/// What a chain knows of its rays in the models `beam` and `attenuation`, kept up to date as voxels change.
///
/// In both, p(z | m) = floor (1 + s): s = T S, T the share of the ray that passes the voxels in front, S the sum over
/// the near voxels j of T_j (1 - e_j) g_j (T_j: what passes the near voxels before j; e_j = exp(-kappa_j L_j): what
/// passes j; g_j: density of the range there over the floor's). Beyond range, S is a constant and all voxels are in
/// front.
class SurvivalState {
 public:
  /// Of no map yet: reset() comes before all else.
  SurvivalState(const RayLists& lists, const ForwardSensorModel& model);

  int levels() const { return levels_; }
  std::span<const std::uint8_t> map() const { return map_; }  ///< level of each voxel
  void reset(std::vector<std::uint8_t> map);
  std::size_t bytes() const;

  /// Changes one voxel. Returns by how much that changes log p(z | m).
  double change(std::uint32_t voxel, std::uint8_t level);
  /// The same where nobody asks by how much.
  void set(std::uint32_t voxel, std::uint8_t level);

  /// Adds log p(z | m with q) - log p(z | m with 0) to log_weights[q - 1] for each level q >= 1 (Eqs. 6-8); they hold
  /// the log prior odds before. Exact, except that the sum stops once the weights together are sure to be below
  /// exp(log_negligible): it returns true, and they are upper bounds that are too.
  bool conditional(std::uint32_t voxel, double log_negligible, std::span<double> log_weights) const;

  /// Ask the memory for what conditional() will need of the rays in front of, or near, whose ranges a voxel lies.
  void prefetch_front(std::uint32_t voxel) const {
    for (const RayLists::FrontEntry entry : lists_.front(voxel)) {
      __builtin_prefetch(&rays_[entry.ray()]);
      if (map_[voxel] != 0) __builtin_prefetch(&survivals_[entry.ray()]);
    }
  }
  void prefetch_near(std::uint32_t voxel) const {
    for (const RayLists::NearEntry entry : lists_.near(voxel)) {
      __builtin_prefetch(&lists_.incidence(entry.incidence));
      __builtin_prefetch(&survivals_[entry.ray]);
      __builtin_prefetch(&rays_[entry.ray]);
    }
  }

  double log_likelihood() const;

  /// Adds to `reach` of each voxel how many measured rays get there; those that have reached `enough` may get less.
  void add_reach(std::vector<float>& reach, float enough) const;

 private:
  static constexpr int max_levels = 1 + ForwardSensorModel::max_attenuations;

  /// `heard(before, now)` of each ray that notices.
  template <class Heard>
  void change_voxel(std::uint32_t voxel, std::uint8_t level, Heard heard);
  float near_sum(std::uint32_t ray) const;
  void near_terms(std::uint32_t voxel, std::span<double> log_weights) const;
  bool front_terms(std::uint32_t voxel, double log_negligible, std::span<double> log_weights) const;

  const RayLists& lists_;
  int levels_;
  std::array<OfChords<std::int32_t>, max_levels> depth_{};                   ///< optical depth of a level along a chord
  std::array<OfChords<float>, max_levels> passing_{};                        ///< what passes it
  std::array<OfChords<PassingPair>, (max_levels + 1) / 2> passing_pairs_{};  ///< the same, for FrontTerms
  std::vector<std::uint8_t> map_;
  std::vector<RayWitness> rays_;        ///< by ray
  std::vector<RaySurvival> survivals_;  ///< by ray
};

}  // namespace nextview
