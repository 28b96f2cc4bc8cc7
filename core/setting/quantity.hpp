#pragma once
#include <string>

namespace nextview {

/// Reads a number as people write it: "0.005", "5e-3", and with its unit behind it, "0.005 m". Where that is metres,
/// mm, cm, um and in do as well: "5 mm". False, and `value` as it was, if it is none. Exact: "5 mm" is what "0.005" is.
bool read_quantity(const std::string& text, const std::string& unit, double& value);

/// What that takes, for messages: "a number", "a number [deg]", "a number [m], or one with a unit (m, cm, …)".
std::string number_wanted(const std::string& unit);

/// As people write a length [m] to change it: "5 mm", "1.2 m". Exact to nine digits.
std::string quantity_text(double length);

}  // namespace nextview
