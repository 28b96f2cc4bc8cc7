#pragma once
#include <vtkSmartPointer.h>

#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.hpp"
#include "ui/appearance/theme.hpp"

class vtkFloatArray;
class vtkPolyData;

namespace nextview {

/// Lines and triangles with a colour each, gathered before VTK draws them.
class Geometry {
 public:
  void add_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Colour& colour, double opacity = 1.0);
  void add_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Colour& colour);

  /// Cell colours are the cells' scalars.
  vtkSmartPointer<vtkPolyData> polydata() const;

 private:
  struct Cell {
    std::vector<std::uint32_t> points;
    Colour colour;
    double opacity;
  };
  std::uint32_t add_point(const Eigen::Vector3d& point);

  std::vector<Eigen::Vector3f> points_;
  std::vector<Cell> lines_, triangles_;
};

vtkSmartPointer<vtkFloatArray> float_vectors(std::span<const Eigen::Vector3f> vectors);
vtkSmartPointer<vtkPolyData> triangle_polydata(const TriangleMesh& mesh);
vtkSmartPointer<vtkPolyData> point_polydata(std::span<const Eigen::Vector3f> points);

}  // namespace nextview
