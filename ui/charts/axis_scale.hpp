#pragma once
#include <fmt/format.h>

#include <string>

namespace nextview {

/// Large values are shown in thousands or millions, named in the axis title.
struct AxisScale {
  double factor = 1.0;
  std::string word = {};

  static AxisScale of(double largest) {
    if (largest >= 1e6) return {1e6, "million "};
    if (largest >= 1e4) return {1e3, "thousand "};
    return {};
  }

  std::string title(const std::string& label, const std::string& unit) const {
    const std::string inside = word + unit;
    return inside.empty()
               ? label
               : fmt::format("{} [{}]", label, inside.back() == ' ' ? inside.substr(0, inside.size() - 1) : inside);
  }
};

}  // namespace nextview
