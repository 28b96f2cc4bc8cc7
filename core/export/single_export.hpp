#pragma once
#include <filesystem>
#include <vector>

#include "core/export/export_kind.hpp"
#include "core/export/scan_surfaces.hpp"
#include "core/session/session.hpp"

namespace nextview {

/// Sees that a file is none that a session reads or cannot do without: journal, scans and configuration in its folder
/// (empty: it has none). What is derived from them may be replaced. @throws std::invalid_argument in one line
void require_no_kept_file(const std::filesystem::path& file, const Configuration& configuration,
                          const std::filesystem::path& session_folder);
/// The same of what an export writes, before a long job; and its ending must be one of the kind's.
/// @throws std::invalid_argument in one line
void require_exportable(ExportKind kind, const std::filesystem::path& file, const Configuration& configuration,
                        const std::filesystem::path& session_folder);

/// Writes one thing of a session, in the format that the file's ending says. Returns the files. `wanted`: the map, and
/// a surface of the map, are of this one; else of the conventional map, and the one that views are planned on.
/// @pre what is asked for is not drawn: no picture, no turntable, of curves a table
/// @throws std::invalid_argument without a view, or without a surface; std::runtime_error naming the file and the
/// reason; Stopped
std::vector<std::filesystem::path> export_file(const Session& session, ExportKind kind,
                                               const std::filesystem::path& file, const SurfaceExport& surface = {},
                                               const MapOfViews* wanted = nullptr, const Progress& progress = {},
                                               const std::stop_token& stop = {});

}  // namespace nextview
