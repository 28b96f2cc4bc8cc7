#pragma once
#include <vtkSmartPointer.h>

#include <cstdint>
#include <vector>

#include "core/mesh/triangle_mesh.hpp"

class vtkFloatArray;
class vtkPolyData;

namespace nextview {

/// Meshes with normals, as VTK draws them. Keeps the last two: one goes to and fro between an object and what is
/// painted on it, and paints it anew with each view.
class ShadedPolydata {
 public:
  /// With the vertices' attribute if there is one: a tuple a vertex.
  vtkSmartPointer<vtkPolyData> of(const TriangleMesh& mesh, vtkFloatArray* attribute = nullptr);

 private:
  struct Kept {
    TriangleMesh mesh;
    std::vector<std::uint32_t> vertices;  ///< of the mesh, one a point
    vtkSmartPointer<vtkPolyData> polydata;
  };
  const Kept& kept(const TriangleMesh& mesh);

  std::vector<Kept> kept_;  ///< the latest first
};

}  // namespace nextview
