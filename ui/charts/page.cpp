#include "ui/charts/page.hpp"

#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <exception>
#include <sstream>

#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

class Page : public vtkContextItem {
 public:
  static Page* New();
  vtkTypeMacro(Page, vtkContextItem)

      bool Paint(vtkContext2D* context) override {
    try {
      paint(*context);
    } catch (...) {  // VTK would not survive that it is left in the middle of a frame
      failure = std::current_exception();
    }
    return true;
  }

  std::function<void(vtkContext2D&)> paint;
  std::exception_ptr failure;
};

vtkStandardNewMacro(Page);

}  // namespace

Image draw_page(int width, int height, const std::function<void(vtkContext2D&)>& paint) {
  OffscreenTarget target(width, height);
  return draw_page(target, paint);
}

Image draw_page(RenderTarget& target, const std::function<void(vtkContext2D&)>& paint) {
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkContextActor> actor;
  vtkNew<Page> page;
  page->paint = paint;
  renderer->SetBackground(theme::paper.data());
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  actor->GetScene()->AddItem(page);
  target.window().AddRenderer(renderer);
  target.render();
  Image image = target.read_back();
  actor->GetScene()->SetRenderer(nullptr);
  target.window().RemoveRenderer(renderer);
  if (page->failure) std::rethrow_exception(page->failure);
  return image;
}

Image draw_page(RenderTarget& target, const PictureSize& size, const std::function<void(vtkContext2D&)>& paint) {
  const PictureSize before{target.width(), target.height()};
  target.window().SetSize(size.width, size.height);
  Image image = draw_page(target, paint);
  target.window().SetSize(before.width, before.height);
  return image;
}

void paint_panel(Painter& painter, const PageArea& panel, const std::string& heading, const std::string& remark) {
  painter.frame(panel.left - 1, panel.bottom - 1, panel.width + 2, panel.height + 2, theme::hairline);
  const double y = panel.top() - 30;
  painter.text(panel.left + page_margin, y, heading, theme::caption, theme::ink, TextWeight::semi_bold);
  painter.text(panel.right() - page_margin, y + 1, remark, theme::small_text, theme::soft_ink, TextWeight::regular,
               TextAlign::right);
}

double paint_title(Painter& painter, double page_width, double page_height, const std::string& title,
                   const std::string& remark, const std::string& caption) {
  constexpr double title_height = 56, line_height = 22;
  double y = page_height - 44;
  painter.text(page_margin, y, title, theme::title, theme::ink, TextWeight::semi_bold);
  painter.text(page_width - page_margin, y + 2, remark, theme::caption, theme::soft_ink, TextWeight::regular,
               TextAlign::right);
  const auto lines = wrapped(painter, caption, page_width - 2 * page_margin, theme::caption);
  y -= 4;
  for (const std::string& line : lines) {
    y -= line_height;
    painter.text(page_margin, y, line, theme::caption, theme::soft_ink);
  }
  return title_height + line_height * double(lines.size());
}

std::vector<std::string> wrapped(Painter& painter, const std::string& text, double width, int size) {
  return wrapped(text, [&](const std::string& line) { return painter.text_width(line, size) <= width; });
}

std::vector<std::string> wrapped(const std::string& text, const std::function<bool(const std::string&)>& fits) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    if (!lines.empty() && fits(longer))
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

void paint_image(vtkContext2D& context, double x, double y, const Image& image) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  const std::size_t row = std::size_t(image.width) * 4;
  auto* target = static_cast<std::uint8_t*>(data->GetScalarPointer());
  // VTK's rows go from bottom to top.
  for (int v = 0; v < image.height; ++v) std::copy_n(&image.rgba[v * row], row, target + (image.height - 1 - v) * row);
  context.DrawImage(float(x), float(y), data);
}

bool clip(LinePiece& piece, const Eigen::AlignedBox2d& box) {
  // Liang and Barsky 1984: the part of the piece, from 0 to 1, that lies within both pairs of sides.
  const Eigen::Vector2d start = piece[0], way = piece[1] - piece[0];
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double to_low = box.min()[axis] - start[axis], to_high = box.max()[axis] - start[axis];
    if (way[axis] == 0.0) {
      if (to_low > 0.0 || to_high < 0.0) return false;
      continue;
    }
    enter = std::max(enter, std::min(to_low / way[axis], to_high / way[axis]));
    leave = std::min(leave, std::max(to_low / way[axis], to_high / way[axis]));
  }
  if (enter >= leave) return false;
  piece = {start + enter * way, start + leave * way};
  return true;
}

}  // namespace nextview
