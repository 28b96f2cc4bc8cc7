// The mesh that recorded scans are compared with.
#include <fmt/format.h>

#include <stdexcept>

#include "core/config/object_lengths.hpp"
#include "core/session/object_mesh.hpp"
#include "core/session/recording_setup.hpp"
#include "core/setting/length_text.hpp"

namespace nextview {

std::string alignment_note(const Alignment& alignment, const std::string& mesh_name, const PointCloud& scanned,
                           const TriangleMesh& mesh) {
  constexpr double doubtful = 0.9;
  constexpr double far_longer = 4.0;  // than the scans: more of an object than a few scans leave out
  std::string note = fmt::format("{:.0f} % of its points lie on {}, {} from it (root mean square)",
                                 100.0 * alignment.overlap, mesh_name, length_text(alignment.residual));
  const auto longest = [&](const auto& points) {  // along the axes that the mesh has in its file
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3f& p : points) box.extend(alignment.T_surface_cloud * p.cast<double>());
    return box.sizes().maxCoeff();
  };
  const double scans = longest(scanned), whole = longest(mesh.vertices);
  if (alignment.overlap >= doubtful && whole <= far_longer * scans) return note;
  return note + fmt::format(
                    "; is it the same object? The scans are {} long, the mesh {}: object.unit or "
                    "object.longest_side sets its size",
                    length_text(scans), length_text(whole));
}

AlignedTruth aligned_truth(const Configuration& c, const PointCloud& scanned, const std::stop_token& stop) {
  AlignedTruth truth{resolve_object(c.recorded.truth), nullptr, {}};
  ObjectConfig as_it_stands = c.object;
  as_it_stands.centred = false;
  if (as_it_stands.up == UpAxis::automatic) as_it_stands.up = UpAxis::z;  // as the scans, whatever they call up
  auto placed = std::make_shared<PlacedMesh>(load_object_mesh(truth.file, placement(as_it_stands, truth.file), stop));
  try {
    truth.alignment = align(scanned, placed->mesh, stop);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", c.recorded.folder, error.what()));
  }
  const Pose T_scans_mesh = truth.alignment.T_surface_cloud.inverse();
  for (Eigen::Vector3f& vertex : placed->mesh.vertices) vertex = (T_scans_mesh * vertex.cast<double>()).cast<float>();
  truth.placed = std::move(placed);
  return truth;
}

}  // namespace nextview
