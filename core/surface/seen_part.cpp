#include "core/surface/seen_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

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

/// What of the surface these triangles need.
Surface with_triangles(const Surface& surface, const TriangleMesh& mesh) {
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(surface.mesh.vertices.size(), unused);
  Surface part;
  for (auto triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      if (number[corner] == unused) {
        number[corner] = static_cast<std::uint32_t>(part.mesh.vertices.size());
        part.mesh.vertices.push_back(surface.mesh.vertices[corner]);
        part.uncertainty.push_back(surface.uncertainty[corner]);
        part.seen.push_back(surface.seen[corner]);
      }
      corner = number[corner];
    }
    part.mesh.triangles.push_back(triangle);
  }
  return part;
}

}  // namespace

TriangleMesh seen_part(const Surface& surface) { return part(surface, true); }
TriangleMesh unseen_part(const Surface& surface) { return part(surface, false); }

Surface seen_surface(const Surface& surface) { return with_triangles(surface, seen_part(surface)); }
Surface unseen_surface(const Surface& surface) { return with_triangles(surface, unseen_part(surface)); }

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
