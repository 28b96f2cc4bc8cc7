#include "core/session/session.hpp"

#include <fmt/format.h>

#include <chrono>
#include <numbers>
#include <stdexcept>

#include "core/evaluation/entropy.hpp"
#include "core/memory/available_memory.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/session_parts.hpp"
#include "core/session/view_planning.hpp"
#include "core/session/visited_voxels.hpp"

namespace nextview {
namespace {

/// Adds the seconds until its end to a stage.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::size_t measured_voxels(const OccupancyMap& map) {
  std::size_t count = 0;
  for (const Voxel& v : map.voxels()) count += v.measured;
  return count;
}

}  // namespace

Session::Session(Configuration configuration, const Progress& progress, std::stop_token stop)
    : configuration_(affordable(validated(std::move(configuration)))),
      object_file_(resolve_object(configuration_)),
      object_(std::make_shared<PlacedMesh>(load_placed_mesh(object_file_, {configuration_.object.longest_side}, stop))),
      scene_(object_->mesh, stop),
      camera_(configuration_.sensor, stop),
      candidates_(candidate_views(configuration_.views, Vector3::Zero())),
      start_view_(configured_start_view(configuration_)),
      map_(configured_region(configuration_), configuration_.map.model),
      refinement_(make_refinement(configuration_)),
      map_rays_(configured_rays(configuration_, map_.grid(), map_.voxels())),
      planning_rays_(configured_rays(configuration_, map_.grid(), planning_voxels())),
      reference_map_(make_reference_map(configuration_)),
      bundle_(scoring_rays(configuration_, camera_.camera())),
      policy_(make_policy(configuration_.planner)),
      robot_(std::make_unique<FreeFlyingCamera>(start_view_)),
      visited_(candidates_.size()),
      visited_voxels_(map_.grid().voxel_count()) {
  require_within_region(object_->mesh, configuration_, object_file_);
  const EvaluationConfig& e = configuration_.evaluation;
  if (e.enabled)
    known_object_ = std::make_unique<KnownObject>(object_->mesh, scene_, camera_, candidates_, map_.grid(),
                                                  e.surface_samples, e.d_reg, configuration_.seed, progress, stop);
}

/// One turn of Algorithm 2. Whatever ends it early, the session is as it was.
bool Session::step(const Progress& progress, std::stop_token stop) {
  if (!finished_.empty()) throw std::logic_error("the scan is finished: " + finished_);
  StepRecord record = begin_step();
  std::shared_ptr<const Scan> scan;
  Before before = remember();
  try {
    take(record, before, scan, progress, stop);
    scans_.reserve(scans_.size() + 1);  // so that nothing fails from here on
    records_.reserve(records_.size() + 1);
  } catch (const Stopped&) {
    go_back(before);
    return false;
  } catch (const std::bad_alloc&) {
    go_back(before);
    throw OutOfMemory(not_enough_memory(configuration_));
  } catch (...) {
    go_back(before);
    throw;
  }
  next_ = record.ranking.best;  // p <- next best view
  own_view_.reset();
  overridden_ = false;
  scans_.push_back(std::move(scan));
  records_.push_back(std::move(record));
  // If p meets the terminal criterion, finish.
  finished_ = termination(configuration_.termination, records_, map_.voxels().size());
  if (progress) progress(1.0, "done");
  return true;
}

StepRecord Session::begin_step() const {
  StepRecord record;
  record.step = static_cast<int>(records_.size()) + 1;
  record.view = next_ ? static_cast<int>(*next_) : -1;
  record.overridden = overridden_;
  record.T_world_camera = next_view();
  record.motion = robot_->cost(robot_->pose(), record.T_world_camera);
  if (next_) {
    record.gain = records_.back().candidates[*next_].gain;
    record.utility = records_.back().candidates[*next_].utility;
  } else if (own_view_) {
    record.gain = own_gain_;
  }
  return record;
}

void Session::take(StepRecord& record, Before& before, std::shared_ptr<const Scan>& scan, const Progress& progress,
                   const std::stop_token& stop) {
  const auto tell = [&](double fraction, std::string_view what) {
    if (progress) progress(fraction, what);
    throw_if_stopped(stop);
  };
  tell(0.0, "taking the view");
  robot_->move_to(record.T_world_camera);  // robot manipulation to view p
  const Measurement measurement = measure(record.T_world_camera, record, progress, stop);  // z <- scan measurement
  tell(0.4, "updating the map");
  update_map(measurement, record, before.map, stop);  // M <- update octree map M by measurement z
  if (next_) visited_[*next_] = true;                 // delete v_i
  taken_.push_back(record.T_world_camera);
  refine_map(measurement, record, progress, stop);
  tell(0.6, "comparing with the object");
  evaluate(measurement, record, stop);
  tell(0.7, "scoring the candidate views");
  rank(record, stop);  // ray casting (M, v_i) for all candidates left
  scan = measurement.scan;
}

Session::Before Session::remember() const {
  return {robot_->pose(),
          {},
          refinement_ ? std::make_unique<MapRefinement>(*refinement_) : nullptr,
          reference_map_ ? reference_map_->copy() : nullptr,
          visited_,
          visited_voxels_,
          known_object_ ? known_object_->seen() : KnownObject::Seen{}};
}

void Session::go_back(const Before& before) {
  robot_->move_to(before.T_world_camera);
  map_.go_back(before.map);
  if (refinement_) refinement_->go_back(*before.refinement);
  if (reference_map_) reference_map_->swap(*before.reference_map);
  visited_ = before.visited;
  visited_voxels_ = before.visited_voxels;
  if (known_object_) known_object_->go_back(before.seen);
  taken_.resize(records_.size());
}

Session::Measurement Session::measure(const Pose& T_world_camera, StepRecord& record, const Progress& progress,
                                      const std::stop_token& stop) const {
  Measurement measurement;
  DepthImage image;
  {
    Stopwatch watch(record.seconds.sense);
    image = camera_.sense(scene_, T_world_camera, configuration_.seed, static_cast<std::uint32_t>(record.step), stop);
  }
  if (progress) progress(0.1, "cleaning the cloud");
  {
    Stopwatch watch(record.seconds.clean);
    auto scan = std::make_shared<Scan>(back_project(image, T_world_camera, configuration_.sensor.max_range, stop));
    record.returns = scan->returns.size();
    record.passes = scan->passes.size();
    scan->returns = clean(scan->returns, configuration_.cloud, stop);
    record.points = scan->returns.size();
    measurement.scan = std::move(scan);
  }
  if (known_object_) {
    Stopwatch watch(record.seconds.evaluate);
    measurement.ideal_image = camera_.sense_ideal(scene_, T_world_camera, stop);
  }
  return measurement;
}

void Session::update_map(const Measurement& measurement, StepRecord& record, MapChanges& undo,
                         const std::stop_token& stop) {
  const Scan& scan = *measurement.scan;
  const double max_range = configuration_.sensor.max_range;
  const std::size_t measured_before = measured_voxels(map_);
  {
    Stopwatch watch(record.seconds.insert);
    if (configuration_.map.insertion == Insertion::local_octree) {
      OccupancyMap local(map_.grid(), map_.model());
      local.insert(scan, max_range, stop);
      map_.register_local(local, scan.origin, &undo);
    } else {
      map_.insert(scan, max_range, stop, &undo);
    }
    if (policy_->needs().occlusions)
      map_.mark_occlusions(scan, max_range, 0.5 * occlusion_reach(configuration_) * configuration_.map.resolution, stop,
                           &undo);
    if (reference_map_) reference_map_->insert(scan.origin, scan.returns, stop);
  }
  Stopwatch watch(record.seconds.evaluate);
  record.new_voxels = measured_voxels(map_) - measured_before;
  record.entropy = unmeasured_entropy(map_.voxels());
}

void Session::refine_map(const Measurement& measurement, StepRecord& record, const Progress& progress,
                         const std::stop_token& stop) {
  const double untouched = static_cast<double>(map_.voxels().size());  // a bit a voxel
  const double entropy_before = records_.empty() ? untouched : records_.back().total_entropy;
  if (refinement_) {
    Stopwatch watch(record.seconds.refine);
    refinement_->add(*measurement.scan);
    const auto tell = [&](double fraction, std::string_view what, const SamplerDiagnostics&) {
      if (progress) progress(0.5 + 0.1 * fraction, what);
    };
    refinement_->refine(probabilities(map_.voxels()), configuration_.gibbs.view_sweeps, tell, stop);
    throw_if_stopped(stop);
    record.refinement.emplace();
    record.refinement->diagnostics = refinement_->posterior().diagnostics;
    for (std::size_t v = 0; v < map_.voxels().size(); ++v)
      record.refinement->changed_class += map_.voxels()[v].voxel_class != refinement_->voxels()[v].voxel_class;
  }
  Stopwatch watch(record.seconds.evaluate);
  record.total_entropy = total_entropy(planning_voxels());
  record.realised_gain =
      (entropy_before - record.total_entropy) * std::numbers::ln2;  // Eq. 12: other voxels keep theirs
}

void Session::evaluate(const Measurement& measurement, StepRecord& record, const std::stop_token& stop) {
  if (!known_object_) return;
  Stopwatch watch(record.seconds.evaluate);
  const Scan ideal =
      back_project(measurement.ideal_image, record.T_world_camera, configuration_.sensor.max_range, stop);
  mark_visited(map_.grid(), ideal, visited_voxels_, stop);
  known_object_->add_view(record.T_world_camera, measurement.scan->returns, stop);
  record.coverage = known_object_->coverage().of_all();
  record.coverage_visible = known_object_->coverage().of_visible();
  record.coverage_paper = known_object_->coverage_paper().of_all();
  const auto p = probabilities(map_.voxels());
  const GroundTruth& truth = known_object_->truth();
  record.quality = map_quality(p, truth, TruthConvention::touch, ScoredSet::visited, visited_voxels_);
  record.quality_near_surface = map_quality(p, truth, TruthConvention::touch, ScoredSet::visited_band, visited_voxels_);
  if (record.refinement)
    record.refinement->quality_near_surface = map_quality(
        probabilities(refinement_->voxels()), truth, TruthConvention::touch, ScoredSet::visited_band, visited_voxels_);
}

void Session::rank(StepRecord& record, const std::stop_token& stop) const {
  Stopwatch watch(record.seconds.score);
  rank_candidates(*policy_, planning_state(caster()), *robot_, visited_, record, stop);
  if (record.refinement) compare_rankings(*policy_, planning_state(map_rays_), record, stop);
}

void Session::override_next_view(std::size_t candidate) {
  const bool known = candidate < candidates_.size();
  if (!known || visited_[candidate] || robot_->unreachable(candidates_[candidate]))
    throw std::invalid_argument(fmt::format("candidate view {} is not available", candidate));
  require_first_step();
  overridden_ = records_.back().ranking.best != candidate;
  next_ = candidate;
  own_view_.reset();
}

void Session::override_next_view(const Pose& T_world_camera) {
  if (!is_rigid(T_world_camera))
    throw std::invalid_argument("a view must be a finite position and a rotation, without scale or reflection");
  if (const auto reason = robot_->unreachable(T_world_camera))
    throw std::invalid_argument("the robot cannot reach the view: " + *reason);
  require_first_step();
  own_view_ = make_pose(T_world_camera.translation(), Eigen::Quaterniond(T_world_camera.linear()));
  const auto expected = explain(*own_view_);
  own_gain_ = expected ? expected->value : 0.0;
  overridden_ = true;
  next_.reset();
}

void Session::set_termination(const TerminationConfig& config) {
  config.validate();
  configuration_.termination = config;
  if (!records_.empty()) finished_ = termination(config, records_, map_.voxels().size());
}

void Session::require_first_step() const {
  if (records_.empty())
    throw std::invalid_argument("the first view is the start view; step once before choosing another");
}

Pose Session::next_view() const { return own_view_ ? *own_view_ : next_ ? candidates_[*next_] : start_view_; }

PlanningState Session::planning_state(const RayCaster& rays) const {
  return {configuration_.planner,
          configuration_.seed,
          occlusion_reach(configuration_),
          rays,
          bundle_,
          known_object_.get(),
          candidates_,
          taken_};
}

const RayCaster& Session::caster() const {
  if (reference_map_) return *reference_map_;
  return planning_rays_;
}

std::optional<ScoreExplanation> Session::explain(std::size_t candidate) const {
  return explain(candidates_.at(candidate));
}

std::optional<ScoreExplanation> Session::explain(const Pose& T_world_camera) const {
  return nextview::explain(*policy_, planning_state(caster()), T_world_camera);
}

}  // namespace nextview
