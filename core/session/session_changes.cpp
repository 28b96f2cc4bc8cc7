// What of a session changes without a view being taken: where it stands, what comes next, what ranks and what ends it.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "core/planner/look_ahead_planner.hpp"
#include "core/planner/policy.hpp"
#include "core/session/session.hpp"
#include "core/session/session_parts.hpp"

namespace nextview {

void Session::restore(ScanState state) {
  taken_.reset();
  robot_->restored(state.T_world_camera);
  adopt(std::move(state));
}

void Session::restore(ScanState state, const PlanningConfig& planning) {
  setup_ = setup_with(planning);
  restore(std::move(state));
}

ScanSetup Session::setup_with(const PlanningConfig& config, const std::stop_token& stop) const {
  ScanSetup setup = setup_;
  Configuration wanted = with_planning(configuration(), config);
  wanted.views.projections = configuration().views.projections;
  setup.configuration = validated(std::move(wanted));
  if (to_toml(setup.configuration) == to_toml(configuration())) return setup_;  // also with a planner of its own
  setup.planner = make_planner(config.planner);
  choose_rays(setup);
  if (views_as_configured_ && !recording_) follow_views(setup, stop);
  if (robot_as_configured_ && !recording_) setup.start = start_view(setup.configuration, setup.source, nullptr);
  return setup;
}

/// The candidates of its configuration, and what each sees of the true surface, for a planner that may know.
void Session::follow_views(ScanSetup& setup, const std::stop_token& stop) const {
  const Configuration& c = setup.configuration;
  if (c.views.layout == ViewLayout::adaptive || !same_settings(c.views, configuration().views))
    setup.candidates = configured_candidates(c, setup.source);
  if (!setup.truth || !policy_entry(c.planner.gain).baseline) return;
  const auto poses = poses_of(setup.candidates->candidates(nothing_known(c, setup.region, {})));
  const auto same = [](const Pose& a, const Pose& b) { return a.matrix() == b.matrix(); };
  if (setup.sight && std::ranges::equal(poses, setup.sight->candidates, same)) return;
  const bool as_it_began = std::ranges::equal(poses, setup.truth->candidates(), same);
  setup.sight = as_it_began ? nullptr : std::make_shared<const CandidateSight>(setup.truth->sight_of(poses, {}, stop));
}

void Session::set_planning(const PlanningConfig& config, const Progress& progress, const std::stop_token& stop) {
  ScanSetup setup = setup_with(config, stop);
  if (setup.planner == setup_.planner) return;
  ScanState state = state_;
  const PolicyNeeds before = setup_.planner->needs(), now = setup.planner->needs();
  const bool refines_otherwise = now.posterior && !same_settings(configuration().gibbs, config.gibbs);
  if (state.records.empty()) {
    if (robot_as_configured_) robot_->restored(setup.start.T_world_camera);
    state = nothing_scanned(setup, robot_->pose());
  } else if (before.occlusions != now.occlusions || before.posterior != now.posterior || refines_otherwise ||
             configuration().planner.semantics != config.planner.semantics) {
    ScanState nothing = nothing_scanned(setup, state.T_world_camera);
    const auto posterior = refines_otherwise ? nullptr : state.known.posterior;
    if (posterior) nothing.known.posterior = nullptr;  // it is of the scans alone, and takes the longest
    remake(setup, state, nothing, progress, stop);
    if (now.posterior && posterior) state.known.posterior = posterior;
  }
  if (!state.records.empty()) {
    // A scanner that is not connected cannot be asked again.
    const bool is_absent = robot_as_configured_ && !configuration().driver.name.empty();
    const bool knows = is_absent && same_settings(config.views, configuration().views);
    const std::vector<Reach> reach = knows ? reach_of(*state.records.back()) : std::vector<Reach>();
    state = plan(setup, std::move(state), *robot_, reach, progress, stop);
  }
  setup_ = std::move(setup);
  adopt(std::move(state));
}

/// Only records that are new are copied: they hold all their candidates, 1,000 of a recording of so many frames.
void Session::adopt(ScanState state) {
  const auto first_new = std::ranges::mismatch(state.records, state_.records).in1;
  std::vector<StepRecord> added;
  for (auto record = first_new; record != state.records.end(); ++record) added.push_back(**record);
  std::vector<Pose> candidates = poses_of(state.candidates);
  if (state.records.size() > records_.capacity()) records_.reserve(2 * state.records.size());
  // From here on nothing fails: a step is taken as a whole, or not at all.
  records_.resize(state.records.size() - added.size());
  std::ranges::move(added, std::back_inserter(records_));
  candidates_ = std::move(candidates);
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
  state_.next = {view, candidate, false, last.ranking.best != candidate, c.gain, c.utility, last.ranking.gain_unit};
}

void Session::override_next_view(const Pose& T_world_camera) {
  if (!is_pose(T_world_camera))
    throw std::invalid_argument(
        "a view must be a position that is not too far off and a rotation, without scale or reflection");
  if (recording_)
    throw std::invalid_argument("a recording has no views but those that were taken; choose one of its frames");
  if (const std::string reason = unreachable({T_world_camera}); !reason.empty())
    throw std::invalid_argument("the robot cannot reach the view: " + reason);
  require_first_step();
  const Pose pose = make_pose(T_world_camera.translation(), Eigen::Quaterniond(T_world_camera.linear()));
  const auto expected = explain(pose);
  state_.next = {{pose}, std::nullopt, true, true, expected ? expected->value : 0.0, 0.0, setup_.planner->unit()};
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
