#include "app/commands/surface_output.hpp"

#include <fmt/format.h>

#include "ui/figures/inspection_figure.hpp"

namespace nextview {
namespace {

Image draw(const ScanSurface& surface, const std::string& name, std::size_t views) {
  SurfacePicture picture;
  picture.title = fmt::format("{}: the surface of {}", name, surface.source);
  picture.remark = fmt::format("{} views", views);
  picture.caption = surface.caption;
  picture.openings = summary(surface.openings);
  picture.surface = &surface.surface;
  return surface.inspection ? draw_inspection_figure(picture, *surface.inspection) : draw_surface_figure(picture);
}

}  // namespace

std::string write_and_print_surfaces(std::span<const ScanSurface> surfaces, const std::string& name, std::size_t views,
                                     const std::filesystem::path& out, bool pictures) {
  write_surfaces(surfaces, out);
  if (surfaces.empty()) return "";  // stopped
  fmt::print("\n");
  std::string files;
  for (const ScanSurface& surface : surfaces) {
    fmt::print("Surface {}.\n", summary(surface));
    if (surface.surface.empty()) continue;
    if (pictures) write_png(draw(surface, name, views), out / (surface.name + ".png"));
    files += fmt::format("{0}.ply, {0}.stl, {1}", surface.name, pictures ? surface.name + ".png, " : "");
  }
  return fmt::format("  {}surfaces.json   the surfaces: PLY in metres, STL in millimetres\n", files);
}

}  // namespace nextview
