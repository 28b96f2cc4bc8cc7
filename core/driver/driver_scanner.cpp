#include "core/driver/driver_scanner.hpp"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

namespace nextview {
namespace {

/// Empty where a pose is near enough to the wanted one, or where a hand moves the scanner.
std::string missed_by(const DriverConnection& connection, const Pose& wanted, const Pose& reached) {
  const DriverOptions& options = connection.options();
  const double distance = (reached.translation() - wanted.translation()).norm();
  const double angle = rotation_angle(wanted, reached) * 180.0 / std::numbers::pi;
  if (connection.is_free_hand() || (distance <= options.reached_within && angle <= options.turned_within)) return {};
  return fmt::format("{:.3g} m and {:.3g} degrees from the view (at most {:g} m and {:g} degrees are taken)", distance,
                     angle, options.reached_within, options.turned_within);
}

}  // namespace

DriverSource::DriverSource(std::shared_ptr<DriverConnection> connection, std::uint64_t seed)
    : connection_(std::move(connection)), seed_(seed), description_(connection_->description()) {}

Result<Capture> DriverSource::capture(const View& view, std::uint32_t step, std::stop_token stop) {
  Result<Capture> capture = connection_->capture(step, seed_, std::move(stop));
  if (const auto* taken = std::get_if<Capture>(&capture))
    if (const std::string off = missed_by(*connection_, view.T_world_camera, taken->T_world_camera); !off.empty())
      return Failure{Failure::no_data, "the scan was taken " + off};
  return capture;
}

DriverRobot::DriverRobot(std::shared_ptr<DriverConnection> connection, const Pose& start)
    : connection_(std::move(connection)) {
  if (!connection_->knows_pose()) connection_->set_pose(start);
}

std::vector<Reach> DriverRobot::reach(const Pose& from, std::span<const View> views) {
  std::vector<Reach> result;
  std::vector<Pose> asked;
  for (const View& view : views) {
    result.push_back({forbidden(view.T_world_camera), {}});
    if (result.back().unreachable.empty()) asked.push_back(view.T_world_camera);
  }
  if (asked.empty()) return result;
  const Result<std::vector<Reach>> answer = connection_->reach(from, asked);
  if (const auto* failure = std::get_if<Failure>(&answer)) throw std::runtime_error(failure->reason);
  auto next = std::get<std::vector<Reach>>(answer).begin();
  for (Reach& reach : result)
    if (reach.unreachable.empty()) reach = *next++;
  return result;
}

Result<Pose> DriverRobot::move_to(const View& view, std::stop_token stop) {
  const Pose& wanted = view.T_world_camera;
  if (stop.stop_requested()) return Failure{Failure::cancelled, "the move was cancelled"};
  if (const std::string reason = forbidden(wanted); !reason.empty()) return Failure{Failure::unreachable, reason};
  const bool real = !connection_->is_simulated() && !connection_->is_free_hand();
  if (const auto& confirm = connection_->options().confirm; real && confirm && !confirm(pose(), wanted))
    return Failure{Failure::refused, "the operator refused the move"};
  Result<Pose> reached = connection_->move(wanted, stop);
  if (std::holds_alternative<Failure>(reached)) return reached;
  if (stop.stop_requested()) return Failure{Failure::cancelled, "the move was cancelled"};
  if (const std::string off = missed_by(*connection_, wanted, std::get<Pose>(reached)); !off.empty())
    return Failure{Failure::unreachable, "the robot stopped " + off};
  return reached;
}

void DriverRobot::restored(const Pose& T_world_camera) {
  if (!connection_->is_simulated()) return;
  // Where it should be, even if it cannot be told now: moves say where to, not how far.
  if (!connection_->is_lost() && forbidden(T_world_camera).empty()) connection_->move(T_world_camera, {});
  connection_->set_pose(T_world_camera);
}

/// Why a pose is not even asked for; empty if it is.
std::string DriverRobot::forbidden(const Pose& T_world_camera) const {
  if (!is_pose(T_world_camera)) return "the pose is not finite, not rigid, or too far off";
  return outside(connection_->options().working_volume, T_world_camera.translation());
}

}  // namespace nextview
