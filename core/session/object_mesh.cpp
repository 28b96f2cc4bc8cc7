#include "core/session/object_mesh.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <stdexcept>

#include "core/cloud/ply_header.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/counted.hpp"
#include "core/file/gzip_file.hpp"
#include "core/file/lower_case.hpp"
#include "core/file/own_folder.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"
#include "core/mesh/file_claims.hpp"
#include "core/mesh/mesh_types.hpp"
#include "core/progress/stopped.hpp"
#include "core/recording/cloud_file.hpp"
#include "core/surface/cloud_surface.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// Enough of a file for its header.
std::string beginning(const fs::path& file) {
  if (file.extension() == ".gz") return read_gzip_file(file);
  const Descriptor descriptor = open_regular_file(file);
  std::string begin(1 << 16, '\0');
  const ssize_t got = ::read(descriptor.get(), begin.data(), begin.size());
  begin.resize(std::size_t(std::max<ssize_t>(0, got)));
  return begin;
}

/// Whether a PLY file has points alone. One that is damaged is for the mesh reader to refuse.
bool has_no_faces(const fs::path& file) try {
  const PlyHeader header = parse_ply_header(beginning(file));
  const auto has = [&](std::initializer_list<const char*> names) {
    return std::ranges::any_of(header.elements, [&](const PlyElement& element) {
      return element.count > 0 && std::ranges::find(names, element.name) != names.end();
    });
  };
  return has({"vertex"}) && !has({"face", "tristrips"});
} catch (const std::runtime_error&) {
  return false;
}

/// A compressed mesh, unpacked for its reader, which knows types by the endings of names.
PlacedMesh load_unpacked(const fs::path& file, const MeshFileOptions& options, const std::stop_token& stop) {
  const std::string bytes = read_gzip_file(file, options.largest_file);
  const OwnFolder folder;
  const fs::path unpacked = folder.path() / file.stem();
  write_file(unpacked, bytes);
  try {
    return load_placed_mesh(unpacked, options, stop);
  } catch (const std::runtime_error& error) {
    std::string message = error.what();
    if (const std::size_t at = message.find(unpacked.string()); at != message.npos)
      message.replace(at, unpacked.string().size(), file.string());
    throw std::runtime_error(message);
  }
}

PlacedMesh load_cloud(const fs::path& file, const MeshFileOptions& options, const std::stop_token& stop) {
  const auto [points, viewpoint, left_out] = read_cloud_file(file);
  try {
    const Surface surface = cloud_surface(points, {}, stop);
    throw_if_stopped(stop);
    if (surface.empty()) throw std::runtime_error(surface.why_empty);
    PlacedMesh placed = place_mesh(surface.mesh, options);
    placed.cloud_points = points.size();
    placed.cloud_left_out = left_out;
    return placed;
  } catch (const Stopped&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(fmt::format("{}: needs more memory than there is", printable(file.string())));
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: is a cloud of {}, and no surface can be made of it: {}",
                                         printable(file.string()), counted(points.size(), "point"), error.what()));
  }
}

}  // namespace

bool is_cloud(const fs::path& file) {
  const std::string extension = lower_case_extension(without_gz(file));
  return extension == ".pcd" || (extension == ".ply" && has_no_faces(file));
}

PlacedMesh load_object_mesh(const fs::path& file, const MeshFileOptions& options, const std::stop_token& stop) {
  if (is_cloud(file)) return load_cloud(file, options, stop);
  return file.extension() == ".gz" ? load_unpacked(file, options, stop) : load_placed_mesh(file, options, stop);
}

void require_whole_object(const fs::path& file) {
  constexpr std::uintmax_t most = 32u << 20;  // [bytes]: a text of so many takes a third of a second
  open_regular_file(file);
  const std::string extension = lower_case_extension(file);
  if (extension == ".gz" || fs::file_size(file) > most) return;
  if (is_cloud(file)) return static_cast<void>(read_cloud_file(file));
  if (!not_a_mesh_type(extension).empty()) return;  // a map, scans
  const std::string bytes = read_file(file, most);
  const std::string reason = bytes.empty() ? "is empty" : false_claim(extension, bytes);
  if (!reason.empty()) throw std::runtime_error(fmt::format("{}: {}", printable(file.string()), reason));
}

std::string cloud_note(const PlacedMesh& object) {
  if (object.cloud_points == 0) return "";
  return fmt::format("the object is a cloud of {}: the program's own surface of it is scanned ({})",
                     points_text(object.cloud_points, object.cloud_left_out),
                     counted(object.mesh.triangles.size(), "triangle"));
}

}  // namespace nextview
