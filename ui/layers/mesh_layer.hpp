#pragma once
#include <string>

#include "core/mesh/triangle_mesh.hpp"
#include "ui/appearance/styles.hpp"
#include "ui/layers/layer.hpp"
#include "ui/layers/shaded_polydata.hpp"

class vtkActor;
class vtkOpenGLPolyDataMapper;
class vtkPolyData;

namespace nextview {

/// A number per vertex, to be seen as a colour.
struct MeshPaint {
  std::span<const float> values;            ///< one per vertex, in `unit`; finite where there is a value
  std::span<const std::uint8_t> has_value;  ///< one per vertex, 0: striped grey; empty: all have one
  ColourMap map = ColourMap::contribution();
  double low = 0.0, high = 1.0;               ///< numbers beyond take the colour of the end
  std::string title, unit;                    ///< of the legend
  std::string low_name = {}, high_name = {};  ///< what the ends of the range mean, if it needs saying
  std::string no_value_name = "not seen";
};

/// A kind of surface, such as what the views missed.
struct MeshClass {
  std::string name;
  Colour colour;
};

/// A class a vertex. Where corners differ, the border runs between them as a crisp line; no mixed colours.
struct MeshClasses {
  std::span<const std::uint8_t> classes;  ///< one per vertex, an index of the palette
  std::vector<MeshClass> palette;         ///< 1 to 4
  std::string title = {};                 ///< of the legend
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
  /// Solid and painted by class, with a legend of the classes that there are.
  /// @throws std::invalid_argument if the number of classes is not that of the vertices, a class is not in the palette,
  ///         or the palette is not of 1 to 4 colours.
  void show(const TriangleMesh& mesh, const MeshClasses& classes);
  /// Without paint from now on.
  void set_style(MeshStyle style);
  /// While the camera moves, a mesh of very many triangles is drawn with fewer.
  void set_coarse(bool wants_coarse);

 private:
  /// Solid, coloured by a function of ours that takes a vertex attribute of this name.
  void paint_with(const std::string& attribute, const std::string& vertex_shader, const std::string& fragment_shader);
  void on_scale() override;
  void take(vtkSmartPointer<vtkPolyData> polydata);

  ShadedPolydata shaded_;
  /// Each keeps on the graphics card what it draws. The second has nothing until it is wanted.
  vtkSmartPointer<vtkOpenGLPolyDataMapper> full_, coarse_;
  vtkSmartPointer<vtkActor> actor_;
  bool has_coarse_ = false, wants_coarse_ = false;
};

}  // namespace nextview
