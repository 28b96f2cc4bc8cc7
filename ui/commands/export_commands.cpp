#include "ui/commands/export_commands.hpp"

#include <fmt/format.h>

#include "core/export/single_export.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

CommandDeclaration declaration(ExportKind kind, std::string text) {
  const ExportEntry& entry = export_entry(kind);
  return {.name = fmt::format("export-{}", entry.name),
          .menu = "File",
          .text = std::move(text),
          .help = fmt::format("Writes {}.", entry.what),
          .why_not = needs_view,
          .writes = true};
}

ArgumentOf<std::string> where_to(ExportKind kind) {
  const ExportEntry& entry = export_entry(kind);
  const std::string name = std::string(entry.name) + std::string(entry.endings.empty() ? "" : entry.endings.front());
  const auto usual = argument::fixed({name});
  if (entry.endings.empty()) return argument::file("folder", "an empty folder, or one of earlier frames", usual);
  return argument::file("file", "a file that ends in " + entry.endings_text(), usual);
}

ArgumentOf<std::optional<std::string>> size() {
  return argument::optional(argument::text("size", "in pixels, such as 1920x1080; else as it is in the window"));
}

ArgumentOf<std::optional<Background>> background() {
  return argument::optional(argument::choice<Background>("background", "what is behind it", {"opaque", "transparent"}));
}

/// On the session's worker. `map`: which, where it is one or a surface of it; else the one that is shown.
void write(CommandTarget& t, ExportKind kind, const std::string& file, const SurfaceExport& surface = {},
           std::optional<MapChoice> map = {}) {
  require_ending(export_entry(kind), file);
  const bool of_a_map =
      kind == ExportKind::map || (kind == ExportKind::surface && surface.source == SurfaceSource::map);
  if (map == MapChoice::gibbs && !t.session.gibbs)
    throw std::invalid_argument("there is no Gibbs map to write: refine first (G)");
  const bool of_gibbs = of_a_map && map.value_or(t.window.layers.map) == MapChoice::gibbs;
  t.worker.post(request::ExportOne{kind, file, surface, of_gibbs ? t.session.gibbs : nullptr});
}

/// Another request would end it before its last frame.
void require_no_turntable(const WindowState& window) {
  if (window.picture && window.picture->of == PictureRequest::Of::turntable)
    throw std::invalid_argument("a turntable is being drawn: wait until it is written, or cancel it");
}

/// On the drawing thread, which has the pixels.
void draw(CommandTarget& t, ExportKind kind, PictureRequest::Of of, const std::string& file,
          const std::optional<std::string>& wanted_size, const std::optional<Background>& behind, int frames = 1) {
  require_ending(export_entry(kind), file);
  require_no_kept_file(file, t.session.configuration, {});
  require_no_turntable(t.window);
  std::optional<PictureSize> pixels;
  if (wanted_size) pixels = picture_size(*wanted_size, fmt::format("export-{}: SIZE", export_entry(kind).name));
  t.window.picture = PictureRequest{of, file, pixels, behind == Background::transparent, frames};
}

CommandOf<std::string> written(ExportKind kind, std::string text) {
  return {declaration(kind, std::move(text)), where_to(kind),
          [kind](CommandTarget& t, const std::string& file) { write(t, kind, file); }};
}

}  // namespace

const CommandOf<std::string> command::export_cloud = written(ExportKind::cloud, "Export the cloud…");
const CommandOf<std::string> command::export_views = written(ExportKind::views, "Export the views…");

const CommandOf<std::string, std::optional<MapChoice>> command::export_map{
    declaration(ExportKind::map, "Export the map…"), where_to(ExportKind::map),
    argument::optional(
        argument::choice<MapChoice>("map", "which; else the one that is shown", {"conventional", "gibbs"})),
    [](CommandTarget& t, const std::string& file, const auto& map) { write(t, ExportKind::map, file, {}, map); }};

const CommandOf<std::string, std::optional<SurfaceSource>, std::optional<SurfacePart>> command::export_surface{
    declaration(ExportKind::surface, "Export a surface…"), where_to(ExportKind::surface),
    argument::optional(argument::choice<SurfaceSource>(
        "of", "the map that is shown, or the cloud; else the surface that is shown, or the map's", {"map", "cloud"})),
    argument::optional(argument::choice<SurfacePart>(
        "part", "what was seen, or also what closes it, into NAME_unseen beside it", {"seen", "all"})),
    [](CommandTarget& t, const std::string& file, const auto& of, const auto& part) {
      const LayerChoice& layers = t.window.layers;
      const SurfaceSource usual = layers.surface ? layers.surface_source : SurfaceSource::map;
      write(t, ExportKind::surface, file, {of.value_or(usual), part == SurfacePart::all});
    }};

const CommandOf<std::string, std::optional<std::string>, std::optional<Background>> command::export_curves{
    declaration(ExportKind::curves, "Export the curves…"), where_to(ExportKind::curves), size(), background(),
    [](CommandTarget& t, const std::string& file, const auto& pixels, const auto& behind) {
      if (file.ends_with(".csv")) return write(t, ExportKind::curves, file);
      draw(t, ExportKind::curves, PictureRequest::Of::curves, file, pixels, behind);
    }};

const CommandOf<std::string, std::optional<std::string>, std::optional<Background>> command::export_picture{
    declaration(ExportKind::picture, "Export the scene's picture…"), where_to(ExportKind::picture), size(),
    background(), [](CommandTarget& t, const std::string& file, const auto& pixels, const auto& behind) {
      draw(t, ExportKind::picture, PictureRequest::Of::scene, file, pixels, behind);
    }};

const CommandOf<std::string, std::optional<int>, std::optional<std::string>, std::optional<Background>>
    command::export_turntable{
        declaration(ExportKind::turntable, "Export a turntable…"),
        where_to(ExportKind::turntable),
        argument::optional(argument::whole<int>("frames", "how many (36)", 2, 3600)),
        size(),
        background(),
        [](CommandTarget& t, const std::string& folder, const auto& frames, const auto& pixels, const auto& behind) {
          draw(t, ExportKind::turntable, PictureRequest::Of::turntable, folder, pixels, behind, frames.value_or(36));
        }};

const CommandOf<std::string, std::optional<std::string>> command::save_picture{
    {.name = "save-picture",
     .menu = "File",
     .text = "Save a picture…",
     .help = "Writes the window as a PNG picture, with the settings that made it.",
     .writes = true},
    argument::file("file", "a file that ends in .png", argument::fixed({"window.png"})),
    size(),
    [](CommandTarget& t, const std::string& file, const auto& wanted_size) {
      require_no_turntable(t.window);
      PictureRequest picture{PictureRequest::Of::window, file};
      if (wanted_size) picture.size = picture_size(*wanted_size, "save-picture: SIZE");
      t.window.picture = picture;
    }};

}  // namespace nextview
