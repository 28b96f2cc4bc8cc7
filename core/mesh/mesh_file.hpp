#pragma once
#include <filesystem>
#include <stop_token>

#include "core/mesh/triangle_mesh.hpp"
#include "core/view/length_unit.hpp"
#include "core/view/up_axis.hpp"

namespace nextview {

struct MeshFileOptions {
  /// Longest side of the bounding box after scaling [m]; 0 keeps the file's own size.
  double longest_side = 0.5;
  LengthUnit unit = LengthUnit::automatic;  ///< of the file's coordinates, where its own size is kept
  UpAxis up = UpAxis::automatic;            ///< of the file's coordinates
  bool centred = true;  ///< the bounding box has its centre in the origin; else the file's origin stays where it is
  bool ground = false;  ///< PlacedMesh::on_ground
  std::uintmax_t largest_file = 1u << 30;  ///< of all files of a mesh together; beyond it is refused [bytes]

  bool operator==(const MeshFileOptions&) const = default;
};

/// How load_mesh moves, turns and scales a file's coordinates: what else is known in them, such as openings, goes the
/// same way.
struct MeshPlacement {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< becomes the origin [file's units]
  double scale = 1.0;                                ///< over 0 [m per file's unit]
  UpAxis up = UpAxis::z;                             ///< of the file

  Eigen::Vector3d operator()(const Eigen::Vector3d& point) const { return with_z_up(up, (point - centre) * scale); }
};

/// Where a part that was centred had its middle, for people; empty if that was the origin to a thousandth of its size.
/// "its middle was at 40, 25, 30 mm and is the origin now" @param longest its longest side [m]
std::string centring_text(const MeshPlacement& placement, double longest);

struct PlacedMesh {
  TriangleMesh mesh;
  MeshPlacement placement;
  MeshTopology topology;                    ///< of the file's triangles as they come, those without an area included
  LengthUnit unit = LengthUnit::automatic;  ///< what the coordinates were taken for; automatic: scaled, whatever it is
  bool is_unit_guessed = false;             ///< by its size: neither the file nor who loads it says the unit
  bool on_ground = false;          ///< it stands on a horizontal plane that a camera sees, which is no part of it
  std::size_t cloud_points = 0;    ///< of a file that is a cloud, of which the mesh is a surface; 0: it is a mesh
  std::size_t cloud_left_out = 0;  ///< of it, that are not finite

  /// What a camera sees: the mesh and, behind its triangles, the ground.
  TriangleMesh surroundings() const;
};

/// Reads PLY, OBJ, STL, OFF, 3MF, AMF, glTF, DAE, FBX, 3DS and X3D; all of a scene's meshes become one. Triangles
/// without an area, or that scaling to single precision folds, are left out. Besides the file only those that a glTF
/// names are read: regular files beside it or in folders below. Who reads it is confined (import_scene).
/// @throws std::runtime_error with one line that names the file and the reason: missing, empty, unreadable, truncated,
///         without faces, not finite, absurdly large coordinates, over the size limit, more memory or time than its
///         size explains.
/// @throws Stopped
TriangleMesh load_mesh(const std::filesystem::path& file, const MeshFileOptions& options = {},
                       std::stop_token stop = {});
/// A mesh in a file's coordinates, placed as load_placed_mesh places a file's own.
/// @throws std::runtime_error with the reason alone: no area, absurdly large coordinates
PlacedMesh place_mesh(const TriangleMesh& in_file_units, const MeshFileOptions& options);
/// As load_mesh, how its coordinates came out of the file's, and how its triangles joined in the file.
PlacedMesh load_placed_mesh(const std::filesystem::path& file, const MeshFileOptions& options = {},
                            std::stop_token stop = {});

}  // namespace nextview
