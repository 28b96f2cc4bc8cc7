#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace nextview {

/// What of a scan is exported by itself.
enum class ExportKind { cloud, map, surface, views, curves, picture, turntable };

/// What a surface is made of.
enum class SurfaceSource { map, cloud };

/// How a surface is exported.
struct SurfaceExport {
  SurfaceSource source = SurfaceSource::map;
  bool unseen = false;  ///< also the hull of what no view saw, into a file of its own: NAME_unseen beside NAME
};

/// A kind as it is offered, on the command line and in the window.
struct ExportEntry {
  ExportKind kind;
  std::string_view name;                      ///< "cloud"; in the window `export-cloud`
  std::string_view what;                      ///< for people, where it stands after "writes": "the points of all views"
  std::string_view in_words;                  ///< where it stands before "can be written as": "a cloud"
  std::span<const std::string_view> endings;  ///< of its files; none: it is a folder
  bool drawn;                                 ///< with pixels, at least some of its files

  /// ".ply or .pcd"
  std::string endings_text() const;
};

/// Every kind there is.
std::span<const ExportEntry> export_entries();
const ExportEntry& export_entry(ExportKind kind);
/// @throws std::invalid_argument naming the nearest one
const ExportEntry& export_entry(std::string_view name);

/// @throws std::invalid_argument in one line, naming the file and the endings that there are
void require_ending(const ExportEntry& entry, const std::filesystem::path& file);

}  // namespace nextview
