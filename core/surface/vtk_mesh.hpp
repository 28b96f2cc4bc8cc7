#pragma once
#include "core/mesh/triangle_mesh.hpp"

class vtkPolyData;

namespace nextview {

/// The triangles of a VTK surface.
TriangleMesh to_mesh(vtkPolyData& polydata);

}  // namespace nextview
