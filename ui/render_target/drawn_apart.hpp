#pragma once
#include <vtkSmartPointer.h>

#include <array>
#include <vector>

#include "ui/appearance/picture_size.hpp"
#include "ui/render_target/render_target.hpp"

class vtkOpenGLFramebufferObject;
class vtkRenderer;

namespace nextview {

/// While it lives a target draws pictures of any size into memory, beside what it shows. Only the renderers in `drawn`
/// and those that are added meanwhile are drawn. Afterwards all is as it was; what the target shows has to be drawn
/// anew.
class DrawnApart {
 public:
  /// @throws OutOfMemory @pre the sides are within smallest_picture and largest_picture
  DrawnApart(RenderTarget& target, const std::vector<vtkRenderer*>& drawn, const PictureSize& size);
  ~DrawnApart();
  DrawnApart(const DrawnApart&) = delete;
  DrawnApart& operator=(const DrawnApart&) = delete;

  /// What is there now. If transparent, without the renderers' backgrounds. @throws as RenderTarget::render
  Image draw(bool transparent);

 private:
  Image draw_and_read();

  RenderTarget& target_;
  PictureSize size_;
  std::array<int, 2> size_before_;
  int blitting_before_;
  std::vector<vtkSmartPointer<vtkRenderer>> hidden_;
  vtkSmartPointer<vtkOpenGLFramebufferObject> pixels_;
};

}  // namespace nextview
