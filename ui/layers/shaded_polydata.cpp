#include "ui/layers/shaded_polydata.hpp"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>

#include "ui/layers/geometry.hpp"
#include "ui/layers/shaded_mesh.hpp"

namespace nextview {
namespace {

/// Smooth over shallow edges, sharp over steep ones.
constexpr double crease_angle = 35.0;  // [deg]

bool same(const TriangleMesh& a, const TriangleMesh& b) {
  return a.triangles == b.triangles && std::ranges::equal(a.vertices, b.vertices);
}

}  // namespace

const ShadedPolydata::Kept& ShadedPolydata::kept(const TriangleMesh& mesh) {
  const auto found = std::ranges::find_if(kept_, [&](const Kept& k) { return same(k.mesh, mesh); });
  if (found != kept_.end()) {
    std::rotate(kept_.begin(), found, found + 1);
    return kept_.front();
  }
  ShadedMesh shading = shaded(mesh, crease_angle);
  TriangleMesh points;
  points.vertices.reserve(shading.vertices.size());
  for (const std::uint32_t vertex : shading.vertices) points.vertices.push_back(mesh.vertices[vertex]);
  points.triangles = std::move(shading.triangles);
  auto polydata = triangle_polydata(points);
  polydata->GetPointData()->SetNormals(float_vectors(shading.normals));
  if (kept_.size() == 2) kept_.pop_back();
  kept_.insert(kept_.begin(), {mesh, std::move(shading.vertices), std::move(polydata)});
  return kept_.front();
}

vtkSmartPointer<vtkPolyData> ShadedPolydata::of(const TriangleMesh& mesh, vtkFloatArray* attribute) {
  const Kept& k = kept(mesh);
  if (!attribute) return k.polydata;
  vtkNew<vtkFloatArray> of_points;
  of_points->SetName(attribute->GetName());
  of_points->SetNumberOfComponents(attribute->GetNumberOfComponents());
  of_points->SetNumberOfTuples(vtkIdType(k.vertices.size()));
  const auto components = std::size_t(attribute->GetNumberOfComponents());
  const float* of_vertices = attribute->GetPointer(0);
  float* out = of_points->GetPointer(0);
  for (const std::uint32_t vertex : k.vertices) out = std::copy_n(of_vertices + components * vertex, components, out);
  auto polydata = vtkSmartPointer<vtkPolyData>::New();
  polydata->ShallowCopy(k.polydata);
  polydata->GetPointData()->AddArray(of_points);
  return polydata;
}

}  // namespace nextview
