#include "core/surface/vtk_mesh.hpp"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkPolyData.h>

namespace nextview {

TriangleMesh to_mesh(vtkPolyData& polydata) {
  TriangleMesh mesh;
  mesh.vertices.reserve(polydata.GetNumberOfPoints());
  for (vtkIdType v = 0; v < polydata.GetNumberOfPoints(); ++v)
    mesh.vertices.push_back(Eigen::Map<const Eigen::Vector3d>(polydata.GetPoint(v)).cast<float>());
  const auto cells = vtk::TakeSmartPointer(polydata.GetPolys()->NewIterator());
  mesh.triangles.reserve(polydata.GetNumberOfPolys());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell()) {
    vtkIdType count;
    const vtkIdType* corners;
    cells->GetCurrentCell(count, corners);
    mesh.triangles.push_back({std::uint32_t(corners[0]), std::uint32_t(corners[1]), std::uint32_t(corners[2])});
  }
  return mesh;
}

}  // namespace nextview
