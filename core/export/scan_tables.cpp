#include "core/export/scan_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/file/json_text.hpp"

namespace nextview {
namespace {

bool is_registered(const Session& session) {
  return session.configuration().registration.mode != RegistrationConfig::Mode::off;
}

std::string registration_text(const StepRecord& r) {
  if (!r.registration) return ",,,";
  return fmt::format(",{},{},{}", r.registration->shift, r.registration->rotation, r.registration->overlap);
}

Eigen::Quaterniond rotation_of(const StepRecord& record) { return Eigen::Quaterniond(record.T_world_camera.linear()); }

}  // namespace

GainColumn::GainColumn(const Session& session) : unit_(session.planner().unit()) {
  const auto is_other = [&](const std::string& unit) { return !unit.empty() && unit != unit_; };
  mixed_ = std::ranges::any_of(
      session.records(), [&](const StepRecord& r) { return is_other(r.gain_unit) || is_other(r.ranking.gain_unit); });
}

std::string steps_csv(const Session& session) {
  const GainColumn gain(session);
  const auto d_reg = session.configuration().evaluation.d_reg;
  std::string csv = fmt::format(
      "step,view,overridden,{},utility,realised_gain[nats],distance[m],rotation[rad],path[m],hits,points,"
      "misses,new_voxels,"
      "entropy[bits],total_entropy[bits],coverage@{:g}mm,coverage_visible@{:g}mm,coverage@0.5mm,d_kl[nats],log_loss["
      "nats],brier,"
      "log_loss_near_surface[nats],brier_near_surface,next_view,degenerate,new_surface[cm²],surface_left{}{}{}{}\n",
      gain.name(), 1e3 * d_reg, 1e3 * d_reg,
      session.setup().any_pose.empty() ? "" : fmt::format(",coverage_any_pose@{:g}mm", 1e3 * d_reg),
      session.recording() ? fmt::format(",coverage_recorded@{:g}mm", 1e3 * d_reg) : "",
      is_registered(session) ? ",registration_shift[m],registration_rotation[rad],registration_overlap" : "",
      gain.unit_name());
  // Where the truth is not known, nothing is said of it: 0 would be a perfect map.
  const auto of_truth = [&](double value) { return session.known_object() ? fmt::format("{}", value) : ""; };
  double path = 0.0;
  for (const StepRecord& r : session.records()) {
    path += r.motion.distance;
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}{}{}{}{}\n",
                       r.step, r.view, int(r.overridden), r.gain, r.utility, r.realised_gain, r.motion.distance,
                       r.motion.rotation, path, r.hits, r.points, r.misses, r.new_voxels, r.entropy, r.total_entropy,
                       of_truth(r.coverage), of_truth(r.coverage_visible), of_truth(r.coverage_paper),
                       of_truth(r.quality.divergence), of_truth(r.quality.log_loss), of_truth(r.quality.brier),
                       of_truth(r.quality_near_surface.log_loss), of_truth(r.quality_near_surface.brier),
                       r.ranking.best ? fmt::format("{}", *r.ranking.best) : "", int(!r.ranking.degenerate.empty()),
                       r.new_surface, r.surface_left ? fmt::format("{}", *r.surface_left) : "",
                       r.coverage_any_pose ? fmt::format(",{}", *r.coverage_any_pose) : "",
                       r.coverage_recorded ? fmt::format(",{}", *r.coverage_recorded) : "",
                       is_registered(session) ? registration_text(r) : "", gain.unit(r.gain_unit));
  }
  return csv;
}

std::string views_csv(const Session& session) {
  std::string csv = "step,view,x[m],y[m],z[m],qx,qy,qz,qw\n";
  for (const StepRecord& r : session.records()) {
    const Vector3 p = r.T_world_camera.translation();
    const Eigen::Quaterniond q = rotation_of(r);
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", r.step, r.view, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  }
  return csv;
}

std::string views_json(const Session& session) {
  auto views = nlohmann::ordered_json::array();
  for (const StepRecord& r : session.records()) {
    const Vector3 p = r.T_world_camera.translation(), look = r.T_world_camera.linear().col(2);
    const Eigen::Quaterniond q = rotation_of(r);
    std::vector<double> matrix;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) matrix.push_back(r.T_world_camera.matrix()(row, column));
    views.push_back({{"step", r.step},
                     {"view", r.view},
                     {"T_world_camera", matrix},
                     {"position_m", {p.x(), p.y(), p.z()}},
                     {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}},
                     {"look_direction", {look.x(), look.y(), look.z()}}});
  }
  return json_text(views, 2) + "\n";
}

std::string views_txt(const Session& session) {
  std::string text =
      "# poses of the camera in the world, in the order of the scan: x y z [m] qx qy qz qw; the camera looks along its "
      "z axis, y down\n";
  for (const StepRecord& r : session.records()) {
    const Vector3 p = r.T_world_camera.translation();
    const Eigen::Quaterniond q = rotation_of(r);
    text += fmt::format("{} {} {} {} {} {} {}\n", p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

}  // namespace nextview
