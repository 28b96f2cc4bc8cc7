#include "core/surface/seen_part.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nextview {
namespace {

TriangleMesh part(const Surface& surface, bool seen) {
  TriangleMesh part;
  part.vertices = surface.mesh.vertices;
  for (const auto& triangle : surface.mesh.triangles)
    if (std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t i) { return surface.seen[i] != 0; }) == seen)
      part.triangles.push_back(triangle);
  return part;
}

}  // namespace

TriangleMesh seen_part(const Surface& surface) { return part(surface, true); }
TriangleMesh unseen_part(const Surface& surface) { return part(surface, false); }

SeenArea seen_area(const Surface& surface) {
  return {seen_part(surface).surface_area(), unseen_part(surface).surface_area()};
}

std::string SeenArea::text(double area) const {
  const double sum = seen + unseen;
  if (sum >= 0.1) return fmt::format("{:.3f} m²", area);
  return sum >= 1e-4 ? fmt::format("{:.1f} cm²", 1e4 * area) : fmt::format("{:.2f} mm²", 1e6 * area);
}

std::string SeenArea::percent_seen() const {
  const double share = seen + unseen > 0.0 ? seen / (seen + unseen) : 0.0;
  if (share > 0.0 && share < 0.01) return "less than 1 %";
  if (share < 1.0 && share > 0.99) return "over 99 %";
  return fmt::format("{:.0f} %", 100.0 * share);
}

}  // namespace nextview
