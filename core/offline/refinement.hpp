#pragma once
#include <filesystem>
#include <memory>
#include <optional>

#include "core/config/configuration.hpp"
#include "core/evaluation/known_object.hpp"
#include "core/evaluation/map_quality.hpp"
#include "core/evaluation/openings.hpp"
#include "core/gibbs/gibbs_state.hpp"
#include "core/mesh/surface_samples.hpp"
#include "core/offline/scene_parameters.hpp"
#include "core/results/input_file.hpp"

namespace nextview {

struct ConfiguredObject;

/// What is known of the object that was scanned, if it was a simulation.
struct RefinementTruth {
  std::shared_ptr<const TriangleMesh> mesh;
  GroundTruth voxels;
  std::vector<std::uint8_t> visited;       ///< by noise-free rays
  std::vector<Opening> openings;           ///< of our own parts
  SurfaceSamples samples = {};             ///< of the true surface
  std::vector<std::uint8_t> visible = {};  ///< one per sample, 1: some candidate sees it
};

/// Everything that refining the map of finished scans needs.
struct RefinementJob {
  std::string name;                             ///< of the object or scene, for people
  std::optional<std::filesystem::path> object;  ///< its file, if it was a simulation
  VoxelGrid grid;
  InverseSensorModel model;
  double ray_length = 1.5;  ///< of rays that score a view [m]
  std::vector<Scan> scans;
  std::vector<Pose> candidates;
  RayBundle bundle;
  PosteriorSamplerConfig sampler;
  std::optional<RefinementTruth> truth;
  Configuration configuration;       ///< to be written beside the results
  std::vector<InputFile> inputs;     ///< that all this was read from: nothing may replace them
  std::vector<std::string> notices;  ///< for people: what was left out of it, and why
};

/// A folder that `scan` wrote: its views are taken again, with the same noise. Settings of `gibbs`, by key, override
/// those that the folder's configuration has.
/// @throws std::runtime_error naming the file and the reason.
RefinementJob refinement_job(const std::filesystem::path& scan_folder,
                             const std::function<void(Configuration&)>& override_settings,
                             const Progress& progress = {}, std::stop_token stop = {});
/// What a configuration's camera sees of its object from these views: the k-th with the noise that it would have as a
/// scan's k-th view. @throws std::runtime_error if stopped, or naming a file and the reason.
RefinementJob refinement_job(const Configuration& configuration, std::span<const Pose> views,
                             const Progress& progress = {}, std::stop_token stop = {});
/// The same of an object that was loaded already, and the configuration that load_object() fitted to it.
RefinementJob refinement_job(const Configuration& fitted, const ConfiguredObject& object, std::span<const Pose> views,
                             const Progress& progress = {}, std::stop_token stop = {});
/// A recorded scene. Its sensor's noise is not known: a sigma of 0 means a quarter of a voxel edge.
RefinementJob refinement_job(const RecordedScene& scene, const GibbsConfig& gibbs, std::uint64_t seed,
                             const std::function<void(const std::string&)>& warn = {});

/// A map's scores; nothing where there is no truth.
struct MapScores {
  MapQuality touch_band, centre_band;        ///< visited voxels near the surface
  MapQuality touch_visited, centre_visited;  ///< all visited voxels
  std::optional<double> surface_recall;      ///< touch truth
  OpeningScore openings;                     ///< all of the part's; centre truth
};

/// The map before and after.
struct Refinement {
  OccupancyMap conventional;
  GibbsPosterior posterior;
  VoxelBricks refined;                            ///< the posterior as gains see it
  std::vector<double> gains_before, gains_after;  ///< the gain `gibbs` of each candidate on either map [nats]
  double rank_correlation = 0.0;                  ///< Spearman's
  std::optional<MapScores> scores_before, scores_after;
};

Refinement refine(const RefinementJob& job, const Progress& progress = {}, std::stop_token stop = {});
/// Each truth by the map's own p.
std::optional<MapScores> score_map(const VoxelBricks& map, const std::optional<RefinementTruth>& truth);
/// Of a map that has a probability of its own for either truth; surface recall is of `touch`, openings of `centre`.
MapScores score_map(std::span<const Voxel> touch, std::span<const Voxel> centre, const RefinementTruth& truth);
/// The posterior, each truth by its own read-out: touch by GibbsPosterior::touch, centre and openings by ::centre.
std::optional<MapScores> score_posterior(const GibbsPosterior& posterior, const InverseSensorModel& classes,
                                         const std::optional<RefinementTruth>& truth);

}  // namespace nextview
