#include "core/export/single_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "core/config/input_files.hpp"
#include "core/export/scan_tables.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/same_file.hpp"
#include "core/journal/journal.hpp"
#include "core/map/octree_file.hpp"
#include "core/progress/part.hpp"
#include "core/progress/stopped.hpp"
#include "core/surface/seen_part.hpp"
#include "core/surface/surface_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// What a session cannot do without.
std::vector<InputFile> kept_files(const fs::path& folder) {
  std::vector<InputFile> files = {{folder, "the session's folder"},
                                  {folder / journal_name, "the session's journal"},
                                  {folder / "config.toml", "the session's configuration"},
                                  {folder / manifest_name, "the session's list of its files"},
                                  {folder / scans_name, "the session's folder of scans"}};
  std::error_code ignored;
  for (fs::directory_iterator entry(folder / scans_name, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    files.push_back({entry->path(), "a scan of the session"});
  return files;
}

PointCloud all_points(const Session& session) {
  PointCloud cloud;
  for (const auto& scan : session.scans()) cloud.insert(cloud.end(), scan->hits.begin(), scan->hits.end());
  return cloud;
}

void write_surface(const Surface& surface, const fs::path& file, std::string_view remark) {
  if (file.extension() == ".stl")
    write_stl(surface.mesh, file, remark);
  else
    write_ply(surface, file);
}

fs::path with_unseen(const fs::path& file) {
  return file.parent_path() / fmt::format("{}_unseen{}", file.stem().string(), file.extension().string());
}

std::vector<fs::path> export_surface(const Session& session, const fs::path& file, const SurfaceExport& how,
                                     const MapOfViews* wanted, const Progress& progress, const std::stop_token& stop) {
  const ScanSurface found = scan_surface(session, how.source, wanted, progress, stop);
  const Surface seen = seen_surface(found.surface);
  if (seen.empty())
    throw std::invalid_argument(
        fmt::format("{}: is not written, {} has no surface: {}", file.string(), found.source,
                    found.surface.why_empty.empty() ? "no view saw anything of it" : found.surface.why_empty));
  write_surface(seen, file, "what was seen");
  std::vector<fs::path> files = {file};
  const Surface unseen = how.unseen ? unseen_surface(found.surface) : Surface{};
  if (unseen.empty()) return files;
  write_surface(unseen, with_unseen(file), "the hull of what no view saw");
  files.push_back(with_unseen(file));
  return files;
}

std::string views_text(const Session& session, const std::string& ending) {
  return ending == ".csv" ? views_csv(session) : ending == ".json" ? views_json(session) : views_txt(session);
}

}  // namespace

void require_no_kept_file(const fs::path& file, const Configuration& configuration, const fs::path& session_folder) {
  std::vector<InputFile> kept = input_files(configuration);
  if (!session_folder.empty()) {
    const std::vector<InputFile> own = kept_files(session_folder);
    kept.insert(kept.end(), own.begin(), own.end());
  }
  for (const InputFile& input : kept)
    if (same_file(file, input.path))
      throw std::invalid_argument(
          fmt::format("{}: is {}, and is not written over; give another file", file.string(), input.what));
  std::error_code none;
  const fs::path recorded = fs::weakly_canonical(configuration.recorded.folder, none);
  const fs::path relative = fs::weakly_canonical(file, none).lexically_relative(recorded);
  if (!configuration.recorded.folder.empty() && fs::is_directory(recorded, none) && fs::exists(file, none) &&
      !relative.empty() && *relative.begin() != "..")
    throw std::invalid_argument(
        fmt::format("{}: is among the recorded data, and is not written over; give another file", file.string()));
  const fs::path parent = file.has_parent_path() ? file.parent_path() : ".";
  if (!session_folder.empty() && same_file(parent, session_folder / scans_name))
    throw std::invalid_argument(fmt::format("{}: is among the session's scans; give another folder", file.string()));
}

void require_exportable(ExportKind kind, const fs::path& file, const Configuration& configuration,
                        const fs::path& session_folder) {
  require_ending(export_entry(kind), file);
  require_no_kept_file(file, configuration, session_folder);
  if (kind == ExportKind::surface) require_no_kept_file(with_unseen(file), configuration, session_folder);
}

std::vector<fs::path> export_file(const Session& session, ExportKind kind, const fs::path& file,
                                  const SurfaceExport& surface, const MapOfViews* wanted, const Progress& progress,
                                  const std::stop_token& stop) {
  if (session.records().empty())
    throw std::invalid_argument(fmt::format("{}: is not written: no view was taken yet", file.string()));
  const std::string ending = file.extension().string();
  if (kind == ExportKind::surface) return export_surface(session, file, surface, wanted, progress, stop);
  if (progress) progress(0.0, fmt::format("writing {}", file.string()));
  throw_if_stopped(stop);
  switch (kind) {
    case ExportKind::cloud:
      ending == ".pcd" ? write_pcd(all_points(session), file) : write_ply(all_points(session), file);
      break;
    case ExportKind::map:
      write_octree(wanted ? wanted->map : session.map(), file);
      break;
    case ExportKind::views:
      write_file(file, views_text(session, ending));
      break;
    default:
      assert(kind == ExportKind::curves && ending == ".csv");
      write_file(file, steps_csv(session));
  }
  return {file};
}

}  // namespace nextview
