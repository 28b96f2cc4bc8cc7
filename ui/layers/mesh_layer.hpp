#pragma once
#include "core/mesh/triangle_mesh.hpp"
#include "ui/layers/layer.hpp"

class vtkActor;
class vtkOpenGLPolyDataMapper;

namespace nextview {

enum class MeshStyle {
  solid,
  wire,
  ghost  ///< clear where it faces the viewer, denser towards its outline
};

/// A number a vertex, to be seen as a colour.
struct MeshPaint {
  std::span<const float> values;            ///< one a vertex, in `unit`; finite where there is a value
  std::span<const std::uint8_t> has_value;  ///< one a vertex, 0: striped grey; empty: all have one
  ColourMap map = ColourMap::contribution();
  double low = 0.0, high = 1.0;               ///< numbers beyond take the colour of the end
  std::string title, unit;                    ///< of the legend
  std::string low_name = {}, high_name = {};  ///< what the ends of the range mean, if it needs saying
  std::string no_value_name = "not seen";
};

/// The object, or a reconstructed surface.
class MeshLayer : public Layer {
 public:
  explicit MeshLayer(vtkRenderer& renderer);

  void show(const TriangleMesh& mesh, MeshStyle style = MeshStyle::solid);
  /// Solid and painted, with a legend.
  /// @throws std::invalid_argument if the numbers of values or marks are not that of the vertices, a value is not
  ///         finite, or the range is empty.
  void show(const TriangleMesh& mesh, const MeshPaint& paint);
  /// Without paint from now on.
  void set_style(MeshStyle style);

 private:
  vtkSmartPointer<vtkOpenGLPolyDataMapper> mapper_;
  vtkSmartPointer<vtkActor> actor_;
};

}  // namespace nextview
