// What a session runner shows of its session.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/config/known_objects.hpp"
#include "core/evaluation/map_quality.hpp"
#include "core/mesh/surface_samples.hpp"
#include "ui/workbench/session_runner.hpp"

namespace nextview {
namespace {

constexpr std::size_t max_runs = 6;            ///< that stay for their curves
constexpr std::size_t surface_points = 4'000;  ///< by which a view is judged before it is taken

/// Nobody doubts those of the objects that come with the program.
std::string guessed_unit(const Session& session) {
  if (!session.mesh() || session.configuration().object.unit != LengthUnit::automatic) return "";
  const LengthUnit taken = session.object().unit;
  const bool is_known = std::ranges::count(known_objects(), session.name()) > 0;
  return taken == LengthUnit::automatic || is_known ? "" : std::string(name(taken));
}

SurfacePoints points_of(const TriangleMesh& mesh, const MeshTopology& topology, std::uint64_t seed) {
  SurfaceSamples samples = sample_surface(mesh, surface_points, seed);
  SurfacePoints points{std::move(samples.points), {}};
  if (!topology.watertight() || topology.misoriented_edges > 0) return points;
  for (const std::uint32_t t : samples.triangles) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Eigen::Vector3f normal = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    points.outward.push_back(topology.inward ? -normal.normalized() : normal.normalized());
  }
  return points;
}

}  // namespace

void SessionRunner::publish(SessionSnapshot snapshot) {
  snapshot.message.clear();
  snapshot.can_undo = history_.can_undo();
  snapshot.can_redo = history_.can_redo();
  snapshot.change = history_.last_change();
  snapshot.timeline = tree_ ? std::make_shared<const Timeline>(tree_->timeline()) : nullptr;
  const bool is_there = snapshot.compared && tree_ && tree_->branches.has(snapshot.compared->branch);
  if (!is_there || snapshot.compared->branch == tree_->branches.current().name) snapshot.compared = nullptr;
  snapshot.kept = kept_ && kept_->folder();
  snapshot.keeping_fails = kept_ && kept_->fails();
  // Also where the session stands elsewhere: the map comes back with its views.
  snapshot.gibbs_lost = tree_ && tree_->refined.is_in_memory_alone() ? tree_->refined.map->views : 0;
  snapshot.gibbs_lost_aside = history_.gibbs_maps_in_memory_alone();
  snapshot.cameras =
      std::make_shared<const std::vector<CameraBookmark>>(kept_ ? kept_->cameras() : std::vector<CameraBookmark>());
  snapshot.live = scanner_ != nullptr;
  snapshot.scanner_lost = scanner_ && scanner_->is_lost();
  snapshot_ = std::make_shared<const SessionSnapshot>(std::move(snapshot));
}

void SessionRunner::set_message(const std::string& message) {
  SessionSnapshot next = *snapshot_;
  next.message = message;
  if (!session_) next.configuration = wanted_;
  next.scanner_lost = scanner_ && scanner_->is_lost();
  ++next.failures;
  snapshot_ = std::make_shared<const SessionSnapshot>(std::move(next));
}

/// What a new session takes the place of stays for its curves.
void SessionRunner::remember_run(SessionSnapshot& snapshot) {
  if (snapshot.records.empty()) return;
  Run run{fmt::format("{}, {}", snapshot.object_name, snapshot.configuration.planner.gain), snapshot.records,
          snapshot.object_name};
  for (StepRecord& record : run.records) record.candidates.clear();
  std::vector<Run> runs;
  if (snapshot.earlier_runs) runs = *snapshot.earlier_runs;
  runs.push_back(std::move(run));
  if (runs.size() > max_runs) runs.erase(runs.begin());
  snapshot.earlier_runs = std::make_shared<const std::vector<Run>>(std::move(runs));
}

void SessionRunner::show_session(SessionSnapshot& next) const {
  next.mesh = session_->mesh();
  next.surface_points = next.mesh ? std::make_shared<const SurfacePoints>(points_of(
                                        *next.mesh, session_->object_topology(), session_->configuration().seed))
                                  : nullptr;
  next.truth = seen_->truth();
  next.object_name = session_->name();
  next.guessed_unit = guessed_unit(*session_);
  next.notes = session_->notes();
  next.grid = session_->map().grid();
  next.camera = session_->camera();
  next.object_box = next.mesh ? next.mesh->bounding_box() : next.grid.box();
}

void SessionRunner::show_map(SessionSnapshot next) {
  fill_map(next);
  publish(std::move(next));
}

void SessionRunner::fill_map(SessionSnapshot& next) {
  ++next.map;
  next.setup = std::make_shared<const ScanSetup>(session_->setup());  // another planner may rank by now
  next.gain_unit = session_->planner().unit();
  next.planned_on_posterior = session_->planner().needs().posterior;
  next.configuration = session_->configuration();
  next.state = session_->state();
  next.voxels = LaidOutVoxels(session_->map().voxels());
  next.candidates = session_->candidates();
  next.records = session_->records();
  next.finished = session_->finished();
  next.scans = session_->scans();
  seen_->follow(session_->scans());
  if (!compares_later_) seen_->compare(session_->scans());
  next.cloud = seen_->cloud();
  next.missed = seen_->missed();
  next.orders = nullptr;
  if (const auto taken = frames_taken(session_->state().known); next.is_recording() && !taken.empty())
    next.orders =
        std::make_shared<const CoverageByOrder>(next.setup->recorded->compare_orders(taken, next.configuration.seed));
  if (session_->refinement() && !next.records.empty()) show_refinement(next, *session_->refinement());
  show_next_view(next);
}

void SessionRunner::show_refinement(SessionSnapshot& snapshot, const GibbsState& refinement) {
  ++snapshot.map;
  LaidOutVoxels voxels(refinement.voxels());
  const RefinementChange change = refinement_change(*snapshot.voxels, *voxels);
  snapshot.gibbs = std::make_shared<const GibbsMap>(GibbsMap{session_->scans().size(), refinement.shared_posterior(),
                                                             std::move(voxels), refinement.shared_measurements(),
                                                             refinement.config(), change});
}

void SessionRunner::show_next_view(SessionSnapshot& snapshot) const {
  snapshot.next_candidate = session_->next_candidate();
  snapshot.next_view = session_->next_view();
  snapshot.custom_next_view = session_->next_view_is_custom();
  snapshot.explanation = nullptr;
  if (!snapshot.finished.empty() || (!snapshot.next_candidate && !snapshot.custom_next_view)) return;
  if (auto explanation = session_->explain(snapshot.next_view))
    snapshot.explanation = std::make_shared<const ScoreExplanation>(std::move(*explanation));
}

}  // namespace nextview
