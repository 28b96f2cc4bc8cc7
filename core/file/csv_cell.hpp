#pragma once
#include <string>

namespace nextview {

/// A cell of a CSV file: in quotes if it holds what would end it (RFC 4180).
std::string csv_cell(const std::string& text);

}  // namespace nextview
