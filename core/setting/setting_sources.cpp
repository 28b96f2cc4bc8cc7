#include "core/setting/setting_sources.hpp"

#include <cctype>
#include <set>

namespace nextview {
namespace {

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Whether a key stands at this place, and not a part of another one, of a path or of an option. A key without a dot is
/// a word of plain English; it is one at the beginning only.
bool stands_at(const std::string& key, const std::string& message, std::size_t at) {
  if (message.compare(at, key.size(), key) != 0) return false;
  const char before = at == 0 ? ' ' : message[at - 1];
  if (is_of_word(before) || before == '.' || before == '-' || before == '/') return false;
  const std::string behind = message.substr(at + key.size(), 2) + "  ";
  if (is_of_word(behind[0]) || behind[0] == '/' || (behind[0] == '.' && is_of_word(behind[1]))) return false;
  return at == 0 || key.find('.') != key.npos;
}

/// Whether this text stands at that place.
bool has_at(const std::string& message, std::size_t at, const std::string& text) {
  return at <= message.size() && message.compare(at, text.size(), text) == 0;
}

}  // namespace

std::string as_given(const std::string& message, const SettingSources& sources) {
  std::string text, first_place;
  std::set<std::string> named;
  for (std::size_t at = 0; at < message.size();) {
    auto source = sources.begin();
    while (source != sources.end() && !stands_at(source->first, message, at)) ++source;
    if (source == sources.end()) {
      text += message[at++];
      continue;
    }
    const auto& [key, given] = *source;
    // Who passes a message on may have named them already.
    const std::size_t before = given.name.find(key), behind = at + key.size();
    text += before != given.name.npos && has_at(message, at - before, given.name) ? key : given.name;
    const std::string place = " (" + given.place + ")";
    if (first_place.empty())
      first_place = given.place;
    else if (given.place != first_place && !given.place.empty() && !named.contains(key) &&
             !has_at(message, behind, place))
      text += place;
    named.insert(key);
    at += key.size();
  }
  return first_place.empty() || has_at(message, 0, first_place + ": ") ? text : first_place + ": " + text;
}

}  // namespace nextview
