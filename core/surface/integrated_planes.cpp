#include "core/surface/integrated_planes.hpp"

#include <vtkExtractSurface.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSignedDistance.h>

#include "core/mesh/weld.hpp"
#include "core/surface/vtk_mesh.hpp"
#include "core/view/pose.hpp"

namespace nextview {
namespace {

constexpr double reach = 2.0;  ///< of a point's plane [cells]

}  // namespace

TriangleMesh integrated_planes(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
                               double cell) {
  vtkNew<vtkPoints> positions;
  vtkNew<vtkFloatArray> directions;
  directions->SetNumberOfComponents(3);
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < points.size(); ++i) {
    positions->InsertNextPoint(points[i].data());
    directions->InsertNextTuple(normals[i].data());
    box.extend(points[i].cast<double>());
  }
  vtkNew<vtkPolyData> input;
  input->SetPoints(positions);
  input->GetPointData()->SetNormals(directions);

  // VTK marks points out of reach with the radius in single precision and looks for it in double.
  const double radius = static_cast<float>(reach * cell);
  const Vector3 lower = box.min() - Vector3::Constant(integration_margin * cell);
  const Eigen::Vector3i size = ((box.sizes() / cell).array() + 2.0 * integration_margin + 2.0).cast<int>();
  const Vector3 upper = lower + cell * (size - Eigen::Vector3i::Ones()).cast<double>();
  vtkNew<vtkSignedDistance> distance;
  distance->SetInputData(input);
  distance->SetRadius(radius);
  distance->SetBounds(lower.x(), upper.x(), lower.y(), upper.y(), lower.z(), upper.z());
  distance->SetDimensions(size.x(), size.y(), size.z());
  vtkNew<vtkExtractSurface> zero;
  zero->SetInputConnection(distance->GetOutputPort());
  zero->SetRadius(radius);
  zero->HoleFillingOff();
  zero->ComputeNormalsOff();
  zero->Update();
  return welded(to_mesh(*zero->GetOutput()));
}

}  // namespace nextview
