#include "core/file/nul_text.hpp"

#include "core/file/printable.hpp"

namespace nextview {

std::string why_no_text(std::string_view key, std::string_view value) {
  const bool is_text = key.find('\0') == key.npos && value.find('\0') == value.npos;
  return is_text ? "" : printable(key) + " holds a NUL, which no text has";
}

}  // namespace nextview
