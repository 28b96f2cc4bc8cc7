#include "core/evaluation/missed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/mesh/subdivision.hpp"

namespace nextview {
namespace {

constexpr std::size_t max_held = 1'000'000;  ///< a quarter of what subdivided() makes

double longest_edge_of(const TriangleMesh& mesh) {
  float longest = 0.0f;
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, a}})
      longest = std::max(longest, (mesh.vertices[to] - mesh.vertices[from]).norm());
  return longest;
}

/// The longest edges first, a fifth at a time, until all are short enough or there would be too many triangles. So
/// small a step splits no edge twice: it makes at most four triangles of one. `longest_edge` becomes what was reached.
std::shared_ptr<const TriangleMesh> fine_mesh(const TriangleMesh& mesh, std::size_t max_triangles,
                                              double& longest_edge) {
  auto fine = std::make_shared<const TriangleMesh>(mesh);
  double reached = longest_edge_of(mesh);
  while (reached > longest_edge) {
    const double next = std::max(longest_edge, reached / 1.2);
    auto finer = std::make_shared<const TriangleMesh>(subdivided(*fine, next));
    if (finer->triangles.size() > max_triangles) break;
    fine = std::move(finer);
    reached = next;
  }
  longest_edge = reached;
  return fine;
}

double require_over_zero(double d_reg) {
  if (!(d_reg > 0.0 && std::isfinite(d_reg))) throw std::invalid_argument("missed surface: d_reg must be over 0 m");
  return d_reg;
}

}  // namespace

MissedSurface::MissedSurface(const TriangleMesh& mesh, double d_reg, std::size_t max_triangles)
    : longest_edge_(1.5 * require_over_zero(d_reg)),
      mesh_(fine_mesh(mesh, std::min(max_triangles, max_held), longest_edge_)),
      coverage_(mesh_->vertices, d_reg) {}

}  // namespace nextview
