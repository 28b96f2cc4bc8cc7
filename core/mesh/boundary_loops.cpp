#include "core/mesh/boundary_loops.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/mesh/edge_uses.hpp"
#include "core/mesh/weld.hpp"
#include "core/setting/length_text.hpp"

namespace nextview {
namespace {

/// Of each place on the boundary those at the other ends of its boundary edges.
using Neighbours = std::map<std::uint32_t, std::set<std::uint32_t>>;

Neighbours boundary(const TriangleMesh& mesh, const std::vector<std::uint32_t>& place) {
  Neighbours neighbours;
  const std::vector<EdgeUse> uses = edge_uses(mesh, place);
  for (auto first = uses.begin(); first != uses.end();) {
    const auto last = std::find_if(first, uses.end(), [&](const EdgeUse& use) { return !use.same_edge(*first); });
    if ((last - first) % 2 == 1) {
      neighbours[first->lower].insert(first->upper);
      neighbours[first->upper].insert(first->lower);
    }
    first = last;
  }
  return neighbours;
}

/// The ways around that start and end in `start`, or branch off from one that does; uses up their edges. Walks on until
/// it stands in a place where it has been before: the way since then is closed, and the walk goes on from there. It
/// cannot get stuck elsewhere than in `start`, as every place has an even number of edges.
std::vector<std::vector<std::uint32_t>> ways_around(std::uint32_t start, Neighbours& neighbours) {
  std::vector<std::vector<std::uint32_t>> ways;
  std::vector<std::uint32_t> walk = {start};
  std::map<std::uint32_t, std::size_t> position = {{start, 0}};  // in the walk
  while (!neighbours[walk.back()].empty()) {
    const std::uint32_t from = walk.back(), to = *neighbours[from].begin();
    neighbours[from].erase(to);
    neighbours[to].erase(from);
    if (position.try_emplace(to, walk.size()).second) {
      walk.push_back(to);
      continue;
    }
    const auto again = walk.begin() + static_cast<std::ptrdiff_t>(position[to]);
    ways.emplace_back(again, walk.end());
    std::for_each(again + 1, walk.end(), [&](std::uint32_t left) { position.erase(left); });
    walk.erase(again + 1, walk.end());
  }
  return ways;
}

BoundaryLoop measured(std::vector<std::uint32_t> vertices, const TriangleMesh& mesh) {
  BoundaryLoop loop{std::move(vertices), 0.0, Vector3::Zero()};
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    const Vector3 from = mesh.vertices[loop.vertices[i]].cast<double>();
    const Vector3 to = mesh.vertices[loop.vertices[(i + 1) % loop.vertices.size()]].cast<double>();
    const double length = (to - from).norm();
    loop.length += length;
    loop.centre += length * 0.5 * (from + to);
  }
  loop.centre /= loop.length;  // over 0: its places differ
  return loop;
}

}  // namespace

std::vector<BoundaryLoop> boundary_loops(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> place = weld(mesh.vertices);
  std::vector<std::uint32_t> vertex_at;  // of each place the first vertex
  for (std::uint32_t i = 0; i < place.size(); ++i)
    if (place[i] == vertex_at.size()) vertex_at.push_back(i);

  std::vector<BoundaryLoop> loops;
  Neighbours neighbours = boundary(mesh, place);
  for (const auto& [start, unused] : neighbours)
    for (std::vector<std::uint32_t>& way : ways_around(start, neighbours)) {
      for (std::uint32_t& corner : way) corner = vertex_at[corner];
      loops.push_back(measured(std::move(way), mesh));
    }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const BoundaryLoop& a, const BoundaryLoop& b) { return a.length > b.length; });
  return loops;
}

std::string summary(std::span<const BoundaryLoop> loops) {
  if (loops.empty()) return "watertight";
  const double places = loops[0].length < 0.01 ? 1e2 : 1.0;  // of parts of millimetres two decimals, else none
  const Vector3 centre = (1e3 * places * loops[0].centre).array().round() / places + 0.0;  // [mm]; no "-0"
  return fmt::format("{} opening{}{} around, at ({:g}, {:g}, {:g}) mm", loops.size(),
                     loops.size() == 1 ? ", " : "s, the longest ", length_text(loops[0].length), centre.x(), centre.y(),
                     centre.z());
}

}  // namespace nextview
