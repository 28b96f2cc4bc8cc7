#include "ui/layers/shaded_mesh.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>

#include "core/random/counter_random.hpp"
#include "core/view/pose.hpp"
#include "ui/layers/geometry.hpp"

namespace nextview {
namespace {

constexpr double crease_angle = 35.0;  // [deg]

TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(float(i & 1), float(i >> 1 & 1), float(i >> 2));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// A sheet whose bumps are shallow here and steep there.
TriangleMesh bumps(std::uint32_t edge) {
  TriangleMesh mesh;
  for (std::uint32_t y = 0; y < edge; ++y)
    for (std::uint32_t x = 0; x < edge; ++x)
      mesh.vertices.emplace_back(float(x), float(y), float(CounterRandom(7, 905).uniform(y * edge + x)[0]) * 1.5f);
  for (std::uint32_t y = 0; y + 1 < edge; ++y)
    for (std::uint32_t x = 0; x + 1 < edge; ++x) {
      const std::uint32_t at = y * edge + x;
      mesh.triangles.push_back({at, at + 1, at + edge + 1});
      mesh.triangles.push_back({at, at + edge + 1, at + edge});
    }
  return mesh;
}

TEST(ShadedMesh, ACubeIsSharpAndFlat) {
  const TriangleMesh mesh = cube();
  const ShadedMesh result = shaded(mesh, crease_angle);
  EXPECT_EQ(result.vertices.size(), 24u);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t point = result.triangles[t][c];
      EXPECT_EQ(result.vertices[point], mesh.triangles[t][c]);
      EXPECT_FLOAT_EQ(result.normals[point].cwiseAbs().maxCoeff(), 1.0f);
    }
  EXPECT_EQ(shaded(mesh, 91.0).vertices.size(), 8u) << "no edge is steeper";
}

TEST(ShadedMesh, IsThatOfVtk) {
  const TriangleMesh mesh = bumps(40);
  const ShadedMesh result = shaded(mesh, crease_angle);
  vtkNew<vtkPolyDataNormals> vtk;
  vtk->SetInputData(triangle_polydata(mesh));
  vtk->SetFeatureAngle(crease_angle);
  vtk->ConsistencyOff();
  vtk->Update();
  vtkPolyData& expected = *vtk->GetOutput();
  EXPECT_GT(result.vertices.size(), mesh.vertices.size()) << "nothing is steep";
  EXPECT_LT(result.vertices.size(), 3 * mesh.triangles.size()) << "nothing is shallow";
  EXPECT_EQ(result.vertices.size(), std::size_t(expected.GetNumberOfPoints()));
  vtkNew<vtkIdList> points;
  double farthest = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    expected.GetCellPoints(vtkIdType(t), points);
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3 normal(expected.GetPointData()->GetNormals()->GetTuple3(points->GetId(vtkIdType(c))));
      farthest = std::max(farthest, (result.normals[result.triangles[t][c]].cast<double>() - normal).norm());
    }
  }
  EXPECT_LT(farthest, 1e-5);
}

TEST(ShadedMesh, OneThreadMakesTheSame) {
  const TriangleMesh mesh = bumps(200);
  const ShadedMesh result = shaded(mesh, crease_angle);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ShadedMesh again = shaded(mesh, crease_angle);
  EXPECT_EQ(result.vertices, again.vertices);
  EXPECT_EQ(result.normals, again.normals);
  EXPECT_EQ(result.triangles, again.triangles);
}

TEST(ShadedMesh, TrianglesWithoutAnAreaAndVerticesWithoutTrianglesHarmNothing) {
  TriangleMesh mesh;
  EXPECT_TRUE(shaded(mesh, crease_angle).vertices.empty());
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {1, 1, 1}};
  for (const Eigen::Vector3f& normal : shaded(mesh, crease_angle).normals) EXPECT_EQ(normal, Eigen::Vector3f::Zero());
}

}  // namespace
}  // namespace nextview
