#include "core/surface/isosurface.hpp"

#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <stdexcept>

#include "core/surface/vtk_mesh.hpp"

namespace nextview {

TriangleMesh isosurface(const ScalarField& field, float level) {
  if ((field.size.array() < 0).any() || field.values.size() != field.point_count())
    throw std::invalid_argument("isosurface: the field's values are not as many as its points");
  if (field.values.empty()) return {};
  vtkNew<vtkFloatArray> values;
  values->SetArray(const_cast<float*>(field.values.data()), vtkIdType(field.values.size()), 1);  // only read
  vtkNew<vtkImageData> image;
  image->SetDimensions(field.size.x(), field.size.y(), field.size.z());
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> marching_cubes;
  marching_cubes->SetInputData(image);
  marching_cubes->SetValue(0, level);
  marching_cubes->ComputeNormalsOff();
  marching_cubes->ComputeScalarsOff();
  marching_cubes->Update();

  TriangleMesh mesh = to_mesh(*marching_cubes->GetOutput());
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex = (field.origin + field.spacing * vertex.cast<double>()).cast<float>();
  return mesh;
}

}  // namespace nextview
