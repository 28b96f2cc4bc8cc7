#include "core/mesh/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/lower_case.hpp"
#include "core/file/printable.hpp"
#include "core/mesh/file_claims.hpp"
#include "core/mesh/mesh_types.hpp"
#include "core/mesh/scene_import.hpp"
#include "core/mesh/weld.hpp"
#include "core/progress/stopped.hpp"
#include "core/view/length_unit.hpp"

namespace nextview {
namespace {

/// A part kept at its own size must be one that a camera with a range of metres can look at; beyond this the unit is
/// surely another.
constexpr double largest_own_size = 1000.0;  // [m]
/// Readers keep single precision. Its steps may be up to this share of the longest side (50 micrometres on half a
/// metre).
constexpr double coarsest_step = 1e-4;

/// Opening a pipe would wait for someone to write into it; and a link to itself is no missing file.
void check_kind(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::none) throw std::runtime_error("cannot be read: " + error.message());
  if (std::filesystem::is_other(status)) throw std::runtime_error("is a device or a pipe, not a file");
}

/// Readers quote what they did not understand, however long it is.
std::string one_line(std::string_view text) {
  constexpr std::size_t longest = 200;
  std::string line = printable(text.substr(0, longest));
  if (text.size() > longest) line += " …";
  return line.empty() ? "is not a file of its type" : line;
}

/// @throws std::runtime_error with the reason alone, as everything below does
void check_content(const std::string& extension, std::string_view bytes) {
  if (bytes.empty()) throw std::runtime_error("is empty");
  if (const std::string reason = not_a_mesh_type(extension); !reason.empty()) throw std::runtime_error(reason);
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
  const auto is_wrong = [](const Eigen::Vector3d& vertex) { return !vertex.allFinite(); };
  if (const auto wrong = std::ranges::count_if(mesh.vertices, is_wrong); wrong > 0)
    throw std::runtime_error(fmt::format(
        "has coordinates that are not finite numbers, in {} of {}: delete these in a mesh editor, close the "
        "holes that they leave, and save it again",
        wrong, counted(mesh.vertices.size(), "vertex", "vertices")));
}

/// What a type of file says that its unit is where the file does not, as its specification has it or its reader
/// delivers it.
LengthUnit unit_of_type(const std::string& extension) {
  const auto is = [&](std::initializer_list<std::string_view> those) { return std::ranges::count(those, extension); };
  if (is({".gltf", ".glb", ".dae", ".x3d"})) return LengthUnit::metres;
  if (is({".3mf", ".amf"})) return LengthUnit::millimetres;
  if (is({".fbx"})) return LengthUnit::centimetres;
  return LengthUnit::automatic;
}

/// automatic if nothing says it.
LengthUnit unit_said(LengthUnit asked, LengthUnit declared, const std::string& extension) {
  if (asked == LengthUnit::automatic) asked = declared;
  return asked == LengthUnit::automatic ? unit_of_type(extension) : asked;
}

LengthUnit unit_guessed(double longest) {
  constexpr double longest_in_metres = 10.0;
  return longest > longest_in_metres ? LengthUnit::millimetres : LengthUnit::metres;
}

/// @throws std::runtime_error if single precision, which readers keep, loses the shape
void check_precision(const Eigen::AlignedBox3d& box) {
  const double longest = box.sizes().maxCoeff();
  const auto farthest = static_cast<float>(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()));
  const double step = std::nextafter(farthest, std::numeric_limits<float>::infinity()) - farthest;
  if (!(step <= coarsest_step * longest))
    throw std::runtime_error(
        fmt::format("its coordinates reach {:.3g} while its longest side is {:.3g}: single precision loses the shape; "
                    "move the object to the origin",
                    farthest, longest));
}

/// Who wants the file's own axes asks for z.
UpAxis up_taken(UpAxis asked, const std::string& extension) {
  if (asked != UpAxis::automatic) return asked;
  return extension == ".gltf" || extension == ".glb" || extension == ".x3d" ? UpAxis::y : UpAxis::z;
}

/// Metres per unit at its own size.
double own_scale(double longest, LengthUnit unit) {
  if (longest * metres_per(unit) > largest_own_size)
    throw std::runtime_error(fmt::format(
        "its longest side would be {:.3g} m, more than {} m; give a longest side to scale it to, or its unit",
        longest * metres_per(unit), largest_own_size));
  return metres_per(unit);
}

/// Moves and scales in double precision, then joins vertices at the same place; only those in use remain.
TriangleMesh moved(const ImportedTriangles& imported, const MeshPlacement& placement) {
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

/// As the file has it: before anything is left out, and in the file's own numbers, which scaling rounds.
MeshTopology topology_of(const ImportedTriangles& imported) {
  TriangleMesh mesh;
  mesh.vertices.reserve(imported.vertices.size());
  for (const Eigen::Vector3d& vertex : imported.vertices) mesh.vertices.push_back(vertex.cast<float>());
  mesh.triangles = imported.triangles;
  return topology(mesh);
}

PlacedMesh placed(ImportedTriangles imported, const MeshFileOptions& options, const std::string& extension) {
  check_coordinates(imported);
  if (imported.triangles.empty())
    throw std::runtime_error("has no faces; a surface is needed, not only points or lines");
  MeshTopology topology = topology_of(imported);
  const std::size_t all = imported.triangles.size();
  std::erase_if(imported.triangles, [&](const auto& triangle) { return !has_area(imported, triangle); });
  if (imported.triangles.empty()) throw std::runtime_error("has only degenerate triangles, none with an area");
  const Eigen::AlignedBox3d box = box_of_triangles(imported);
  check_precision(box);
  const double longest = box.sizes().maxCoeff();
  const bool scaled = options.longest_side > 0.0;
  const LengthUnit said = unit_said(options.unit, imported.unit, extension);
  const bool is_guessed = !scaled && said == LengthUnit::automatic;
  const LengthUnit unit = is_guessed ? unit_guessed(longest) : scaled ? LengthUnit::automatic : said;
  const MeshPlacement placement{options.centred ? box.center() : Eigen::Vector3d::Zero().eval(),
                                scaled ? options.longest_side / longest : own_scale(longest, unit),
                                up_taken(options.up, extension)};
  TriangleMesh mesh = moved(imported, placement);
  topology.left_out = all - mesh.triangles.size();
  return {std::move(mesh), placement, topology, unit, is_guessed, options.ground, 0, 0};
}

}  // namespace

TriangleMesh PlacedMesh::surroundings() const {
  constexpr float far = 1000.0f;  // as far as any camera sees [m]
  TriangleMesh all = mesh;
  if (!on_ground || mesh.vertices.empty()) return all;
  const Eigen::AlignedBox3d box = mesh.bounding_box();
  const Eigen::Vector3f below(float(box.center().x()), float(box.center().y()), float(box.min().z()));
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  for (const float y : {-far, far})
    for (const float x : {-far, far}) all.vertices.push_back(below + Eigen::Vector3f(x, y, 0.0f));
  all.triangles.push_back({first, first + 1, first + 3});
  all.triangles.push_back({first, first + 3, first + 2});
  return all;
}

std::string centring_text(const MeshPlacement& placement, double longest) {
  const Eigen::Vector3d was = with_z_up(placement.up, placement.centre * placement.scale);
  if (was.cwiseAbs().maxCoeff() <= 1e-3 * longest) return "";
  const double scale = longest < 1.0 ? 1e3 : 1.0;
  return fmt::format("its middle was at {:.4g}, {:.4g}, {:.4g} {} and is the origin now", scale * was.x(),
                     scale * was.y(), scale * was.z(), scale > 1.0 ? "mm" : "m");
}

PlacedMesh place_mesh(const TriangleMesh& in_file_units, const MeshFileOptions& options) {
  ImportedTriangles triangles;
  for (const Eigen::Vector3f& vertex : in_file_units.vertices) triangles.vertices.push_back(vertex.cast<double>());
  triangles.triangles = in_file_units.triangles;
  return placed(std::move(triangles), options, "");
}

TriangleMesh load_mesh(const std::filesystem::path& file, const MeshFileOptions& options, std::stop_token stop) {
  return load_placed_mesh(file, options, std::move(stop)).mesh;
}

PlacedMesh load_placed_mesh(const std::filesystem::path& file, const MeshFileOptions& options, std::stop_token stop) {
  if (!(options.longest_side >= 0.0 && options.longest_side <= largest_own_size))
    throw std::invalid_argument(
        fmt::format("longest_side must lie between 0 (the file's own size) and {} m", largest_own_size));
  const std::string name = printable(file.string());
  try {
    check_kind(file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", name, error.what()));
  }
  MeshBytes mesh{lower_case_extension(file), read_file(file, options.largest_file), file.parent_path()};
  try {
    check_content(mesh.extension, mesh.bytes);
    const ReadingLimits limits = reading_limits(mesh.extension, mesh.bytes.size(), options.largest_file);
    const std::string extension = mesh.extension;
    return placed(import_scene(std::move(mesh), limits, stop), options, extension);
  } catch (const Stopped&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(fmt::format("{}: needs more memory than there is", name));
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", name, one_line(error.what())));
  }
}

}  // namespace nextview
