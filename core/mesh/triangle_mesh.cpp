#include "core/mesh/triangle_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/file/counted.hpp"
#include "core/mesh/edge_uses.hpp"
#include "core/mesh/weld.hpp"

namespace nextview {
namespace {

/// Divergence theorem, about the box's centre: far from the origin the terms would cancel badly.
double signed_volume(const TriangleMesh& mesh) {
  const Eigen::Vector3d centre = mesh.bounding_box().center();
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto corner = [&](std::uint32_t i) -> Eigen::Vector3d { return mesh.vertices[i].cast<double>() - centre; };
    six_volumes += corner(a).dot(corner(b).cross(corner(c)));
  }
  return six_volumes / 6.0;
}

}  // namespace

Eigen::AlignedBox3d TriangleMesh::bounding_box() const {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : vertices) box.extend(vertex.cast<double>());
  return box;
}

double TriangleMesh::surface_area() const {
  double two_areas = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d origin = vertices[a].cast<double>();
    two_areas += (vertices[b].cast<double>() - origin).cross(vertices[c].cast<double>() - origin).norm();
  }
  return two_areas / 2.0;
}

MeshTopology topology(const TriangleMesh& mesh) {
  const std::vector<EdgeUse> uses = edge_uses(mesh, weld(mesh.vertices));
  MeshTopology topology;
  for (auto first = uses.begin(); first != uses.end();) {
    const auto last = std::find_if(first, uses.end(), [&](const EdgeUse& use) { return !use.same_edge(*first); });
    const auto triangles = last - first;
    topology.boundary_edges += triangles == 1;
    topology.non_manifold_edges += triangles > 2;
    topology.misoriented_edges += triangles == 2 && first->downwards == std::next(first)->downwards;
    first = last;
  }
  topology.inward = topology.watertight() && signed_volume(mesh) < 0.0;
  return topology;
}

std::string MeshTopology::summary() const {
  std::vector<std::string> remarks;
  if (boundary_edges) remarks.push_back(counted(boundary_edges, "boundary edge", "boundary edges"));
  if (non_manifold_edges) remarks.push_back(counted(non_manifold_edges, "non-manifold edge", "non-manifold edges"));
  if (misoriented_edges) remarks.push_back(counted(misoriented_edges, "misoriented edge", "misoriented edges"));
  if (inward) remarks.push_back("normals point inwards");
  return fmt::format(
      "{}{}{}{}", watertight() ? "watertight" : "not watertight", remarks.empty() ? "" : ": ", fmt::join(remarks, ", "),
      left_out ? fmt::format(" ({} without an area left out)", counted(left_out, "triangle", "triangles")) : "");
}

}  // namespace nextview
