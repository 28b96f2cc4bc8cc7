#include "core/file/printable.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace nextview {
namespace {

/// A letter of UTF-8; of length 0 if the bytes are none.
struct Letter {
  std::uint32_t code = 0;
  std::size_t length = 0;
};

Letter first_letter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
  std::uint32_t code = lead & (0xffu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3f);
  }
  const std::uint32_t least = length == 4 ? 0x10000 : length == 3 ? 0x800 : 0x80;
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  return code < least || code > 0x10ffff || surrogate ? Letter{} : Letter{code, length};
}

/// Controls, line and paragraph separators, and what turns the direction of writing.
bool acts(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x200e && code <= 0x200f) ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

std::string escaped(std::uint32_t code) {
  switch (code) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return code < 0x100 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{:04x}", code);
  }
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Letter letter = first_letter(text);
    if (letter.length == 0)
      result += escaped(static_cast<unsigned char>(text.front()));
    else if (acts(letter.code))
      result +=
          letter.code < 0xa0 && letter.code >= 0x80 ? fmt::format("\\u{:04x}", letter.code) : escaped(letter.code);
    else
      result += text.substr(0, letter.length);
    text.remove_prefix(letter.length == 0 ? 1 : letter.length);
  }
  return result;
}

}  // namespace nextview
