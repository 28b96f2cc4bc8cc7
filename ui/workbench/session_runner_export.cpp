// What a session runner writes of its session.
#include <stdexcept>

#include "core/config/input_files.hpp"
#include "core/export/scan_files.hpp"
#include "core/export/scan_surfaces.hpp"
#include "core/export/single_export.hpp"
#include "core/map/octree_file.hpp"
#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/saved_session.hpp"
#include "ui/workbench/session_runner.hpp"

namespace nextview {

std::vector<std::string> SessionRunner::write(const std::filesystem::path& folder, const JobControl& control) {
  if (!session_ || session_->records().empty()) throw std::invalid_argument("there is no view to write yet");
  if (is_own(folder)) {
    OutputFolder out(folder, {});
    out.go_on("scan");
    return write_results(out, control);
  }
  const std::vector<InputFile> inputs = input_files(session_->configuration());
  OutputFolder out(folder, inputs, "");
  if (const InTheWay found = in_the_way(folder, inputs); found != InTheWay::nothing)
    throw std::invalid_argument(folder.string() + (found == InTheWay::session
                                                       ? ": holds another session: give another name, or open that one"
                                                       : ": is not empty, and holds no session: give another name"));
  out.begin("scan", session_->object_file().empty() ? std::nullopt : std::optional(session_->object_file()));
  kept_->copy_to(out, *session_);
  return write_results(out, control);
}

std::vector<std::string> SessionRunner::write_results(OutputFolder& out, const JobControl& control) {
  control.progress(0.0, "writing the scan");
  write_scan(*session_, out);
  const std::shared_ptr<const GibbsMap> gibbs = snapshot_->gibbs;
  if (gibbs && !session_->refinement())  // which write_scan wrote
    write_octree(to_occupancy_map(*gibbs->posterior, session_->map().model()), out.claim("posterior.ot"));
  const auto surfaces = scan_surfaces(*session_, part(control.progress, 0.2, 0.9), control.stop);
  if (control.stop.stop_requested()) throw Stopped();
  write_surfaces(surfaces, out);
  std::vector<std::string> summaries;
  for (const ScanSurface& surface : surfaces) summaries.push_back("Surface " + summary(surface));
  if (gibbs) tree_->refined.written = gibbs;
  publish(*snapshot_);
  return summaries;
}

std::vector<std::filesystem::path> SessionRunner::write_one(const request::ExportOne& wanted,
                                                            const JobControl& control) {
  if (!session_) throw std::invalid_argument("there is no view to write yet");
  const SessionFolder* const own = kept_->folder();
  require_exportable(wanted.kind, wanted.file, session_->configuration(), own ? own->path() : std::filesystem::path());
  MapOfViews map{session_->map()};
  if (wanted.gibbs)
    map = {to_occupancy_map(*wanted.gibbs->posterior, session_->map().model()), wanted.gibbs->config.prior};
  auto files = export_file(*session_, wanted.kind, wanted.file, wanted.surface, &map, control.progress, control.stop);
  if (wanted.gibbs && wanted.kind == ExportKind::map && wanted.file.extension() == ".ot") {
    tree_->refined.written = wanted.gibbs;
    publish(*snapshot_);
  }
  return files;
}

}  // namespace nextview
