#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>

#include "core/gain/new_surface_model.hpp"

namespace nextview {

/// What simulated rays found in the voxels that they got to, added up over voxels whose features hardly differ.
class NewSurfaceObservations {
 public:
  /// A ray came to a voxel; `found`: it met surface there that no view had covered. `weight`: the area across it, in
  /// any unit. @pre evidence.may_hold_surface(voxel)
  void add(const SurfaceEvidence& evidence, const Eigen::Vector3i& voxel, double weight, bool found);
  /// What was found had this slant: area of the surface over area across the ray.
  void add_slant(double weight, double slant) {
    across_ += weight;
    surface_ += weight * slant;
  }
  void add(const NewSurfaceObservations& other);

  std::size_t cells() const { return cells_.size(); }
  double found(SurfaceEvidence::Kind kind) const;  ///< weight of what was found in voxels of a kind

  /// The model of largest likelihood, found by Newton's method, with a weak pull towards 0. All its slants are the
  /// mean.
  /// @throws std::invalid_argument if nothing was found in voxels of some kind.
  NewSurfaceModel fit() const;

 private:
  static constexpr std::size_t most_features = std::tuple_size_v<SurfaceEvidence::Unmeasured>;
  using Key = std::array<std::int16_t, most_features + 2>;  ///< kind, object size, features, all rounded
  struct Cell {
    double weight = 0.0, found = 0.0, size = 0.0;
    std::array<double, most_features> features{};  ///< their sum, by weight
  };
  template <std::size_t n>
  std::array<double, n> fit_kind(SurfaceEvidence::Kind kind) const;

  std::map<Key, Cell> cells_;            ///< in an order that does not depend on that of the rays
  double across_ = 0.0, surface_ = 0.0;  ///< area of what was found
};

}  // namespace nextview
