#include "ui/layers/coarse_mesh.hpp"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace nextview {
namespace {

/// Of each point of the surface the number of the one that it becomes, in the order of their first appearance.
struct Clusters {
  std::vector<vtkIdType> of_point, first_points;

  Clusters(vtkPolyData& surface, int cells) {
    double bounds[6];
    surface.GetBounds(bounds);
    const Eigen::Vector3d low(bounds[0], bounds[2], bounds[4]), high(bounds[1], bounds[3], bounds[5]);
    const double edge = std::max((high - low).maxCoeff() / cells, 1e-12);
    const Eigen::Vector3i size = ((high - low) / edge).cast<int>() + Eigen::Vector3i::Ones();
    std::vector<vtkIdType> number(std::size_t(size.x()) * size.y() * size.z() * 8, -1);
    vtkDataArray* normals = surface.GetPointData()->GetNormals();
    of_point.resize(std::size_t(surface.GetNumberOfPoints()));
    for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
      Eigen::Vector3d place, normal = Eigen::Vector3d::Zero();
      surface.GetPoint(i, place.data());
      if (normals) normals->GetTuple(i, normal.data());
      const Eigen::Vector3i cell = ((place - low) / edge).cast<int>().cwiseMin(size - Eigen::Vector3i::Ones());
      const int side = int(normal.x() < 0) + 2 * int(normal.y() < 0) + 4 * int(normal.z() < 0);
      const std::size_t key =
          8 * (std::size_t(cell.x()) + size.x() * (std::size_t(cell.y()) + size.y() * std::size_t(cell.z()))) + side;
      if (number[key] < 0) {
        number[key] = vtkIdType(first_points.size());
        first_points.push_back(i);
      }
      of_point[std::size_t(i)] = number[key];
    }
  }
};

}  // namespace

vtkSmartPointer<vtkPolyData> coarse(vtkPolyData& surface, int cells) {
  const Clusters clusters(surface, cells);
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(vtkIdType(clusters.first_points.size()));
  result->GetPointData()->CopyAllOn();
  result->GetPointData()->CopyAllocate(surface.GetPointData(), points->GetNumberOfPoints());
  for (std::size_t i = 0; i < clusters.first_points.size(); ++i) {
    points->SetPoint(vtkIdType(i), surface.GetPoint(clusters.first_points[i]));
    result->GetPointData()->CopyData(surface.GetPointData(), clusters.first_points[i], vtkIdType(i));
  }
  vtkNew<vtkCellArray> triangles;
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  for (surface.GetPolys()->InitTraversal(); surface.GetPolys()->GetNextCell(count, corners);) {
    if (count != 3) continue;
    const vtkIdType a = clusters.of_point[std::size_t(corners[0])], b = clusters.of_point[std::size_t(corners[1])],
                    c = clusters.of_point[std::size_t(corners[2])];
    if (a != b && b != c && c != a) triangles->InsertNextCell({a, b, c});
  }
  result->SetPoints(points);
  result->SetPolys(triangles);
  return result;
}

}  // namespace nextview
