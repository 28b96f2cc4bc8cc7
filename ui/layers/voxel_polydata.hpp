#pragma once
#include <vtkSmartPointer.h>

#include "ui/layers/voxel_faces.hpp"

class vtkFloatArray;
class vtkPolyData;

namespace nextview {

/// One quad a face, corners as in face_corners. The vertex attribute "voxel_corner" packs corner, side and occlusion
/// for shaders/voxels_vertex.glsl; normals follow from it.
vtkSmartPointer<vtkPolyData> voxel_polydata(const VoxelGrid& grid, std::span<const VoxelFace> faces);

/// What a task takes of a list of faces: enough to outweigh starting it.
inline constexpr std::size_t faces_per_task = 4096;

/// What the vertex attribute "voxel_corner" holds.
float packed_corner(const VoxelFace& face, int corner);

}  // namespace nextview
