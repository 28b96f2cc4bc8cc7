#include "core/calibration/new_surface_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nextview {
namespace {

using Kind = SurfaceEvidence::Kind;

/// Features that round to the same multiples of these are as good as equal. The square and the root follow from others.
constexpr SurfaceEvidence::Unmeasured unmeasured_steps = {1, 0.15f, 0.15f, 1e6f, 1, 0.2f, 1e6f, 0.01f, 0.02f};
constexpr SurfaceEvidence::Measured measured_steps = {1, 0.25f, 0.1f, 1, 1, 0.4f};

/// The log likelihood of finding, as a function of a linear score, and its first two derivatives (the second as it is
/// expected). `size` [voxels] of the object.
struct Likelihood {
  double slope, curvature;
};
/// Found with the probability 1 - exp(-exp(score) / size).
Likelihood of_rate(double score, double size, double weight, double found) {
  const double rate = std::min(std::exp(score) / size, 20.0), missed = std::exp(-rate);
  const double probability = std::max(-std::expm1(-rate), 1e-12);
  return {rate * (found * missed / probability - (weight - found)), weight * rate * rate * missed / probability};
}
/// Found with the probability of which the score is the log-odds.
Likelihood of_log_odds(double score, double, double weight, double found) {
  const double p = probability(score);
  return {found - weight * p, weight * p * (1.0 - p)};
}

}  // namespace

void NewSurfaceObservations::add(const SurfaceEvidence& evidence, const Eigen::Vector3i& voxel, double weight,
                                 bool found) {
  if (!(weight > 0.0)) return;  // of a camera inside the voxel; a cell of nothing would have no mean features
  const Kind kind = evidence.kind(voxel);
  Key key{static_cast<std::int16_t>(kind), static_cast<std::int16_t>(std::lround(20.0 * std::log(evidence.size())))};
  const auto count = [&](const auto& features, const auto& steps) {
    for (std::size_t k = 0; k < features.size(); ++k)
      key[k + 2] = static_cast<std::int16_t>(std::lround(features[k] / steps[k]));
    Cell& cell = cells_[key];
    cell.weight += weight;
    cell.found += found ? weight : 0.0;
    cell.size += weight * evidence.size();
    for (std::size_t k = 0; k < features.size(); ++k) cell.features[k] += weight * features[k];
  };
  if (kind == Kind::unmeasured)
    count(evidence.unmeasured(evidence.block_of(voxel)), unmeasured_steps);
  else
    count(evidence.measured(voxel), measured_steps);
}

void NewSurfaceObservations::add(const NewSurfaceObservations& other) {
  for (const auto& [key, more] : other.cells_) {
    Cell& cell = cells_[key];
    cell.weight += more.weight;
    cell.found += more.found;
    cell.size += more.size;
    for (std::size_t k = 0; k < most_features; ++k) cell.features[k] += more.features[k];
  }
  across_ += other.across_;
  surface_ += other.surface_;
}

double NewSurfaceObservations::found(Kind kind) const {
  double found = 0.0;
  for (const auto& [key, cell] : cells_)
    if (key[0] == static_cast<std::int16_t>(kind)) found += cell.found;
  return found;
}

template <std::size_t n>
std::array<double, n> NewSurfaceObservations::fit_kind(Kind kind) const {
  constexpr double ridge = 1e-5;  // of the weight that was found
  constexpr int most_iterations = 100;
  const double all_found = found(kind);
  if (!(all_found > 0.0)) throw std::invalid_argument("new surface: nothing was found in voxels of some kind");
  const auto likelihood = kind == Kind::unmeasured ? of_rate : of_log_odds;
  using Vector = Eigen::Vector<double, static_cast<int>(n)>;
  using Matrix = Eigen::Matrix<double, static_cast<int>(n), static_cast<int>(n)>;
  Vector coefficients = Vector::Zero();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Vector slope = -ridge * all_found * coefficients;
    Matrix curvature = Matrix::Identity() * ridge * all_found;
    for (const auto& [key, cell] : cells_) {
      if (key[0] != static_cast<std::int16_t>(kind)) continue;
      const Vector features = Eigen::Map<const Vector>(cell.features.data()) / cell.weight;
      const Likelihood at = likelihood(coefficients.dot(features), cell.size / cell.weight, cell.weight, cell.found);
      slope += at.slope * features;
      curvature += at.curvature * features * features.transpose();
    }
    Vector step = curvature.ldlt().solve(slope);
    if (step.norm() > 2.0) step *= 2.0 / step.norm();  // the start is far from where the likelihood is quadratic
    coefficients += step;
    if (step.norm() < 1e-9) break;
  }
  std::array<double, n> fitted;
  Eigen::Map<Vector>(fitted.data()) = coefficients;
  return fitted;
}

NewSurfaceModel NewSurfaceObservations::fit() const {
  NewSurfaceModel model;
  model.unmeasured = fit_kind<std::tuple_size_v<SurfaceEvidence::Unmeasured>>(Kind::unmeasured);
  model.free = fit_kind<std::tuple_size_v<SurfaceEvidence::Measured>>(Kind::free);
  model.occupied = fit_kind<std::tuple_size_v<SurfaceEvidence::Measured>>(Kind::occupied);
  model.mean_slant = surface_ / across_;
  model.slant = {model.mean_slant, model.mean_slant};
  return model;
}

}  // namespace nextview
