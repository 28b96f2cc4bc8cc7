#pragma once
#include <stop_token>

#include "core/progress/progress.hpp"
#include "core/session/scan_state.hpp"

namespace nextview {

// Algorithm 2, in three parts. The first touches the world; the second is a pure function of what it brought; the third
// asks the robot where it could go from here. Progress goes from 0 to 1 over all three.

/// Moves the robot to the view and takes a scan there. The pose that counts is the one that was reached.
Result<Acquired> acquire(const View& view, std::uint32_t step, ScanSource& source, Robot& robot,
                         const Progress& progress, const std::stop_token& stop);

/// Compares a capture with the scans before it, if that is asked for (registration.mode); the target is that of the
/// captures before. @throws Stopped
void register_capture(const ScanSetup& setup, const ScanState& state, RegistrationTarget& target, Acquired& acquired,
                      const std::stop_token& stop);
/// In what way it lies farther off than the limits allow, in one line; empty if it does not.
std::string beyond_limits(const ScanSetup& setup, const Acquired& acquired);
/// Takes it to stand where its registration puts it, if that is reliable.
void correct(Acquired& acquired);

/// The state after a view: its scan is cleaned and fused into the maps, and compared with the true object.
/// @throws Stopped; OutOfMemory
ScanState absorb(const ScanSetup& setup, const ScanState& state, const Acquired& acquired, const Progress& progress,
                 const std::stop_token& stop);

/// The rays that score views, by the setup's configuration and its source's camera.
void choose_rays(ScanSetup& setup);
/// The state with the candidates ranked from where the robot is, the next view, and whether the scan is done. `reach`:
/// what the robot said of these candidates; else it is asked. @throws Stopped @pre !state.records.empty()
ScanState plan(const ScanSetup& setup, ScanState state, Robot& robot, std::span<const Reach> reach,
               const Progress& progress, const std::stop_token& stop);
/// What the robot said of the candidates that were ranked after a view.
std::vector<Reach> reach_of(const StepRecord& record);

/// The view that the planner wants next. @pre !state.records.empty(), ranked
NextView proposal(const ScanSetup& setup, const ScanState& state);

/// The state before the first view.
ScanState nothing_scanned(const ScanSetup& setup, const Pose& T_world_camera);

/// What a state's maps and evaluation take that another of the same scan, if given, does not share [bytes].
std::size_t bytes_of(const ScanState& state, const ScanState* other = nullptr);

/// Gives back the memory of a state's maps and evaluation. Its scans and records stay: remake() brings the rest back.
void drop_maps(const ScanSetup& setup, ScanState& state);
/// Makes the maps and the evaluation of a state that has none again from its scans: the same bytes. They begin with
/// those of `from`, an earlier state of the same scan that has them. @throws Stopped; then the state is as it was.
void remake(const ScanSetup& setup, ScanState& state, const ScanState& from, const Progress& progress,
            const std::stop_token& stop);

/// Why a view would have its gain now; nothing if no rays explain it.
std::optional<ScoreExplanation> explain(const ScanSetup& setup, const ScanState& state, const Pose& T_world_camera);

/// Why the scan is done by these criteria; empty while it is not.
std::string termination(const TerminationConfig& config, const ScanState& state);

}  // namespace nextview
