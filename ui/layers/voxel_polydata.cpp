#include "ui/layers/voxel_polydata.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>

#include <numeric>

namespace nextview {
namespace {

vtkSmartPointer<vtkFloatArray> float_array(int components, vtkIdType tuples) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// Where the corners of a voxel's sides are from its lowest corner [voxels].
std::array<std::array<Eigen::Vector3f, 4>, 6> corners_by_side() {
  const VoxelGrid one{1.0, Eigen::Vector3i::Zero(), Eigen::Vector3i::Ones()};
  std::array<std::array<Eigen::Vector3f, 4>, 6> result;
  for (std::uint8_t side = 0; side < 6; ++side) {
    const auto corners = face_corners(one, {0, side});
    for (int corner = 0; corner < 4; ++corner) result[side][corner] = corners[corner].cast<float>();
  }
  return result;
}

}  // namespace

float packed_corner(const VoxelFace& face, int corner) {
  return static_cast<float>(corner + 4 * (face.side + 8 * face.occlusion));
}

vtkSmartPointer<vtkPolyData> voxel_polydata(const VoxelGrid& grid, std::span<const VoxelFace> faces) {
  const auto vertices = vtkIdType(faces.size()) * 4;
  const auto positions = float_array(3, vertices), corners = float_array(1, vertices);
  corners->SetName("voxel_corner");
  const auto offsets = corners_by_side();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faces.size(), faces_per_task), [&](const auto& range) {
    float* position = positions->GetPointer(vtkIdType(range.begin()) * 12);
    float* packed = corners->GetPointer(vtkIdType(range.begin()) * 4);
    for (std::size_t f = range.begin(); f < range.end(); ++f) {
      const Eigen::Vector3f lowest = (grid.first + grid.cell(faces[f].voxel)).cast<float>();
      for (int corner = 0; corner < 4; ++corner) {
        const Eigen::Vector3f lattice = lowest + offsets[faces[f].side][corner];  // whole numbers: no rounding yet
        for (int axis = 0; axis < 3; ++axis) *position++ = float(double(lattice[axis]) * grid.resolution);
        *packed++ = packed_corner(faces[f], corner);
      }
    }
  });
  vtkNew<vtkTypeInt32Array> connectivity;
  connectivity->SetNumberOfValues(vertices);
  std::iota(connectivity->GetPointer(0), connectivity->GetPointer(0) + vertices, 0);
  vtkNew<vtkCellArray> quads;
  quads->SetData(4, connectivity);
  vtkNew<vtkPoints> points;
  points->SetData(positions);
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(quads);
  result->GetPointData()->AddArray(corners);
  return result;
}

}  // namespace nextview
