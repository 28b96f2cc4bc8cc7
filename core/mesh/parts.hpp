#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/mesh/mesh_file.hpp"
#include "core/mesh/triangle_mesh.hpp"

namespace nextview {

/// A straight hole through a wall, known exactly. Lengths in metres, in the frame of the part's mesh.
struct Opening {
  enum class Kind { slot, bore };
  Kind kind = Kind::slot;
  double width = 0.0;      ///< slot: its shorter side; bore: the diameter of the circle through its corners [m]
  double length = 0.0;     ///< slot: its longer side; bore: its width [m]
  double depth = 0.0;      ///< the wall's thickness [m]
  Eigen::Vector3d centre;  ///< halfway through the wall [m]
  Eigen::Vector3d axis;    ///< unit, the way through
  Eigen::Vector3d along;   ///< unit, the direction of `length`; bore: towards one of its corners
};

/// Bores are regular polygons with this many corners on their circle.
inline constexpr int bore_corners = 64;

/// A part of our own, whose shape is known exactly: watertight, longest side 0.5 m, bounding box centred in the origin.
struct Part {
  std::string name;  ///< also of its files: assets/objects/<name>.ply and, with openings, <name>.json
  TriangleMesh mesh;
  std::vector<Opening> openings;
};

/// A plate 30 mm thick with slots and bores 10, 20, 30 and 40 mm wide: 1 to 4 voxels of 1 cm, none of them aligned with
/// the voxels.
Part slotted_plate();
/// A box open at the top, walls 20 mm thick, with slots of the same widths in one long wall and bores in the other.
Part slotted_housing();
/// An icosahedron, each triangle divided in four five times; corners on a sphere of radius 0.25 m.
Part sphere_part();
Part box_part();

/// The openings as JSON text: unit, frame, and for each opening the fields of Opening.
std::string openings_json(const Part& part);
/// Reads what openings_json wrote; the frame stays that of the mesh file beside it.
/// @throws std::runtime_error with one line that names the file, the opening's number from 0 and the reason: missing,
/// no
///         JSON, truncated, another unit than m, a field missing or of the wrong type, a length not over 0, a number
///         beyond 1000, directions not of unit length or not at right angles.
std::vector<Opening> read_openings(const std::filesystem::path& file);
/// The opening where load_placed_mesh put its mesh.
Opening placed(const Opening& opening, const MeshPlacement& placement);
/// The mesh as a binary little-endian PLY.
std::string ply_bytes(const TriangleMesh& mesh);

}  // namespace nextview
