#include "core/session/scan_loop.hpp"

#include <cmath>
#include <numbers>

#include "core/cloud/smoothed_points.hpp"
#include "core/evaluation/entropy.hpp"
#include "core/planner/new_surface_policy.hpp"
#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"
#include "core/progress/stopwatch.hpp"
#include "core/session/session_parts.hpp"
#include "core/session/start_map.hpp"

namespace nextview {
namespace {

/// Says how far a step has come, and ends it where a stop is requested.
void report(const Progress& progress, const std::stop_token& stop, double fraction, std::string_view what) {
  if (progress) progress(fraction, what);
  throw_if_stopped(stop);
}

FusionConfig fusion(const ScanSetup& setup) {
  const Configuration& c = setup.configuration;
  return {c.map.insertion, setup.planner->needs().occlusions ? occlusion_distance(c) : 0.0, c.gibbs.view_sweeps};
}

/// Of a capture: a camera that is turned shifts what it looks at.
RegistrationLimits limits_of(const ScanSetup& setup, const Pose& T_world_camera) {
  const Configuration& c = setup.configuration;
  const double distance = (T_world_camera.translation() - setup.region.box().center()).norm();
  const double turn = c.robot.rotation_error * std::numbers::pi / 180.0;
  const PoseErrors known{std::sqrt(3.0) * c.robot.position_error + turn * distance, c.robot.rotation_error};
  return registration_limits(c.registration, setup.source.range_noise, c.map.resolution, known);
}

std::shared_ptr<const CapturedScan> cleaned(const ScanSetup& setup, const Capture& capture, double& seconds,
                                            const std::stop_token& stop) {
  const Stopwatch watch(seconds);
  return std::make_shared<const CapturedScan>(to_scan(capture, &setup.configuration.cloud, stop));
}

/// What the view did to the maps, as numbers of its record.
void compare_maps(const Knowledge& before, const Knowledge& after, StepRecord& record) {
  Stopwatch watch(record.seconds.evaluate);
  const MapChange change = map_change(before.map.voxels(), after.map.voxels());
  const MapEntropy entropy = map_entropy(after.map.voxels());
  record.new_voxels = change.newly_measured;
  record.realised_gain = change.realised_gain;
  record.entropy = entropy.unmeasured;
  record.total_entropy = entropy.total;
  if (!after.posterior) return;
  record.realised_gain = map_change(before.planning_voxels(), after.planning_voxels()).realised_gain;
  record.total_entropy = map_entropy(after.planning_voxels()).total;
  record.refinement.emplace();
  record.refinement->diagnostics = after.posterior->posterior().diagnostics;
  record.refinement->changed_class = differing_classes(after.map.voxels(), after.posterior->voxels());
}

void evaluate(const ScanSetup& setup, ScanState& state, const Scan& scan, StepRecord& record,
              const std::stop_token& stop) {
  if (!setup.truth) return;
  Stopwatch watch(record.seconds.evaluate);
  auto evaluation = std::make_shared<EvaluationState>(*state.evaluation);
  setup.truth->add_view(*evaluation, record.T_world_camera, scan.hits, stop);
  record.coverage = evaluation->coverage.of_all();
  record.coverage_visible = evaluation->coverage.of(setup.truth->visible(stop));
  if (!setup.any_pose.empty()) record.coverage_any_pose = evaluation->coverage.of(setup.any_pose);
  record.coverage_paper = evaluation->coverage_paper.of_all();
  const GroundTruth& truth = setup.truth->truth();
  const auto quality = [&](const VoxelBricks& voxels, std::initializer_list<ScoredSet> sets) {
    return map_quality(voxels, truth, TruthConvention::touch, sets, evaluation->visited_voxels);
  };
  const auto qualities = quality(state.known.map.voxels(), {ScoredSet::visited, ScoredSet::visited_band});
  record.quality = qualities[0];
  record.quality_near_surface = qualities[1];
  if (record.refinement)
    record.refinement->quality_near_surface =
        quality(state.known.posterior->voxels(), {ScoredSet::visited_band}).front();
  state.evaluation = std::move(evaluation);
}

/// Noise makes points of one surface lie apart: by that much more they are told from others', up to so many d_reg.
/// Where that is more than d_reg, scans are smoothed before they are compared, so that their borders stay sharp, too.
/// With 5 mm of noise views show most nearly what they promise with 1.6.
constexpr double standard_deviations = 3.0, most_registration_distances = 1.6;

/// By how much points of one surface are told from another's [m].
double told_apart(const ScanSetup& setup) {
  const double d_reg = setup.configuration.evaluation.d_reg, noise = setup.source.range_noise;
  const double smoothed = std::max(most_registration_distances * d_reg, Smoothing::least(noise));
  return std::clamp(standard_deviations * noise, d_reg, smoothed);
}

/// What the scan of a step shows for the first time [cm^2].
double see_surface(const ScanSetup& setup, Knowledge& known, const Scan& scan, const StepRecord& record) {
  const PinholeCamera& camera = setup.source.camera;
  // Cleaning leaves some out: the others stand for all.
  const double pixels_per_point = double(record.hits) / double(std::max<std::size_t>(1, record.points));
  const double solid_angle = pixels_per_point / (camera.fx * camera.fy), noise = setup.source.range_noise;
  auto scanned = std::make_shared<ScannedSurface>(*known.scanned);
  const Vector3 optical_axis = record.T_world_camera.linear().col(2);
  const bool is_smoothed = standard_deviations * noise > setup.configuration.evaluation.d_reg;
  const auto smoothing = Smoothing::down_to(scanned->radius(), noise, solid_angle);
  const double across =
      is_smoothed
          ? scanned->add({scan.origin, smoothed_points(scan, record.T_world_camera, smoothing), {}, scan.max_range},
                         optical_axis, solid_angle)
          : scanned->add(scan, optical_axis, solid_angle);
  known.scanned = std::move(scanned);
  return setup.configuration.planner.new_surface.square_centimetres(across);
}

/// The record of the view that was to be taken, as it was.
StepRecord begin_record(const ScanState& state, const Acquired& acquired) {
  StepRecord record;
  record.step = static_cast<int>(state.records.size()) + 1;
  if (acquired.wanted.frame) record.view = static_cast<int>(*acquired.wanted.frame);
  const NextView& next = state.next;
  if (next.view == acquired.wanted) {
    if (next.candidate) record.view = static_cast<int>(*next.candidate);
    record.overridden = next.overridden;
    record.gain = next.gain;
    record.gain_unit = next.gain_unit;
    record.utility = next.utility;
  }
  record.T_world_camera = acquired.capture.T_world_camera;
  record.motion = acquired.motion;
  record.registration = acquired.registration;
  record.seconds.sense = acquired.sense_seconds;
  record.seconds.clean = acquired.clean_seconds;
  return record;
}

}  // namespace

Result<Acquired> acquire(const View& view, std::uint32_t step, ScanSource& source, Robot& robot,
                         const Progress& progress, const std::stop_token& stop) {
  if (progress) progress(0.0, "taking the view");
  Acquired acquired;
  acquired.wanted = view;
  acquired.motion = robot.reach(robot.pose(), {&view, 1}).front().cost;
  const Result<Pose> reached = robot.move_to(view, stop);
  if (const auto* failure = std::get_if<Failure>(&reached)) return *failure;
  acquired.reached = std::get<Pose>(reached);
  Result<Capture> capture = [&] {
    Stopwatch watch(acquired.sense_seconds);
    return source.capture({acquired.reached, view.frame}, step, stop);
  }();
  if (auto* failure = std::get_if<Failure>(&capture)) return *failure;
  acquired.capture = std::get<Capture>(std::move(capture));
  acquired.believed = acquired.capture.T_world_camera;
  return acquired;
}

void register_capture(const ScanSetup& setup, const ScanState& state, RegistrationTarget& target, Acquired& acquired,
                      const std::stop_token& stop) {
  const Configuration& c = setup.configuration;
  if (c.registration.mode == RegistrationConfig::Mode::off || state.scans.empty()) return;
  const RegistrationLimits limits = limits_of(setup, acquired.capture.T_world_camera);
  acquired.cleaned = cleaned(setup, acquired.capture, acquired.clean_seconds, stop);
  acquired.registration = register_scan(acquired.cleaned->scan, state.scans, limits, target, stop);
}

std::string beyond_limits(const ScanSetup& setup, const Acquired& acquired) {
  if (!acquired.registration) return "";
  return beyond_limits(*acquired.registration, limits_of(setup, acquired.capture.T_world_camera));
}

void correct(Acquired& acquired) {
  if (!acquired.registration || !acquired.registration->reliable) return;
  acquired.capture.T_world_camera = acquired.registration->T_corrected_believed * acquired.capture.T_world_camera;
  acquired.cleaned = nullptr;  // where it stood before
}

ScanState absorb(const ScanSetup& setup, const ScanState& state, const Acquired& acquired, const Progress& progress,
                 const std::stop_token& stop) {
  StepRecord record = begin_record(state, acquired);
  ScanState after = state;
  report(progress, stop, 0.1, "cleaning the cloud");
  const auto captured =
      acquired.cleaned ? acquired.cleaned : cleaned(setup, acquired.capture, record.seconds.clean, stop);
  record.hits = captured->hits;
  record.misses = captured->scan.misses.size();
  record.points = captured->scan.hits.size();
  const std::shared_ptr<const Scan> scan(captured, &captured->scan);

  report(progress, stop, 0.4, "updating the map");
  const FusionSeconds seconds = fuse(after.known, *scan, fusion(setup), part(progress, 0.5, 0.6), stop);
  record.seconds.insert = seconds.insert;
  record.seconds.refine = seconds.refine;
  {
    Stopwatch watch(record.seconds.insert);
    record.new_surface = see_surface(setup, after.known, *scan, record);
  }
  after.known.taken.push_back({acquired.wanted, record.T_world_camera,
                               record.gain_unit == NewSurfacePolicy::surface_unit ? record.gain : 0.0,
                               record.new_surface});
  compare_maps(state.known, after.known, record);
  report(progress, stop, 0.6, "comparing with the object");
  evaluate(setup, after, *scan, record, stop);
  if (setup.recorded) record.coverage_recorded = setup.recorded->covered_by(frames_taken(after.known));
  after.T_world_camera = acquired.reached;
  after.scans.push_back(scan);
  after.records.push_back(std::make_shared<const StepRecord>(std::move(record)));
  return after;
}

std::size_t bytes_of(const ScanState& state, const ScanState* other) {
  if (!state.has_maps) return 0;
  const Knowledge& known = state.known;
  const Knowledge* const beside = other ? &other->known : nullptr;
  std::size_t bytes = beside ? known.map.voxels().bytes_beside(beside->map.voxels()) : known.map.voxels().bytes();
  if (known.posterior) bytes += known.posterior->bytes(beside ? beside->posterior.get() : nullptr);
  if (known.scanned && !(beside && beside->scanned == known.scanned)) bytes += known.scanned->bytes();
  if (state.evaluation && !(other && other->evaluation == state.evaluation)) bytes += state.evaluation->bytes();
  return bytes;
}

void drop_maps(const ScanSetup& setup, ScanState& state) {
  std::vector<TakenView> taken = std::move(state.known.taken);
  ScanState nothing = nothing_scanned(setup, state.T_world_camera);
  state.known = std::move(nothing.known);
  state.known.taken = std::move(taken);
  state.evaluation = std::move(nothing.evaluation);
  state.has_maps = false;
}

void remake(const ScanSetup& setup, ScanState& state, const ScanState& from, const Progress& progress,
            const std::stop_token& stop) {
  Knowledge known = from.known;
  auto evaluation = from.evaluation ? std::make_shared<EvaluationState>(*from.evaluation) : nullptr;
  for (std::size_t k = from.scans.size(); k < state.scans.size(); ++k) {
    report(progress, stop, double(k) / double(state.scans.size()), "making the map again");
    fuse(known, *state.scans[k], fusion(setup), {}, stop);
    see_surface(setup, known, *state.scans[k], *state.records[k]);
    if (evaluation) setup.truth->add_view(*evaluation, state.records[k]->T_world_camera, state.scans[k]->hits, stop);
  }
  known.taken = state.known.taken;
  state.known = std::move(known);
  state.evaluation = std::move(evaluation);
  state.has_maps = true;
}

ScanState nothing_scanned(const ScanSetup& setup, const Pose& T_world_camera) {
  ScanState state;
  state.known = nothing_known(setup.configuration, setup.region, setup.planner->needs());
  if (setup.start_map) begin_with(*setup.start_map, state.known.map);
  state.known.scanned = std::make_shared<const ScannedSurface>(told_apart(setup));
  if (setup.truth) state.evaluation = std::make_shared<const EvaluationState>(setup.truth->nothing_seen());
  state.candidates = setup.candidates->candidates(state.known);
  state.next.view = setup.start;
  state.T_world_camera = T_world_camera;
  return state;
}

}  // namespace nextview
