// Surfaces of fewer triangles, drawn while something moves.
#include "ui/layers/coarse_mesh.hpp"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <map>
#include <numbers>

#include "ui/layers/geometry.hpp"

namespace nextview {
namespace {

/// A ball around a place, of quadrilaterals cut in two, with its normals and the height of each point as a value.
vtkSmartPointer<vtkPolyData> ball(const Eigen::Vector3f& centre, float radius, int rows) {
  TriangleMesh mesh;
  vtkNew<vtkFloatArray> normals, heights;
  normals->SetNumberOfComponents(3);
  heights->SetName("height");
  const auto add = [&](double polar, double around) {
    const Eigen::Vector3f outward(float(std::sin(polar) * std::cos(around)), float(std::sin(polar) * std::sin(around)),
                                  float(std::cos(polar)));
    mesh.vertices.push_back(centre + radius * outward);
    normals->InsertNextTuple3(outward.x(), outward.y(), outward.z());
    heights->InsertNextValue(mesh.vertices.back().z());
  };
  const auto columns = std::uint32_t(2 * rows);
  add(0, 0);
  for (int row = 1; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column)
      add(std::numbers::pi * row / rows, 2 * std::numbers::pi * column / columns);
  add(std::numbers::pi, 0);
  const auto at = [&](int row, std::uint32_t column) { return 1 + std::uint32_t(row) * columns + column % columns; };
  const auto last = std::uint32_t(mesh.vertices.size() - 1);
  for (std::uint32_t column = 0; column < columns; ++column) {
    mesh.triangles.push_back({0, at(0, column), at(0, column + 1)});
    mesh.triangles.push_back({last, at(rows - 2, column + 1), at(rows - 2, column)});
    for (int row = 0; row + 2 < rows; ++row) {
      mesh.triangles.push_back({at(row, column), at(row + 1, column), at(row + 1, column + 1)});
      mesh.triangles.push_back({at(row, column), at(row + 1, column + 1), at(row, column + 1)});
    }
  }
  vtkSmartPointer<vtkPolyData> surface = triangle_polydata(mesh);
  surface->GetPointData()->SetNormals(normals);
  surface->GetPointData()->AddArray(heights);
  return surface;
}

/// Of each edge, how many triangles run along it one way less those that run along it the other way.
std::map<std::pair<vtkIdType, vtkIdType>, int> edges_of(vtkPolyData& surface) {
  std::map<std::pair<vtkIdType, vtkIdType>, int> balance;
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  for (surface.GetPolys()->InitTraversal(); surface.GetPolys()->GetNextCell(count, corners);) {
    EXPECT_EQ(count, 3);
    for (int c = 0; c < 3; ++c) {
      const vtkIdType a = corners[c], b = corners[(c + 1) % 3];
      EXPECT_NE(a, b) << "a triangle without an area";
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
    }
  }
  return balance;
}

TEST(CoarseMesh, ABallStaysAClosedBallOfFewerTrianglesWhereverItIs) {
  // Where it lies must not matter: around the origin, and far off on either side.
  for (const Eigen::Vector3f& centre : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(3, -2, 5), {-7, -7, -7}}) {
    const auto fine = ball(centre, 0.5f, 60);
    constexpr int cells = 12;
    const auto result = coarse(*fine, cells);
    // A ball of so many cells across meets about 1.5 pi times their square: pi is its area, 1.5 as it lies slanted.
    EXPECT_LT(result->GetNumberOfPoints(), 7 * cells * cells);
    EXPECT_GT(result->GetNumberOfPoints(), 3 * cells * cells);
    EXPECT_LT(result->GetNumberOfPolys(), fine->GetNumberOfPolys() / 8);
    EXPECT_GT(result->GetNumberOfPolys(), 6 * cells * cells) << "about two a point";
    for (const auto& [edge, sum] : edges_of(*result)) EXPECT_EQ(sum, 0) << "it is open";
  }
}

TEST(CoarseMesh, EachPointIsOneOfTheSurfacesWithItsData) {
  const auto fine = ball({0.2f, -0.1f, 0.4f}, 0.5f, 40);
  const auto result = coarse(*fine, 10);
  std::map<std::array<double, 3>, vtkIdType> of_surface;
  for (vtkIdType i = 0; i < fine->GetNumberOfPoints(); ++i) {
    std::array<double, 3> place;
    fine->GetPoint(i, place.data());
    of_surface[place] = i;
  }
  vtkDataArray *normals = result->GetPointData()->GetNormals(), *heights = result->GetPointData()->GetArray("height");
  ASSERT_TRUE(normals && heights);
  ASSERT_EQ(heights->GetNumberOfTuples(), result->GetNumberOfPoints());
  for (vtkIdType i = 0; i < result->GetNumberOfPoints(); ++i) {
    std::array<double, 3> place;
    result->GetPoint(i, place.data());
    const auto found = of_surface.find(place);
    ASSERT_NE(found, of_surface.end());
    EXPECT_EQ(heights->GetTuple1(i), place[2]);
    const Eigen::Vector3d normal(normals->GetTuple3(i)),
        expected(fine->GetPointData()->GetNormals()->GetTuple3(found->second));
    EXPECT_EQ(normal, expected);
  }
}

/// A thin plate's two sides lie in one cell; their normals keep them apart, else it would be a sheet without a back.
TEST(CoarseMesh, ThePlatesSidesStayApart) {
  TriangleMesh mesh;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const float side : {-1.0f, 1.0f})
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) {
        mesh.vertices.emplace_back(float(x), float(y), 0.001f * side);
        normals->InsertNextTuple3(0, 0, side);
      }
  mesh.triangles = {{0, 3, 1}, {0, 2, 3}, {4, 5, 7}, {4, 7, 6}};
  const auto plate = triangle_polydata(mesh);
  EXPECT_EQ(coarse(*plate, 4)->GetNumberOfPoints(), 4) << "without normals it is one sheet";
  plate->GetPointData()->SetNormals(normals);
  const auto result = coarse(*plate, 4);
  EXPECT_EQ(result->GetNumberOfPoints(), 8);
  EXPECT_EQ(result->GetNumberOfPolys(), 4);
}

}  // namespace
}  // namespace nextview
