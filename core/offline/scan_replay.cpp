#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

#include "core/config/input_files.hpp"
#include "core/file/atomic_file.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/mesh/parts.hpp"
#include "core/offline/refinement.hpp"
#include "core/progress/stopped.hpp"
#include "core/results/output_folder.hpp"
#include "core/session/session_parts.hpp"
#include "core/source/simulated_source.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// The poses that views.csv says were taken. Where that is a candidate's or the start view it is looked up, as the text
/// of a pose rounds.
std::vector<Pose> views_taken(const fs::path& file, const Configuration& configuration) {
  const auto candidates = candidate_views(configuration.views, view_target(configuration));
  const Pose start = configured_start_view(configuration);
  std::istringstream text(read_file(file, std::uintmax_t{1} << 24));
  std::string line;
  std::getline(text, line);
  std::vector<Pose> poses;
  for (int number = 2; std::getline(text, line); ++number) {
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream row(line);
    int step = 0, view = 0;
    Vector3 p;
    Eigen::Quaterniond q;
    row >> step >> view >> p.x() >> p.y() >> p.z() >> q.x() >> q.y() >> q.z() >> q.w();
    const bool whole = !row.fail() && (row >> std::ws).eof();
    if (!whole || view < -1 || view >= int(candidates.size()) || std::abs(q.norm() - 1.0) > 1e-6 || !p.allFinite())
      throw std::runtime_error(fmt::format("{}:{}: not a view of this scan", file.string(), number));
    const Pose written = make_pose(p, q);
    const Pose& exact = view >= 0 ? candidates[view] : start;
    const bool is_exact = (view >= 0 || step == 1) && written.isApprox(exact, 1e-6);
    poses.push_back(is_exact ? exact : written);
  }
  if (poses.empty()) throw std::runtime_error(fmt::format("{}: holds no view", file.string()));
  return poses;
}

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

}  // namespace

RefinementJob refinement_job(const fs::path& folder, const std::function<void(Configuration&)>& override_settings,
                             const Progress& progress, std::stop_token stop) {
  Configuration c = read_configuration(folder / "config.toml");
  if (override_settings) override_settings(c);
  c.validate();
  require_scanned_object(folder, c);
  RefinementJob job = refinement_job(c, views_taken(folder / "views.csv", c), progress, stop);
  job.inputs.push_back({folder, "the scan that is read"});
  job.inputs.push_back({folder / "views.csv", "the list of the views that are taken again"});
  return job;
}

RefinementJob refinement_job(const Configuration& configuration, std::span<const Pose> views, const Progress& progress,
                             std::stop_token stop) {
  Configuration c = configuration;
  const auto [object, mesh] = load_object(c, stop);
  const auto world = std::make_shared<const SimulatedWorld>(mesh, c.sensor, stop);

  RefinementJob job;
  job.name = object.stem().string();
  job.object = object;
  job.grid = configured_region(c);
  job.model = c.map.model;
  job.ray_length = c.planner.ray_length;
  job.candidates = candidate_views(c.views, view_target(c));
  job.bundle = scoring_rays(c, world->camera.camera());
  job.sampler = posterior_sampler_config(c);
  job.configuration = c;
  job.inputs = input_files(c);
  SimulatedSource source(world, c.seed);
  job.scans = take_scans(source, views_at(views), &c.cloud, progress, stop);
  const KnownObject known(mesh->surroundings(), evaluation_samples(c, mesh->mesh),
                          std::shared_ptr<const MeshRayCaster>(world, &world->scene), world->camera, job.candidates,
                          job.grid, c.evaluation.d_reg, progress, stop);
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

}  // namespace nextview
