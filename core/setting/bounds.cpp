#include "core/setting/bounds.hpp"

#include <fmt/format.h>

namespace nextview {

bool Bounds::allow(double value) const {
  if (or_zero && value == 0.0) return true;
  return (low_included ? value >= low : value > low) && (high_included ? value <= high : value < high);
}

std::string Bounds::text(const std::string& unit) const {
  const std::string behind = unit.empty() ? "" : " " + unit;
  const std::string zero = or_zero ? "0 or " : "";
  if (low_included && high_included) return fmt::format("{}from {} to {}{}", zero, low, high, behind);
  return fmt::format("{}{} {} and {} {}{}", zero, low_included ? "at least" : "over", low,
                     high_included ? "at most" : "below", high, behind);
}

}  // namespace nextview
