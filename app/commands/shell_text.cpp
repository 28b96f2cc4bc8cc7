#include "app/commands/shell_text.hpp"

#include <cctype>

namespace nextview {

std::string shell_text(const std::filesystem::path& path) {
  const std::string text = path.string().starts_with('-') ? "./" + path.string() : path.string();
  bool plain = !text.empty();
  for (const char c : text)
    plain &= std::isalnum(static_cast<unsigned char>(c)) || std::string_view("_-+./,:=@%").find(c) != std::string::npos;
  if (plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace nextview
