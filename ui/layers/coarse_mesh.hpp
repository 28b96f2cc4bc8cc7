#pragma once
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace nextview {

/// The triangles of a surface with point normals, as seen from far away: points in the same of `cells` cells along the
/// longest side, whose normals have the same signs, become the first of them, with its data; triangles that vanish so
/// are left out. Closed surfaces stay closed.
vtkSmartPointer<vtkPolyData> coarse(vtkPolyData& surface, int cells);

}  // namespace nextview
