#include "core/setting/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace nextview {

std::vector<double> numbers(const std::string& key, const std::string& text, std::size_t count,
                            const std::string& takes) {
  std::string spaced = text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::istringstream words(spaced);
  std::vector<double> values;
  bool good = true;
  for (std::string word; words >> word;) {
    char* end = nullptr;
    values.push_back(std::strtod(word.c_str(), &end));
    good = good && *end == '\0' && std::isfinite(values.back());
  }
  if (!good || values.size() != count)
    throw std::invalid_argument(fmt::format("{} takes {}, not '{}'", key, takes, text));
  return values;
}

}  // namespace nextview
