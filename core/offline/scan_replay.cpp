#include <fmt/format.h>

#include <stdexcept>

#include "core/config/input_files.hpp"
#include "core/config/known_objects.hpp"
#include "core/journal/journal.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/mesh/parts.hpp"
#include "core/offline/refinement.hpp"
#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"
#include "core/results/output_folder.hpp"
#include "core/session/object_mesh.hpp"
#include "core/session/recording_setup.hpp"
#include "core/session/session_parts.hpp"
#include "core/session/taken_views.hpp"
#include "core/source/simulated_source.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// The openings that stand beside a part of ours, moved as its mesh was. A JSON of that name may be anything: if it
/// does not list openings there are none, and a notice says so.
std::vector<Opening> known_openings(const fs::path& object, const MeshPlacement& placement,
                                    std::vector<std::string>& notices) {
  const fs::path file = openings_file(object);
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return {};
  std::vector<Opening> openings;
  try {
    for (const Opening& opening : read_openings(file)) openings.push_back(placed(opening, placement));
  } catch (const std::runtime_error& error) {
    notices.push_back(fmt::format("{}; ignored, as it is no list of the object's openings", error.what()));
    openings.clear();
  }
  return openings;
}

/// What was scanned must still be there, and the same. @throws std::runtime_error naming the file and the reason.
void require_scanned_object(const fs::path& folder, const Configuration& c) {
  require_same_object(folder, resolve_object(c));
}

/// What both kinds of scans have.
RefinementJob job_of(const Configuration& c, const PinholeCamera& camera) {
  RefinementJob job;
  job.grid = configured_region(c);
  job.model = c.map.model;
  job.ray_length = c.planner.ray_length;
  job.bundle = scoring_rays(c, camera);
  job.sampler = posterior_sampler_config(c);
  job.configuration = c;
  job.inputs = input_files(c);
  return job;
}

/// What a session captured, cleaned.
struct KeptScans {
  std::vector<Pose> poses;
  std::vector<Scan> scans;
};

KeptScans kept_scans(const Journal& journal, const fs::path& folder, const Configuration& c,
                     const std::stop_token& stop) {
  KeptScans kept;
  for (const JournalStep& step : journal.line()) {
    kept.poses.push_back(step.T_world_camera);
    kept.scans.push_back(to_scan(read_capture(step, folder), &c.cloud, stop).scan);
  }
  if (kept.scans.empty()) throw std::runtime_error(fmt::format("{}: holds no view", folder.string()));
  return kept;
}

/// A scan that went through recorded data.
RefinementJob recorded_job(Configuration c, const fs::path& folder, const Progress& progress,
                           const std::stop_token& stop) {
  const auto source = open_configured_recording(c, part(progress, 0.0, 0.5), stop);
  RefinementJob job = job_of(c, source->describe().camera);
  job.name = recording_name(c.recorded.folder);
  job.candidates = poses_of(source->describe().frames);
  if (has_journal(folder))
    job.scans = kept_scans(read_journal(folder), folder, c, stop).scans;
  else
    job.scans =
        take_scans(*source, frames_listed(folder / "views.csv", *source), &c.cloud, part(progress, 0.5, 1.0), stop);
  return job;
}

/// A scan of a live scanner.
RefinementJob live_job(const Configuration& c, const fs::path& folder, const std::stop_token& stop) {
  RefinementJob job = job_of(c, c.sensor.camera());
  job.name = c.driver.name;
  job.candidates = candidate_views(c.views, view_target(c));
  job.scans = kept_scans(read_journal(folder), folder, c, stop).scans;
  return job;
}

/// A simulated scan of an object, sensed again unless its scans are at hand.
RefinementJob simulated_job(const Configuration& c, const ConfiguredObject& configured, std::span<const Pose> views,
                            std::vector<Scan> scans, const Progress& progress, const std::stop_token& stop) {
  const auto& [object, mesh] = configured;
  const auto world = std::make_shared<const SimulatedWorld>(mesh, c.sensor, stop);

  RefinementJob job = job_of(c, world->camera.camera());
  job.name = object.stem().string();
  job.object = object;
  if (mesh->cloud_points > 0) job.notices.push_back(cloud_note(*mesh));
  job.candidates = candidate_views(c.views, view_target(c));
  SimulatedSource source(world, c.seed);
  job.scans =
      scans.empty() ? take_scans(source, views_at(views), &c.cloud, part(progress, 0.0, 0.5), stop) : std::move(scans);
  const KnownObject known(mesh->surroundings(), evaluation_samples(c, mesh->mesh),
                          std::shared_ptr<const MeshRayCaster>(world, &world->scene), world->camera, job.candidates,
                          job.grid, c.evaluation.d_reg, stop);
  known.sight(part(progress, 0.5, 1.0), stop);
  EvaluationState evaluation = known.nothing_seen();
  for (std::size_t k = 0; k < views.size(); ++k) known.add_view(evaluation, views[k], job.scans[k].hits, stop);
  job.truth = RefinementTruth{std::shared_ptr<const TriangleMesh>(mesh, &mesh->mesh),
                              known.truth(),
                              evaluation.visited_voxels.bytes(),
                              known_openings(object, mesh->placement, job.notices),
                              known.samples(),
                              {known.visible().begin(), known.visible().end()}};
  return job;
}

}  // namespace

RefinementJob refinement_job(const fs::path& folder, const std::function<void(Configuration&)>& override_settings,
                             const Progress& progress, std::stop_token stop) {
  Configuration c = read_configuration(folder / "config.toml");
  if (override_settings) override_settings(c);
  c.validate();
  RefinementJob job;
  if (!c.recorded.folder.empty()) {
    job = recorded_job(c, folder, progress, stop);
  } else if (!c.driver.name.empty() && has_journal(folder)) {
    job = live_job(c, folder, stop);
  } else if (has_journal(folder)) {
    const Journal journal = read_journal(folder);
    require_same_input(journal, folder);
    const ConfiguredObject object = load_object(c, stop);
    KeptScans kept = kept_scans(journal, folder, c, stop);
    job = simulated_job(c, object, kept.poses, std::move(kept.scans), progress, stop);
  } else {
    require_scanned_object(folder, c);
    const ConfiguredObject object = load_object(c, stop);
    job = simulated_job(c, object, views_taken(folder / "views.csv", c), {}, progress, stop);
  }
  job.inputs.push_back({folder, "the scan that is read"});
  job.inputs.push_back({folder / "views.csv", "the list of its views"});
  return job;
}

RefinementJob refinement_job(const Configuration& configuration, std::span<const Pose> views, const Progress& progress,
                             std::stop_token stop) {
  Configuration c = configuration;
  const ConfiguredObject object = load_object(c, stop);
  return refinement_job(c, object, views, progress, stop);
}

RefinementJob refinement_job(const Configuration& fitted, const ConfiguredObject& object, std::span<const Pose> views,
                             const Progress& progress, std::stop_token stop) {
  return simulated_job(fitted, object, views, {}, progress, stop);
}

}  // namespace nextview
