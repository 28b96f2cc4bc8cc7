#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

// Reading and writing JSON takes the compiler long: it is compiled once, in json_text.cpp. `Json` is nlohmann::json,
// which sorts keys, or nlohmann::ordered_json, which keeps their order.

namespace nextview {

/// @throws Json::parse_error
template <class Json>
Json parse_json(std::string_view text);

/// Discarded (Json::is_discarded) if it is not JSON.
template <class Json>
Json parse_json_if_it_is(std::string_view text);

/// On one line, or indented by so many blanks. What is not UTF-8 is replaced by U+FFFD.
template <class Json>
std::string json_text(const Json& json, int indent = -1);

}  // namespace nextview
