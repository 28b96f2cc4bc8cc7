#include "core/surface/surface_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/surface/seen_part.hpp"

namespace nextview {
namespace {

static_assert(std::endian::native == std::endian::little, "STL and PLY are written as the numbers lie in memory");

using Rgb = std::array<std::uint8_t, 3>;

constexpr Rgb not_seen_colour = {160, 160, 160};

/// Anchors of the uncertainty's colours, evenly spaced: dark blue, blue, teal, green, yellow, their lightness rising
/// evenly (CIE L* 16, 35, 53, 71, 91), so that equal steps look equal, in grey print too.
constexpr std::array<Rgb, 5> ramp = {{{45, 26, 90}, {44, 84, 123}, {32, 140, 137}, {106, 193, 111}, {248, 231, 80}}};

Rgb ramp_colour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * double(ramp.size() - 1);
  const std::size_t lower = std::min(std::size_t(at), ramp.size() - 2);
  Rgb colour;
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] =
        static_cast<std::uint8_t>(std::lround(std::lerp(ramp[lower][c], ramp[lower + 1][c], at - double(lower))));
  return colour;
}

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

void check(const TriangleMesh& mesh, float scale) {
  if (mesh.triangles.empty()) throw std::invalid_argument("surface file: the surface has no triangles");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!(scale * mesh.vertices[i]).allFinite())
      throw std::invalid_argument(fmt::format("surface file: vertex {} is not finite", i));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t vertex : mesh.triangles[t])
      if (vertex >= mesh.vertices.size())
        throw std::invalid_argument(fmt::format("surface file: triangle {} names vertex {}, but there are only {}", t,
                                                vertex, mesh.vertices.size()));
}

void check(const Surface& surface) {
  check(surface.mesh, 1.0f);
  const std::size_t vertices = surface.mesh.vertices.size();
  if (surface.uncertainty.size() != vertices || surface.seen.size() != vertices)
    throw std::invalid_argument(fmt::format("surface file: {} vertices, but {} uncertainties and {} marks of seen",
                                            vertices, surface.uncertainty.size(), surface.seen.size()));
  for (std::size_t i = 0; i < vertices; ++i)
    if (!(std::isfinite(surface.uncertainty[i]) && surface.uncertainty[i] >= 0.0f))
      throw std::invalid_argument(
          fmt::format("surface file: the uncertainty of vertex {} is {} m", i, surface.uncertainty[i]));
}

/// The smallest uncertainty that at least 95 % of the seen vertices do not exceed [m]; 0 if none is seen.
float colours_end(const Surface& surface) {
  std::vector<float> seen;
  for (std::size_t i = 0; i < surface.seen.size(); ++i)
    if (surface.seen[i]) seen.push_back(surface.uncertainty[i]);
  if (seen.empty()) return 0.0f;
  const auto rank = seen.begin() + static_cast<std::ptrdiff_t>((95 * seen.size() + 99) / 100 - 1);
  std::nth_element(seen.begin(), rank, seen.end());
  return *rank;
}

std::string ply_header(const Surface& surface, float end) {
  const SeenArea area = seen_area(surface);
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "comment reconstructed surface, nextview; unit m\n"
      "comment uncertainty: how far the surface may lie off along its normal [m]\n"
      "comment seen: 1 measured, 0 closes the surface where no view has looked\n"
      "comment seen of the area: {}, {:.4g} of {:.4g} m^2\n"
      "comment colour: uncertainty from 0 m (dark blue) to {:g} m and more (yellow); grey: not seen\n"
      "element vertex {}\nproperty uchar seen\n"  // not x: a first byte of 10 makes Assimp skip it as a line end
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float uncertainty\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      area.percent_seen(), area.seen, area.seen + area.unseen, end, surface.mesh.vertices.size(),
      surface.mesh.triangles.size());
}

}  // namespace

void write_stl(const TriangleMesh& mesh, const std::filesystem::path& file, std::string_view remark) {
  constexpr float millimetres = 1e3f;
  check(mesh, millimetres);
  constexpr std::size_t head = 80, bytes_a_facet = 50;
  std::string bytes = "nextview, unit mm";  // not 'solid': that begins the text format
  if (!remark.empty()) bytes += fmt::format("; {}", remark.substr(0, 40));
  std::uint32_t count = 0;
  bytes.reserve(head + sizeof count + bytes_a_facet * mesh.triangles.size());  // growing, it would be there twice
  bytes.resize(head + sizeof count, '\0');
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<Eigen::Vector3f, 3> corners = {millimetres * mesh.vertices[a], millimetres * mesh.vertices[b],
                                                    millimetres * mesh.vertices[c]};
    const Eigen::Vector3d origin = corners[0].cast<double>();
    const Eigen::Vector3d across = (corners[1].cast<double>() - origin).cross(corners[2].cast<double>() - origin);
    if (across.isZero(0.0)) continue;
    const Eigen::Vector3f normal = across.stableNormalized().cast<float>();
    append(bytes, normal.data(), 3);
    for (const Eigen::Vector3f& corner : corners) append(bytes, corner.data(), 3);
    bytes.append(2, '\0');  // attribute byte count
    ++count;
  }
  if (count == 0) throw std::invalid_argument("surface file: no triangle of the surface has an area");
  std::memcpy(bytes.data() + head, &count, sizeof count);
  write_file(file, bytes);
}

void write_ply(const Surface& surface, const std::filesystem::path& file) {
  check(surface);
  const float end = colours_end(surface);
  constexpr std::size_t bytes_a_vertex = 20, bytes_a_face = 13;
  std::string bytes = ply_header(surface, end);
  bytes.reserve(bytes.size() + bytes_a_vertex * surface.mesh.vertices.size() +
                bytes_a_face * surface.mesh.triangles.size());
  for (std::size_t i = 0; i < surface.mesh.vertices.size(); ++i) {
    const float uncertainty = surface.uncertainty[i];
    const std::uint8_t seen = surface.seen[i] != 0;
    const Rgb colour = seen ? ramp_colour(end > 0.0f ? uncertainty / end : 0.0) : not_seen_colour;
    append(bytes, &seen, 1);
    append(bytes, surface.mesh.vertices[i].data(), 3);
    append(bytes, colour.data(), 3);
    append(bytes, &uncertainty, 1);
  }
  for (const auto& triangle : surface.mesh.triangles) {
    bytes.push_back(3);
    append(bytes, triangle.data(), 3);
  }
  write_file(file, bytes);
}

}  // namespace nextview
