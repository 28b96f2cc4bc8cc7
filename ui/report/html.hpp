#pragma once
#include <string>
#include <vector>

namespace nextview {

/// A table: `cells` are HTML; of columns from `first_number` on they stand right.
std::string html_table(const std::vector<std::string>& columns, const std::vector<std::vector<std::string>>& cells,
                       std::size_t first_number);

/// A page that needs nothing else: its style within, no script, no font or picture from elsewhere.
std::string html_page(const std::string& title, const std::string& body);

}  // namespace nextview
