#pragma once
#include <string>
#include <vector>

namespace nextview {

/// The numbers of a setting that takes several in one text, with spaces or commas between them.
/// @throws std::invalid_argument naming the key, and what it takes, if they are not `count` finite numbers.
std::vector<double> numbers(const std::string& key, const std::string& text, std::size_t count,
                            const std::string& takes);

}  // namespace nextview
