#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "core/mesh/parts.hpp"

namespace nextview {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY files are written as the numbers lie in memory");

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

std::string json(const Eigen::Vector3d& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

std::string json(const Opening& opening) {
  return fmt::format(
      R"({{"kind": "{}", "width": {}, "length": {}, "depth": {}, "centre": {}, "axis": {}, "along": {}}})",
      opening.kind == Opening::Kind::slot ? "slot" : "bore", opening.width, opening.length, opening.depth,
      json(opening.centre), json(opening.axis), json(opening.along));
}

}  // namespace

std::string openings_json(const Part& part) {
  std::vector<std::string> openings;
  for (const Opening& opening : part.openings) openings.push_back("    " + json(opening));
  return fmt::format(
      "{{\n  \"mesh\": \"{}.ply\",\n  \"unit\": \"m\",\n  \"frame\": \"of the mesh, origin in the centre of its "
      "bounding box\",\n"
      "  \"bore_corners\": {},\n  \"openings\": [\n{}\n  ]\n}}\n",
      part.name, bore_corners, fmt::join(openings, ",\n"));
}

std::string ply_bytes(const TriangleMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const Eigen::Vector3f& vertex : mesh.vertices) append(bytes, vertex.data(), 3);
  for (const auto& triangle : mesh.triangles) {
    bytes.push_back(3);
    append(bytes, triangle.data(), 3);
  }
  return bytes;
}

}  // namespace nextview
