#pragma once
#include <string_view>

namespace nextview {

/// What one unit of a file's coordinates is. `automatic`: the file's own if it or its type has one, else millimetres if
/// the longest side exceeds 10, else metres. The last two are of files that say so; settings do not offer them.
enum class LengthUnit { automatic, metres, millimetres, centimetres, inches, feet, micrometres };

constexpr double metres_per(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::millimetres:
      return 0.001;
    case LengthUnit::centimetres:
      return 0.01;
    case LengthUnit::inches:
      return 0.0254;
    case LengthUnit::feet:
      return 0.3048;
    case LengthUnit::micrometres:
      return 1e-6;
    default:
      return 1.0;
  }
}

/// "mm"
constexpr std::string_view name(LengthUnit unit) {
  constexpr std::string_view names[] = {"auto", "m", "mm", "cm", "inch", "ft", "um"};
  return names[static_cast<int>(unit)];
}

}  // namespace nextview
