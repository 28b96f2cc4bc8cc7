#pragma once
#include <filesystem>

#include "ui/appearance/theme.hpp"

class vtkTextProperty;

namespace nextview {

enum class TextWeight { regular, semi_bold };

/// The product's font, Inter (Debian's fonts-inter).
/// @throws std::runtime_error naming the package to install if the font is not there.
const std::filesystem::path& font_file(TextWeight weight);

/// Sets font, size [px] and colour.
void set_text(vtkTextProperty& property, int size, const Colour& colour, TextWeight weight = TextWeight::regular);

/// To be called when something else of a property is changed: VTK keeps the first property of its kind that it meets,
/// and opens the font anew by what that one says then, after it opened some thirty others. This is a copy that stays.
void keep_text(vtkTextProperty& property);

}  // namespace nextview
