#include "ui/layers/geometry.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <numeric>

namespace nextview {
namespace {

vtkNew<vtkPoints> vtk_points(std::span<const Eigen::Vector3f> points) {
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) coordinates->SetTypedTuple(vtkIdType(i), points[i].data());
  vtkNew<vtkPoints> result;
  result->SetData(coordinates);
  return result;
}

}  // namespace

std::uint32_t Geometry::add_point(const Eigen::Vector3d& point) {
  points_.push_back(point.cast<float>());
  return static_cast<std::uint32_t>(points_.size() - 1);
}

void Geometry::add_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Colour& colour, double opacity) {
  lines_.push_back({{add_point(from), add_point(to)}, colour, opacity});
}

void Geometry::add_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                            const Colour& colour) {
  triangles_.push_back({{add_point(a), add_point(b), add_point(c)}, colour, 1.0});
}

vtkSmartPointer<vtkPolyData> Geometry::polydata() const {
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(4);
  const auto cells = [&](const std::vector<Cell>& source) {
    vtkNew<vtkCellArray> result;
    for (const Cell& cell : source) {
      result->InsertNextCell(int(cell.points.size()));
      for (const std::uint32_t point : cell.points) result->InsertCellPoint(point);
      for (const double channel : {cell.colour[0], cell.colour[1], cell.colour[2], cell.opacity}) {
        colours->InsertNextValue(static_cast<unsigned char>(std::lround(channel * 255)));
      }
    }
    return result;
  };
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(vtk_points(points_));
  result->SetLines(cells(lines_));  // VTK numbers a polydata's cells lines first, then triangles
  result->SetPolys(cells(triangles_));
  result->GetCellData()->SetScalars(colours);
  return result;
}

vtkSmartPointer<vtkFloatArray> float_vectors(std::span<const Eigen::Vector3f> vectors) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(vtkIdType(vectors.size()));
  for (std::size_t i = 0; i < vectors.size(); ++i) array->SetTypedTuple(vtkIdType(i), vectors[i].data());
  return array;
}

vtkSmartPointer<vtkPolyData> triangle_polydata(const TriangleMesh& mesh) {
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateEstimate(vtkIdType(mesh.triangles.size()), 3);
  for (const auto& triangle : mesh.triangles) triangles->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(vtk_points(mesh.vertices));
  result->SetPolys(triangles);
  return result;
}

vtkSmartPointer<vtkPolyData> point_polydata(std::span<const Eigen::Vector3f> points) {
  vtkNew<vtkCellArray> vertices;
  std::vector<vtkIdType> ids(points.size());
  std::iota(ids.begin(), ids.end(), 0);
  if (!ids.empty()) vertices->InsertNextCell(vtkIdType(ids.size()), ids.data());
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(vtk_points(points));
  result->SetVerts(vertices);
  return result;
}

}  // namespace nextview
