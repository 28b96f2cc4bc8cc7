#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace nextview {

/// Of JSON that others may have written: the library converts any number, and one that does not fit its type becomes
/// another one, or is undefined. @throws std::runtime_error, or what Json throws, if it is none that fits
template <class Whole, class Json>
Whole whole_number(const Json& json) {
  if (!json.is_number_integer()) throw std::runtime_error("no whole number");
  const bool fits = json.is_number_unsigned() ? std::in_range<Whole>(json.template get<std::uint64_t>())
                                              : std::in_range<Whole>(json.template get<std::int64_t>());
  if (!fits) throw std::runtime_error("a whole number that is too large");
  return json.template get<Whole>();
}

}  // namespace nextview
