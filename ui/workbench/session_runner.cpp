#include "ui/workbench/session_runner.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/evaluation/map_quality.hpp"
#include "core/mesh/surface_samples.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/known_objects.hpp"
#include "core/session/scan_files.hpp"
#include "core/session/scan_surfaces.hpp"
#include "core/session/session_parts.hpp"
#include "ui/workbench/overloaded.hpp"

namespace nextview {
namespace {

constexpr std::size_t most_runs = 6;           ///< that stay for their curves
constexpr std::size_t surface_points = 4'000;  ///< by which a view is judged before it is taken
constexpr int most_views = 10'000;             ///< that a scan may have

bool differ_in_termination_alone(const Configuration& a, Configuration b) {
  b.termination = a.termination;
  return to_toml(a) == to_toml(b);
}

/// A part of a job, from `begin` to `end` of the whole.
Progress part(const Progress& whole, double begin, double end) {
  return [=](double fraction, std::string_view what) {
    if (whole) whole(begin + fraction * (end - begin), what);
  };
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
  snapshot.can_undo = !undo_.empty();
  snapshot.can_redo = !redo_.empty();
  snapshot_ = std::make_shared<const SessionSnapshot>(std::move(snapshot));
}

void SessionRunner::set_message(const std::string& message) {
  SessionSnapshot next = *snapshot_;
  next.message = message;
  if (!session_) next.configuration = wanted_;
  ++next.failures;
  snapshot_ = std::make_shared<const SessionSnapshot>(std::move(next));
}

/// The session of a trail, with all its views taken again: the same bytes as the first time.
std::unique_ptr<Session> SessionRunner::follow(const Trail& trail, const Told& told) const {
  const double load_share = trail.views.empty() ? 1.0 : 0.3;
  Configuration without_end = trail.configuration;  // views may have been taken before it was changed
  without_end.termination = TerminationConfig{.views = most_views};
  auto session = std::make_unique<Session>(std::move(without_end), part(told.progress, 0.0, load_share), told.stop);
  for (std::size_t k = 0; k < trail.views.size(); ++k) {
    std::visit(Overloaded{[](std::monostate) {}, [&](const auto& view) { session->override_next_view(view); }},
               trail.views[k]);
    const double done = load_share + (1 - load_share) * double(k) / double(trail.views.size());
    if (told.progress) told.progress(done, fmt::format("repeating view {} of {}", k + 1, trail.views.size()));
    if (!session->step({}, told.stop)) throw Stopped();
  }
  session->set_termination(trail.configuration.termination);
  return session;
}

void SessionRunner::load(Configuration configuration, const Told& told) {
  configuration.validate();
  if (!session_) wanted_ = configuration;
  Trail trail{std::move(configuration), {}};
  auto session = follow(trail, told);
  if (session_) undo_.push_back(std::move(trail_));
  redo_.clear();
  trail_ = std::move(trail);
  SessionSnapshot next = *snapshot_;
  ++next.session;
  remember_run(next);
  adopt(std::move(session), std::move(next));
}

void SessionRunner::set_termination(const TerminationConfig& termination) {
  if (!session_) return;
  session_->set_termination(termination);
  undo_.push_back(trail_);
  redo_.clear();
  trail_.configuration.termination = termination;
  show_termination();
}

void SessionRunner::show_termination() {
  SessionSnapshot next = *snapshot_;
  next.configuration = session_->configuration();
  next.finished = session_->finished();
  show_next_view(next);
  publish(std::move(next));
}

void SessionRunner::step(const Told& told) {
  if (!can_step() || !session_->step(told.progress, told.stop)) return;
  undo_.push_back(trail_);
  redo_.clear();
  trail_.views.push_back(std::exchange(next_, {}));
  show_map(*snapshot_);
}

void SessionRunner::take(const Override& view) {
  if (!session_) return;
  std::visit(Overloaded{[](std::monostate) {}, [&](const auto& v) { session_->override_next_view(v); }}, view);
  next_ = view;
  SessionSnapshot next = *snapshot_;
  show_next_view(next);
  publish(std::move(next));
}

void SessionRunner::take_view(std::size_t candidate) { take(candidate); }
void SessionRunner::take_own_view(const Pose& T_world_camera) { take(T_world_camera); }

/// Goes to where `from` ends, and leaves the way back on `to`.
void SessionRunner::travel(std::vector<Trail>& from, std::vector<Trail>& to, const Told& told) {
  if (from.empty()) return;
  const bool same_scan = differ_in_termination_alone(from.back().configuration, trail_.configuration);
  if (same_scan && from.back().views.size() == trail_.views.size()) {  // it was set_termination() that led there
    session_->set_termination(from.back().configuration.termination);
    to.push_back(std::exchange(trail_, std::move(from.back())));
    from.pop_back();
    return show_termination();
  }
  auto session = follow(from.back(), told);
  to.push_back(std::exchange(trail_, std::move(from.back())));
  from.pop_back();
  SessionSnapshot next = *snapshot_;
  if (!same_scan) ++next.session;
  adopt(std::move(session), std::move(next));
}

void SessionRunner::undo(const Told& told) { travel(undo_, redo_, told); }
void SessionRunner::redo(const Told& told) { travel(redo_, undo_, told); }

void SessionRunner::refine(int chains, int sweeps, const Told& told) {
  if (!session_ || session_->scans().empty()) return;
  PosteriorSamplerConfig config = posterior_sampler_config(session_->configuration());
  config.chains = chains;
  config.sweeps = sweeps;
  config.keep_traces = true;
  config.validate();
  const bool same = refinement_ && refinement_->config().chains == chains && refinement_->config().sweeps == sweeps;
  if (!same) {
    refinement_ = std::make_unique<MapRefinement>(session_->map().grid(), config, session_->map().model(),
                                                  session_->configuration().sensor.max_range);
    refined_scans_ = 0;
  }
  for (; refined_scans_ < session_->scans().size(); ++refined_scans_) {
    if (told.stop.stop_requested()) throw Stopped();
    told.progress(0.1 * double(refined_scans_) / double(session_->scans().size()), "joining the rays of each view");
    refinement_->add(*session_->scans()[refined_scans_]);
  }
  const auto progress = [&](double fraction, std::string_view what, const SamplerDiagnostics& so_far) {
    told.sampler(so_far);
    told.progress(0.1 + 0.9 * fraction, what);
  };
  refinement_->refine(probabilities(session_->map().voxels()), 0, progress, told.stop);
  SessionSnapshot next = *snapshot_;
  show_refinement(next, *refinement_);
  publish(std::move(next));
}

std::vector<std::string> SessionRunner::write(const std::filesystem::path& folder, const Told& told) const {
  if (!session_ || session_->records().empty()) throw std::invalid_argument("there is no view to write yet");
  OutputFolder out(folder, input_files(session_->configuration()), "");
  out.begin("scan", session_->object_file());
  told.progress(0.0, "writing the scan");
  write_scan(*session_, out);
  const auto surfaces = scan_surfaces(*session_, part(told.progress, 0.2, 0.9), told.stop);
  if (told.stop.stop_requested()) throw Stopped();
  write_surfaces(surfaces, out);
  std::vector<std::string> summaries;
  for (const ScanSurface& surface : surfaces) summaries.push_back("Surface " + summary(surface));
  return summaries;
}

void SessionRunner::forget_runs() {
  SessionSnapshot next = *snapshot_;
  next.earlier_runs = nullptr;
  publish(std::move(next));
}

/// What a new session takes the place of stays for its curves.
void SessionRunner::remember_run(SessionSnapshot& snapshot) {
  if (snapshot.records.empty()) return;
  Run run{fmt::format("{}, {}", snapshot.object_name, snapshot.configuration.planner.gain), snapshot.records};
  for (StepRecord& record : run.records) record.candidates.clear();
  std::vector<Run> runs;
  if (snapshot.earlier_runs) runs = *snapshot.earlier_runs;
  runs.push_back(std::move(run));
  if (runs.size() > most_runs) runs.erase(runs.begin());
  snapshot.earlier_runs = std::make_shared<const std::vector<Run>>(std::move(runs));
}

void SessionRunner::adopt(std::unique_ptr<Session> session, SessionSnapshot next) {
  session_ = std::move(session);
  refinement_.reset();
  refined_scans_ = 0;
  seen_ = std::make_unique<SeenSurface>(*session_);
  next_ = {};
  next.gibbs = nullptr;
  next.mesh = session_->mesh();
  next.surface_points = std::make_shared<const SurfacePoints>(
      points_of(*next.mesh, session_->object_topology(), session_->configuration().seed));
  next.truth = seen_->truth();
  next.configuration = session_->configuration();
  next.object_name = object_name(session_->object_file());
  next.grid = session_->map().grid();
  next.camera = session_->camera().camera();
  next.candidates = session_->candidates();
  next.gain_unit = session_->policy().unit();
  next.planned_on_posterior = session_->policy().needs().posterior;
  show_map(std::move(next));
}

void SessionRunner::show_map(SessionSnapshot next) {
  const auto voxels = session_->map().voxels();
  ++next.map;
  next.voxels = std::make_shared<const std::vector<Voxel>>(voxels.begin(), voxels.end());
  next.records = session_->records();
  next.finished = session_->finished();
  next.scans = session_->scans();
  seen_->follow(*session_);
  next.cloud = seen_->cloud();
  next.missed = seen_->missed();
  if (session_->refinement() && !next.records.empty()) show_refinement(next, *session_->refinement());
  show_next_view(next);
  publish(std::move(next));
}

void SessionRunner::show_refinement(SessionSnapshot& snapshot, const MapRefinement& refinement) {
  ++snapshot.map;
  snapshot.gibbs = std::make_shared<const GibbsMap>(
      GibbsMap{session_->scans().size(), refinement.shared_posterior(), refinement.shared_voxels(),
               refinement.shared_measurements(), refinement.config(),
               map_change(session_->map().voxels(), refinement.voxels())});
}

void SessionRunner::show_next_view(SessionSnapshot& snapshot) const {
  snapshot.next_candidate = session_->next_candidate();
  snapshot.next_view = session_->next_view();
  snapshot.own_next_view = std::holds_alternative<Pose>(next_);
  snapshot.explanation = nullptr;
  if (!snapshot.finished.empty() || (!snapshot.next_candidate && !snapshot.own_next_view)) return;
  if (auto explanation = session_->explain(snapshot.next_view))
    snapshot.explanation = std::make_shared<const ScoreExplanation>(std::move(*explanation));
}

}  // namespace nextview
