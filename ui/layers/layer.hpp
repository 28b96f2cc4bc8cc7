#pragma once
#include <vtkSmartPointer.h>

#include <optional>
#include <span>
#include <vector>

#include "core/view/pose.hpp"
#include "ui/appearance/legend.hpp"
#include "ui/appearance/section.hpp"

class vtkMapper;
class vtkProp;
class vtkProperty;
class vtkRenderer;

namespace nextview {

/// Something that is seen in 3D. A layer owns its VTK actors, which live in one renderer, and is empty until shown.
class Layer {
 public:
  explicit Layer(vtkRenderer& renderer);
  virtual ~Layer();
  Layer(const Layer&) = delete;
  Layer& operator=(const Layer&) = delete;

  void set_visible(bool visible);
  bool visible() const { return visible_; }

  /// Pixels of the display per pixel of the design: 2 on a HiDPI display. Lines and points become as much wider.
  void set_scale(double scale);

  /// Cuts off what a section does not leave, of a layer that is made of VTK's surfaces, lines and points.
  void set_section(const std::optional<Section>& section);
  /// Whether what it shows from now on lies on a dark ground: colours that say how much are turned over then.
  void set_dark(bool dark) { dark_ = dark; }

  /// Points that enclose what the layer draws [m, world], for framing; none if it is empty.
  std::span<const Vector3> outline() const { return outline_; }
  /// What its colours mean; none if it is empty.
  std::span<const Legend> legends() const { return legends_; }
  std::span<const Label> labels() const { return labels_; }

 protected:
  void add(vtkProp& prop);
  /// What an actor draws at times instead of what it draws now: a section cuts that, too.
  void add_instead(vtkMapper& mapper);
  double scale() const { return scale_; }
  bool dark() const { return dark_; }
  /// A colour that stands out from the ground, or a map of such.
  Colour tone(const Colour& colour) const { return dark_ ? on_dark(colour) : colour; }
  ColourMap tone(const ColourMap& map) const { return dark_ ? map.on_dark() : map; }
  /// What else a new scale changes, apart from the width of lines and the size of points.
  virtual void on_scale() {}
  void describe(std::vector<Vector3> outline, std::vector<Legend> legends, std::vector<Label> labels = {});

 private:
  vtkSmartPointer<vtkRenderer> renderer_;
  std::vector<vtkSmartPointer<vtkProp>> props_;
  std::vector<vtkSmartPointer<vtkMapper>> instead_;
  std::vector<Vector3> outline_;
  std::vector<Legend> legends_;
  std::vector<Label> labels_;
  bool visible_ = true, dark_ = false;
  double scale_ = 1.0;
};

void set_colour(vtkProperty& property, const Colour& colour);

/// The eight corners of a box; none if it is empty.
std::vector<Vector3> corners(const Eigen::AlignedBox3d& box);

}  // namespace nextview
