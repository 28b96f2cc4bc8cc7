#include "ui/drawing/text.hpp"

#include <vtkFreeTypeTools.h>
#include <vtkNew.h>
#include <vtkTextProperty.h>

#include <stdexcept>
#include <string>

namespace nextview {
namespace {

std::filesystem::path find_font(const std::string& name) {
  const std::filesystem::path fonts = "/usr/share/fonts";
  for (const auto& file : {fonts / "opentype/inter" / (name + ".otf"), fonts / "truetype/inter" / (name + ".ttf")}) {
    if (std::filesystem::exists(file)) return file;
  }
  throw std::runtime_error("the font " + name + " is missing from /usr/share/fonts; install the package fonts-inter");
}

}  // namespace

/// Looked for once: a scene has dozens of texts, which are measured and drawn in each picture.
const std::filesystem::path& font_file(TextWeight weight) {
  static const std::filesystem::path regular = find_font("Inter-Regular"), semi_bold = find_font("Inter-SemiBold");
  return weight == TextWeight::semi_bold ? semi_bold : regular;
}

void set_text(vtkTextProperty& property, int size, const Colour& colour, TextWeight weight) {
  property.SetFontFamily(VTK_FONT_FILE);
  property.SetFontFile(font_file(weight).c_str());
  property.SetFontSize(size);
  property.SetColor(colour[0], colour[1], colour[2]);
  keep_text(property);
}

void keep_text(vtkTextProperty& property) {
  const vtkNew<vtkTextProperty> copy;
  copy->ShallowCopy(&property);
  std::size_t id = 0;
  vtkFreeTypeTools::GetInstance()->MapTextPropertyToId(copy, &id);
}

}  // namespace nextview
