#include "core/offline/map_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

/// Grows what is 1 by `reach` voxels in all directions (Chebyshev), one axis after the other.
std::vector<std::uint8_t> grown(const VoxelGrid& grid, std::vector<std::uint8_t> mask, int reach) {
  const std::array<std::size_t, 3> strides = {1, std::size_t(grid.size.x()),
                                              std::size_t(grid.size.x()) * std::size_t(grid.size.y())};
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<std::uint8_t> before = mask;
    for (std::uint32_t v = 0; v < before.size(); ++v) {
      if (!before[v]) continue;
      const int at = grid.cell(v)[axis];
      for (int step = -std::min(reach, at); step <= std::min(reach, grid.size[axis] - 1 - at); ++step)
        mask[v + std::ptrdiff_t(step) * std::ptrdiff_t(strides[axis])] = 1;
    }
  }
  return mask;
}

/// The voxels that count, see MapCalibrationConfig::band.
std::vector<std::uint8_t> scored_voxels(const GibbsPosterior& posterior, const VoxelBricks& conventional, int band) {
  const std::size_t voxels = posterior.occupied.size();
  std::vector<std::uint8_t> near(voxels, 1);
  if (band > 0) {
    for (std::size_t v = 0; v < voxels; ++v) near[v] = posterior.informed[v] && posterior.touch[v] >= 0.5f;
    near = grown(posterior.grid, std::move(near), band);
  }
  auto voxel = conventional.begin();
  for (std::size_t v = 0; v < voxels; ++v, ++voxel) near[v] &= posterior.informed[v] && (*voxel).measured;
  return near;
}

GibbsReliability reliability(const VoxelBricks& conventional, std::span<const float> gibbs,
                             std::span<const std::uint8_t> mask) {
  GibbsReliability bins;
  for (std::size_t v = 0; v < mask.size(); ++v) {
    if (!mask[v]) continue;
    const double p = conventional[v].probability;
    ReliabilityBin& bin = bins[std::min<std::size_t>(bins.size() - 1, std::size_t(p * double(bins.size())))];
    ++bin.voxels;
    bin.mean_probability += p;
    bin.occupied_share += gibbs[v];
  }
  for (ReliabilityBin& bin : bins)
    if (bin.voxels > 0) {
      bin.mean_probability /= double(bin.voxels);
      bin.occupied_share /= double(bin.voxels);
    }
  return bins;
}

/// An example with its Gibbs map, and what its scans did to the voxels that count.
struct Prepared {
  const CalibrationExample& example;
  Refinement refinement;
  std::vector<std::uint8_t> mask;
  UpdateHistories histories;
};

ExampleScores score(const Prepared& prepared, const InverseSensorModel& before, const InverseSensorModel& after,
                    const std::stop_token& stop) {
  const RefinementJob& job = prepared.example.job;
  const std::vector<float>& gibbs = prepared.refinement.posterior.touch;
  ExampleScores scores;
  scores.name = job.name;
  scores.views = job.scans.size();
  scores.held_out = prepared.example.held_out;
  scores.gibbs_stationary = prepared.refinement.posterior.diagnostics.stationary;
  scores.voxels = std::size_t(std::count(prepared.mask.begin(), prepared.mask.end(), 1));
  scores.gibbs = prepared.refinement.scores_after;
  const auto made_with = [&](const InverseSensorModel& model) {
    OccupancyMap map(job.grid, model);
    for (const Scan& scan : job.scans) map.insert(scan, stop);
    return map;
  };
  const OccupancyMap map_before = job.model == before ? prepared.refinement.conventional : made_with(before);
  const OccupancyMap map_after = made_with(after);
  scores.before = score_map(map_before.voxels(), job.truth);
  scores.after = score_map(map_after.voxels(), job.truth);
  scores.reliability_before = reliability(map_before.voxels(), gibbs, prepared.mask);
  scores.reliability_after = reliability(map_after.voxels(), gibbs, prepared.mask);
  if (scores.voxels == 0) return scores;
  scores.cross_entropy_before = prepared.histories.cross_entropy(before).value;
  scores.cross_entropy_after = prepared.histories.cross_entropy(after).value;
  double sum = 0.0;
  for (std::size_t v = 0; v < gibbs.size(); ++v)
    if (prepared.mask[v]) sum += entropy(gibbs[v]);
  scores.gibbs_entropy = sum / double(scores.voxels);
  return scores;
}

void check(std::span<const CalibrationExample> examples) {
  const auto fitted = [](const CalibrationExample& e) { return !e.held_out; };
  if (std::none_of(examples.begin(), examples.end(), fitted))
    throw std::invalid_argument("calibration: there is nothing to fit to; every example is held out");
  for (const CalibrationExample& e : examples)
    if (e.job.grid.resolution != examples.front().job.grid.resolution)
      throw std::invalid_argument(fmt::format(
          "calibration: {} has voxels of {} m, {} of {} m; a sensor model is for one size: give --resolution",
          e.job.name, e.job.grid.resolution, examples.front().job.name, examples.front().job.grid.resolution));
}

std::string nothing_to_fit_to(std::span<const CalibrationExample> examples) {
  std::vector<std::string> fitted;
  std::size_t hits = 0;
  for (const CalibrationExample& e : examples) {
    if (e.held_out) continue;
    if (std::ranges::find(fitted, e.job.name) == fitted.end()) fitted.push_back(e.job.name);
    for (const Scan& scan : e.job.scans) hits += scan.hits.size();
  }
  return fmt::format("calibration: {}: there is nothing to fit to: {}", fmt::join(fitted, ", "),
                     hits == 0 ? "no view met a surface; mind views.radius, sensor.min_range and sensor.max_range"
                               : "no Gibbs map calls a voxel occupied; give more views, pixels or gibbs.sweeps");
}

}  // namespace

MapCalibration calibrate_map(std::vector<CalibrationExample> examples, const MapCalibrationConfig& config,
                             const Progress& progress, std::stop_token stop) {
  check(examples);
  std::vector<Prepared> prepared;
  UpdateHistories histories;
  for (std::size_t e = 0; e < examples.size(); ++e) {
    const RefinementJob& job = examples[e].job;
    const auto done = [&](std::size_t count) { return 0.8 * double(count) / double(examples.size()); };
    Refinement refinement = refine(job, part(progress, done(e), done(e + 1)), stop);
    throw_if_stopped(stop);
    auto mask = scored_voxels(refinement.posterior, refinement.conventional.voxels(), config.band);
    UpdateHistories of_example;
    of_example.add(job.grid, job.scans, refinement.posterior.touch, mask, stop);
    if (!examples[e].held_out) histories.append(of_example);
    prepared.push_back({examples[e], std::move(refinement), std::move(mask), std::move(of_example)});
  }
  if (histories.voxels() == 0) throw std::invalid_argument(nothing_to_fit_to(examples));
  MapCalibration result;
  result.config = config;
  result.before = examples.front().job.model;
  result.fit = calibrate(histories, result.before, config.fit, part(progress, 0.8, 0.95), stop);
  throw_if_stopped(stop);
  for (const Prepared& p : prepared) result.examples.push_back(score(p, result.before, result.fit.model, stop));
  return result;
}

}  // namespace nextview
