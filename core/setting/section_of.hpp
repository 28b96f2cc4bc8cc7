#pragma once
#include <string>

namespace nextview {

/// Of a setting's key, as files have it: "sensor" of sensor.width; empty for a key that is in none.
inline std::string section_of(const std::string& key) {
  const std::size_t dot = key.find('.');
  return dot == key.npos ? "" : key.substr(0, dot);
}

}  // namespace nextview
