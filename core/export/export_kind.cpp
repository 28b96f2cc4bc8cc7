#include "core/export/export_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "core/setting/setting.hpp"

namespace nextview {
namespace {

constexpr std::array<std::string_view, 2> cloud_files = {".ply", ".pcd"}, map_files = {".ot", ".bt"},
                                          surface_files = {".ply", ".stl"};
constexpr std::array<std::string_view, 3> view_files = {".csv", ".json", ".txt"},
                                          curve_files = {".csv", ".svg", ".png"};
constexpr std::array<std::string_view, 1> picture_files = {".png"};

constexpr std::array<ExportEntry, 7> entries = {{
    {ExportKind::cloud, "cloud", "the points of all views [m]", "a cloud", cloud_files, false},
    {ExportKind::map, "map", "the occupancy map (OctoMap)", "a map", map_files, false},
    {ExportKind::surface, "surface", "the surface, as far as it was seen (PLY in metres, STL in millimetres)",
     "a surface", surface_files, false},
    {ExportKind::views, "views", "the poses of the views in their order; .txt has a line per pose, for robot programs",
     "views", view_files, false},
    {ExportKind::curves, "curves", "how the scan went, view by view: a table, or plots", "curves", curve_files, true},
    {ExportKind::picture, "picture", "the scene as a picture, with the settings that made it", "a picture",
     picture_files, true},
    {ExportKind::turntable,
     "turntable",
     "pictures of the scene from all around, numbered, into a folder",
     "a turntable",
     {},
     true},
}};

}  // namespace

std::string ExportEntry::endings_text() const { return fmt::format("{}", fmt::join(endings, " or ")); }

std::span<const ExportEntry> export_entries() { return entries; }

const ExportEntry& export_entry(ExportKind kind) { return entries.at(static_cast<std::size_t>(kind)); }

const ExportEntry& export_entry(std::string_view name) {
  const auto found = std::ranges::find(entries, name, &ExportEntry::name);
  if (found != entries.end()) return *found;
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const ExportEntry& entry : entries) names.emplace_back(entry.name);
  throw std::invalid_argument(fmt::format("there is no '{}' to export, but {}{}", name, fmt::join(names, ", "),
                                          did_you_mean(std::string(name), names)));
}

void require_ending(const ExportEntry& entry, const std::filesystem::path& file) {
  if (entry.endings.empty()) return;
  const std::string ending = file.extension().string();
  if (std::ranges::find(entry.endings, ending) != entry.endings.end()) return;
  throw std::invalid_argument(
      fmt::format("{}: {} can be written as {}", file.string(), entry.in_words, entry.endings_text()));
}

}  // namespace nextview
