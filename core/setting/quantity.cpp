#include "core/setting/quantity.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace nextview {
namespace {

struct LengthSuffix {
  std::string_view name;
  int exponent;         ///< of ten, to metres
  double factor = 1.0;  ///< beyond that
};
constexpr std::array lengths = {LengthSuffix{"m", 0},   LengthSuffix{"cm", -2}, LengthSuffix{"mm", -3},
                                LengthSuffix{"um", -6}, LengthSuffix{"µm", -6}, LengthSuffix{"in", -4, 254}};

std::string_view without_spaces(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

bool read_number(std::string_view text, double& value) {
  double parsed = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  value = parsed;
  return true;
}

/// Where the number ends and its unit begins.
std::size_t number_length(std::string_view text) {
  double ignored = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ignored);
  return error == std::errc() ? std::size_t(end - text.data()) : 0;
}

}  // namespace

bool read_quantity(const std::string& text, const std::string& unit, double& value) {
  const std::string_view all = without_spaces(text);
  const std::string_view number = all.substr(0, number_length(all));
  const std::string_view suffix = without_spaces(all.substr(number.size()));
  if (suffix.empty() || (suffix == unit && unit != "m")) return read_number(number, value);
  if (unit != "m") return false;
  for (const LengthSuffix& length : lengths) {
    if (suffix != length.name) continue;
    double parsed = 0.0;
    // A power of ten is read with the number: a product would be rounded once more.
    const bool scientific = number.find_first_of("eE") != number.npos;
    if (!read_number(scientific ? std::string(number) : fmt::format("{}e{}", number, length.exponent), parsed))
      return false;
    value = parsed * length.factor * (scientific ? std::pow(10.0, length.exponent) : 1.0);
    return true;
  }
  return false;
}

std::string number_wanted(const std::string& unit) {
  if (unit.empty()) return "a number";
  if (unit != "m") return fmt::format("a number [{}]", unit);
  std::vector<std::string_view> names;
  for (const LengthSuffix& length : lengths) names.push_back(length.name);
  return fmt::format("a number [m], or one with a unit ({})", fmt::join(names, ", "));
}

std::string quantity_text(double length) {
  const bool small = std::abs(length) < 1.0 && length != 0.0;
  return fmt::format("{:.9g} {}", small ? 1e3 * length : length, small ? "mm" : "m");
}

}  // namespace nextview
