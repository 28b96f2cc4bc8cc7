#include "app/commands/surface_output.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/file/counted.hpp"
#include "core/surface/seen_part.hpp"
#include "ui/figures/surface_error_figure.hpp"

namespace nextview {
namespace {

Image draw(RenderTarget& target, const ScanSurface& surface, const std::string& name, std::size_t views) {
  SurfacePicture picture;
  picture.title = fmt::format("{}: the surface of {}", name, surface.source);
  picture.remark = counted(views, "view");
  picture.caption = surface.caption;
  const bool all_seen = !(seen_area(surface.surface).unseen > 0.0);
  picture.openings =
      surface.openings.empty() && !all_seen ? "none: closed by what was not seen" : summary(surface.openings);
  picture.surface = &surface.surface;
  return surface.surface_error ? draw_surface_error_figure(target, picture, *surface.surface_error)
                               : draw_surface_figure(target, picture);
}

}  // namespace

std::string write_and_print_surfaces(std::span<const ScanSurface> surfaces, const std::string& name, std::size_t views,
                                     OutputFolder& out, RenderTarget* target) {
  std::vector<std::string> files = write_surfaces(surfaces, out);
  if (surfaces.empty()) return "";  // stopped
  fmt::print("\n");
  for (const ScanSurface& surface : surfaces) {
    fmt::print("Surface {}.\n", summary(surface));
    if (surface.surface.empty() || !target) continue;
    files.push_back(surface.name + ".png");
    write_png(draw(*target, surface, name, views), out.claim(files.back()));
  }
  const bool unseen = std::any_of(files.begin(), files.end(), [](const auto& f) { return f.ends_with("_unseen.stl"); });
  return fmt::format(
      "  {}\n                  the surfaces: PLY, whole, in metres; STL in millimetres, what was seen{}\n",
      fmt::join(files, ", "), unseen ? "; _unseen.stl: the hull of the rest" : "");
}

}  // namespace nextview
