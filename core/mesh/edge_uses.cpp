#include "core/mesh/edge_uses.hpp"

#include <algorithm>

namespace nextview {

std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh, const std::vector<std::uint32_t>& place) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const std::array<std::uint32_t, 3> corner = {place[triangle[0]], place[triangle[1]], place[triangle[2]]};
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = corner[i], to = corner[(i + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), from > to});
    }
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

}  // namespace nextview
