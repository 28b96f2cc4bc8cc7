#pragma once
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// One triangle's use of an edge between two places (weld).
struct EdgeUse {
  std::uint32_t lower, upper;
  bool downwards;  ///< the triangle runs from `upper` to `lower`

  bool operator<(const EdgeUse& other) const {
    return std::tie(lower, upper, downwards) < std::tie(other.lower, other.upper, other.downwards);
  }
  bool same_edge(const EdgeUse& other) const { return lower == other.lower && upper == other.upper; }
};

/// Sorted, so that the uses of one edge stand together. `place`: weld(mesh.vertices). A triangle folded to a line uses
/// no edge: it closes nothing and opens nothing.
std::vector<EdgeUse> edge_uses(const TriangleMesh& mesh, const std::vector<std::uint32_t>& place);

}  // namespace nextview
