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
  picture.surface = &surface.surface;
  return surface.inspection ? draw_inspection_figure(picture, *surface.inspection) : draw_surface_figure(picture);
}

}  // namespace

void write_and_print_surfaces(std::span<const ScanSurface> surfaces, const std::string& name, std::size_t views,
                              const std::filesystem::path& out, bool pictures) {
  write_surfaces(surfaces, out);
  fmt::print("\n");
  for (const ScanSurface& surface : surfaces) {
    fmt::print("Surface {}.\n", summary(surface));
    if (pictures && !surface.surface.empty()) write_png(draw(surface, name, views), out / (surface.name + ".png"));
  }
}

}  // namespace nextview
