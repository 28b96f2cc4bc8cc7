#include "core/setting/bounds.hpp"

#include <fmt/format.h>

#include "core/setting/quantity.hpp"

namespace nextview {

bool Bounds::allow(double value) const {
  if (or_zero && value == 0.0) return true;
  return (low_included ? value >= low : value > low) && (high_included ? value <= high : value < high);
}

std::string Bounds::text(const std::string& unit) const {
  const bool is_length = unit == "m";
  const std::string behind = unit.empty() || is_length ? "" : " " + unit;
  const std::string zero = or_zero ? "0 or " : "";
  const auto limit = [&](double value) {
    return is_length && value != 0.0 ? quantity_text(value) : fmt::format("{}", value);
  };
  if (low_included && high_included) return fmt::format("{}from {} to {}{}", zero, limit(low), limit(high), behind);
  return fmt::format("{}{} {} and {} {}{}", zero, low_included ? "at least" : "over", limit(low),
                     high_included ? "at most" : "below", limit(high), behind);
}

}  // namespace nextview
