#include "core/session/session.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "core/memory/available_memory.hpp"
#include "core/planner/look_ahead_planner.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/session_parts.hpp"

namespace nextview {

Session::Session(Configuration configuration, const Progress& progress, std::stop_token stop)
    : Session(std::move(configuration), SessionParts{}, progress, std::move(stop)) {}

Session::Session(Configuration configuration, SessionParts parts, const Progress& progress, std::stop_token stop) {
  Configuration& c = setup_.configuration = validated(std::move(configuration));
  source_ = std::move(parts.source);
  std::shared_ptr<const SimulatedWorld> world;
  if (!source_ || c.evaluation.enabled)
    world = make_world(stop);
  else
    c = affordable(std::move(c));
  if (!source_) source_ = std::make_unique<SimulatedSource>(world, c.seed);
  setup_.source = source_->describe();
  setup_.region = configured_region(c, setup_.source);
  setup_.bundle = scoring_rays(c, setup_.source.camera);
  robot_ = std::move(parts.robot);
  setup_.start = start_view(c, setup_.source, robot_.get());
  if (!robot_) robot_ = std::make_unique<FreeFlyingCamera>(setup_.start.T_world_camera);
  setup_.planner = std::move(parts.planner);
  if (!setup_.planner) setup_.planner = make_planner(c.planner);
  setup_.candidates = std::move(parts.candidates);
  if (!setup_.candidates) setup_.candidates = configured_candidates(c, setup_.source);
  if (c.evaluation.enabled)
    setup_.truth =
        std::make_shared<KnownObject>(object_->surroundings(), evaluation_samples(c, object_->mesh),
                                      std::shared_ptr<const MeshRayCaster>(world, &world->scene), world->camera,
                                      poses_of(setup_.candidates->candidates(nothing_known(c, setup_.region, {}))),
                                      setup_.region, c.evaluation.d_reg, progress, stop);
  if (setup_.truth && (c.evaluation.any_pose || c.views.layout == ViewLayout::adaptive))
    setup_.any_pose = setup_.truth->seen_from_any_pose(progress, stop);
  adopt(nothing_scanned(setup_, robot_->pose()));
}

std::shared_ptr<const SimulatedWorld> Session::make_world(const std::stop_token& stop) {
  ConfiguredObject object = load_object(setup_.configuration, stop);
  object_file_ = std::move(object.file);
  object_ = std::move(object.placed);
  return std::make_shared<const SimulatedWorld>(object_, setup_.configuration.sensor, stop);
}

std::shared_ptr<const TriangleMesh> Session::mesh() const {
  return object_ ? std::shared_ptr<const TriangleMesh>(object_, &object_->mesh) : nullptr;
}

/// One turn of Algorithm 2. Whatever ends it early, the state is as it was.
bool Session::step(const Progress& progress, std::stop_token stop, const Accept& accept) {
  if (!finished().empty()) throw std::logic_error("the scan is finished: " + finished());
  std::optional<ScanState> after;
  try {
    after = next_state(progress, stop, accept);
  } catch (const Stopped&) {
  } catch (const std::bad_alloc&) {
    robot_->restored(state_.T_world_camera);
    throw OutOfMemory(not_enough_memory(configuration()));
  } catch (...) {
    robot_->restored(state_.T_world_camera);
    throw;
  }
  if (!after) {
    robot_->restored(state_.T_world_camera);
    return false;
  }
  adopt(*std::move(after));
  if (progress) progress(1.0, "done");
  return true;
}

/// None if it was cancelled or refused.
std::optional<ScanState> Session::next_state(const Progress& progress, const std::stop_token& stop,
                                             const Accept& accept) {
  const auto step = static_cast<std::uint32_t>(state_.scans.size() + 1);
  const Result<Acquired> result = acquire(state_.next.view, step, *source_, *robot_, progress, stop);
  if (const auto* failure = std::get_if<Failure>(&result)) {
    if (failure->kind == Failure::cancelled) return std::nullopt;
    throw std::runtime_error(failure->reason);
  }
  const Acquired& acquired = std::get<Acquired>(result);
  if (accept && !accept(acquired)) return std::nullopt;
  return plan(setup_, absorb(setup_, state_, acquired, progress, stop), *robot_, progress, stop);
}

void Session::restore(ScanState state) {
  robot_->restored(state.T_world_camera);
  adopt(std::move(state));
}

void Session::adopt(ScanState state) {
  std::vector<StepRecord> records;
  for (const auto& record : state.records) records.push_back(*record);
  candidates_ = poses_of(state.candidates);
  records_ = std::move(records);
  state_ = std::move(state);
}

std::string Session::unreachable(const View& view) const {
  return robot_->reach(robot_->pose(), {&view, 1}).at(0).unreachable;
}

void Session::override_next_view(std::size_t candidate) {
  const bool known = candidate < candidates().size();
  const View view = known ? state_.candidates[candidate] : View{};
  if (!known || state_.known.has_taken(view) || !unreachable(view).empty())
    throw std::invalid_argument(fmt::format("candidate view {} is not available", candidate));
  require_first_step();
  const StepRecord& last = records_.back();
  const Candidate& c = last.candidates[candidate];
  state_.next = {view, candidate, false, last.ranking.best != candidate, c.gain, c.utility};
}

void Session::override_next_view(const Pose& T_world_camera) {
  if (!is_rigid(T_world_camera))
    throw std::invalid_argument("a view must be a finite position and a rotation, without scale or reflection");
  if (const std::string reason = unreachable({T_world_camera}); !reason.empty())
    throw std::invalid_argument("the robot cannot reach the view: " + reason);
  require_first_step();
  const Pose pose = make_pose(T_world_camera.translation(), Eigen::Quaterniond(T_world_camera.linear()));
  const auto expected = explain(pose);
  state_.next = {{pose}, std::nullopt, true, true, expected ? expected->value : 0.0, 0.0};
}

void Session::take_proposal() {
  if (!records_.empty()) state_.next = proposal(setup_, state_);
}

void Session::set_termination(const TerminationConfig& config) {
  config.validate();
  setup_.configuration.termination = config;
  if (!records_.empty()) state_.finished = termination(config, state_);
}

void Session::require_first_step() const {
  if (records_.empty())
    throw std::invalid_argument("the first view is the start view; step once before choosing another");
}

std::optional<ScoreExplanation> Session::explain(const Pose& T_world_camera) const {
  return nextview::explain(setup_, state_, T_world_camera);
}

}  // namespace nextview
