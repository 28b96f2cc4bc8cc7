#include "app/commands/report_scans.hpp"

#include <fmt/format.h>

#include "core/progress/stopped.hpp"
#include "core/session/driver_setup.hpp"
#include "core/session/saved_session.hpp"

namespace nextview {
namespace {

/// Refines once, however often it is asked.
template <class Job>
auto maps_once(Job job, std::stop_token stop) {
  return [job, stop, maps = std::shared_ptr<const ReportMaps>()]() mutable {
    if (maps) return maps;
    RefinementJob made = job();
    Refinement refinement = refine(made, {}, stop);
    return maps = std::make_shared<ReportMaps>(std::move(made), std::move(refinement));
  };
}

ReportScan opened_scan(const std::string& folder, const ProgressLine& progress, const std::stop_token& stop) {
  SavedSession saved = read_session(folder);
  const Configuration& c = saved.configuration;
  SessionParts parts = c.driver.name.empty() ? SessionParts{} : absent_scanner_parts(c);
  ReportScan scan;
  scan.session = std::make_unique<Session>(began_with(saved), std::move(parts), progress, stop);
  const auto keep = [&](std::uint32_t) { scan.states.push_back(scan.session->state()); };
  restore(*scan.session, saved, nullptr, keep, progress, stop);
  throw_if_stopped(stop);
  if (scan.states.empty()) throw std::invalid_argument(folder + ": has no view yet, so there is nothing to draw");
  scan.name = scan.session->name();
  scan.maps = maps_once([folder, stop] { return refinement_job(folder, {}, {}, stop); }, stop);
  return scan;
}

ReportScan made_scan(const std::string& object, const ProgressLine& progress, const std::stop_token& stop) {
  Configuration c;
  c.object.file = object;
  c.sensor.width = 160;
  c.sensor.height = 120;
  c.termination.views = 20;
  c.termination.surface_left = 0.0;
  ReportScan scan;
  scan.session = std::make_unique<Session>(c, Progress{}, stop);
  while (scan.session->finished().empty()) {
    progress(double(scan.states.size()) / c.termination.views, "scanning " + object);
    if (!scan.session->step({}, stop)) throw Stopped();
    scan.states.push_back(scan.session->state());
  }
  scan.name = scan.session->name();
  std::vector<Pose> views;
  for (const StepRecord& record : scan.session->records()) views.push_back(record.T_world_camera);
  scan.maps = maps_once([configuration = scan.session->configuration(), views,
                         stop] { return refinement_job(configuration, views, {}, stop); },
                        stop);
  return scan;
}

}  // namespace

std::vector<ReportScan> report_scans(std::span<const std::string> folders, const ProgressLine& progress,
                                     const std::stop_token& stop) {
  std::vector<ReportScan> scans;
  for (const std::string& folder : folders) scans.push_back(opened_scan(folder, progress, stop));
  progress.clear();
  return scans;
}

std::vector<ReportScan> made_scans(const ProgressLine& progress, const std::stop_token& stop) {
  std::vector<ReportScan> scans;
  for (const char* object : {"slotted_housing", "slotted_plate"}) scans.push_back(made_scan(object, progress, stop));
  progress.clear();
  return scans;
}

}  // namespace nextview
