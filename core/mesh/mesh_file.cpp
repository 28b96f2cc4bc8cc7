#include "core/mesh/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/mesh/file_claims.hpp"
#include "core/mesh/scene_import.hpp"
#include "core/mesh/weld.hpp"

namespace nextview {
namespace {

/// A part kept at its own size must be one that a camera with a range of metres can look at; beyond this the unit is
/// surely another.
constexpr double largest_own_size = 1000.0;  // [m]
/// Readers keep single precision. Its steps may be up to this share of the longest side (50 micrometres on half a
/// metre).
constexpr double coarsest_step = 1e-4;

std::string lower_case_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// Opening a pipe would wait for someone to write into it.
bool is_device(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_other(file, error);
}

/// Readers quote what they did not understand, line breaks and binary bytes included.
std::string one_line(std::string_view text) {
  std::string line(text.substr(0, std::min(text.find('\n'), std::size_t{200})));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return line.empty() ? "is not a file of its type" : line;
}

/// @throws std::runtime_error with the reason alone, as everything below does
void check_content(const std::string& extension, std::string_view bytes) {
  if (bytes.empty()) throw std::runtime_error("is empty");
  if (!has_reader(extension))
    throw std::runtime_error(
        fmt::format("'{}' is no known mesh file type; use ply, obj, stl, off, 3mf or gltf", extension));
  if (const std::string reason = false_claim(extension, bytes); !reason.empty()) throw std::runtime_error(reason);
}

bool has_area(const ImportedTriangles& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Eigen::Vector3d& origin = mesh.vertices[triangle[0]];
  return (mesh.vertices[triangle[1]] - origin).cross(mesh.vertices[triangle[2]] - origin).squaredNorm() > 0.0;
}

Eigen::AlignedBox3d box_of_triangles(const ImportedTriangles& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) box.extend(mesh.vertices[vertex]);
  return box;
}

void check_coordinates(const ImportedTriangles& mesh) {
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    if (!vertex.allFinite()) throw std::runtime_error("has coordinates that are not finite numbers");
}

/// @return the factor that gives the mesh the size asked for
double scale_for(const Eigen::AlignedBox3d& box, double longest_side) {
  const double longest = box.sizes().maxCoeff();
  const auto farthest = static_cast<float>(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()));
  const double step = std::nextafter(farthest, std::numeric_limits<float>::infinity()) - farthest;
  if (!(step <= coarsest_step * longest))
    throw std::runtime_error(
        fmt::format("its coordinates reach {:.3g} while its longest side is {:.3g}: single precision loses the shape; "
                    "move the object to the origin",
                    farthest, longest));
  if (longest_side > 0.0) return longest_side / longest;
  if (longest > largest_own_size)
    throw std::runtime_error(
        fmt::format("its longest side would be {:.3g} m, more than {} m; give a longest side to scale it to", longest,
                    largest_own_size));
  return 1.0;
}

/// Moves and scales in double precision, then joins vertices at the same place; only those in use remain.
TriangleMesh centred(const ImportedTriangles& imported, const MeshPlacement& placement) {
  std::vector<Eigen::Vector3f> scaled;
  scaled.reserve(imported.vertices.size());
  for (const Eigen::Vector3d& vertex : imported.vertices) scaled.push_back(placement(vertex).cast<float>());
  const std::vector<std::uint32_t> place = weld(scaled);

  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(scaled.size(), unused);
  TriangleMesh mesh;
  for (auto corners : imported.triangles) {
    const std::array<std::uint32_t, 3> at = {place[corners[0]], place[corners[1]], place[corners[2]]};
    if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) continue;
    for (int i = 0; i < 3; ++i) {
      if (number[at[i]] == unused) {
        number[at[i]] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(scaled[corners[i]]);
      }
      corners[i] = number[at[i]];
    }
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

PlacedMesh load(const std::filesystem::path& file, double longest_side) {
  ImportedTriangles imported = import_scene(file);
  check_coordinates(imported);
  if (imported.triangles.empty())
    throw std::runtime_error("has no faces; a surface is needed, not only points or lines");
  std::erase_if(imported.triangles, [&](const auto& triangle) { return !has_area(imported, triangle); });
  if (imported.triangles.empty()) throw std::runtime_error("has only degenerate triangles, none with an area");
  const Eigen::AlignedBox3d box = box_of_triangles(imported);
  const MeshPlacement placement{box.center(), scale_for(box, longest_side)};
  return {centred(imported, placement), placement};
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& file, const MeshFileOptions& options) {
  return load_placed_mesh(file, options).mesh;
}

PlacedMesh load_placed_mesh(const std::filesystem::path& file, const MeshFileOptions& options) {
  if (!(options.longest_side >= 0.0 && options.longest_side <= largest_own_size))
    throw std::invalid_argument(
        fmt::format("longest_side must lie between 0 (the file's own size) and {} m", largest_own_size));
  if (is_device(file)) throw std::runtime_error(fmt::format("{}: is a device or a pipe, not a file", file.string()));
  std::string bytes = read_file(file, options.largest_file);
  try {
    check_content(lower_case_extension(file), bytes);
    bytes = std::string();  // Assimp reads the file itself; no need to hold it twice.
    return load(file, options.longest_side);
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(fmt::format("{}: needs more memory than there is", file.string()));
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), one_line(error.what())));
  }
}

}  // namespace nextview
