#include "core/setting/setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "core/setting/quantity.hpp"

namespace nextview {
namespace {

template <class Number>
bool parse_number(const std::string& text, Number& value) {
  Number parsed{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  value = parsed;
  return true;
}

std::string join(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

/// What a setting takes, for messages.
struct Expected {
  const std::string& unit;
  std::string operator()(bool*) const { return "true or false"; }
  std::string operator()(int*) const { return "a whole number"; }
  std::string operator()(std::uint64_t*) const { return "a whole number, 0 or more"; }
  std::string operator()(double*) const { return number_wanted(unit); }
  std::string operator()(std::string*) const { return "a text"; }
  std::string operator()(const Setting::Choice& c) const { return "one of " + join(c.names); }
};

struct Assign {
  const std::string& text;
  const std::string& unit;
  bool operator()(bool* v) const {
    if (text != "true" && text != "false") return false;
    *v = text == "true";
    return true;
  }
  bool operator()(std::string* v) const {
    *v = text;
    return true;
  }
  bool operator()(Setting::Choice& c) const {
    const auto found = std::find(c.names.begin(), c.names.end(), text);
    if (found == c.names.end()) return false;
    c.set(static_cast<std::size_t>(found - c.names.begin()));
    return true;
  }
  bool operator()(double* v) const { return read_quantity(text, unit, *v); }
  template <class Number>
  bool operator()(Number* v) const {
    return parse_number(text, *v);
  }
};

struct Text {
  std::string operator()(const bool* v) const { return *v ? "true" : "false"; }
  std::string operator()(const std::string* v) const { return *v; }
  std::string operator()(const Setting::Choice& c) const {
    const std::size_t i = c.get();
    return i < c.names.size() ? c.names[i] : "";
  }
  template <class Number>
  std::string operator()(const Number* v) const {
    return fmt::format("{}", *v);
  }
};

/// Whether a value is within the bounds of its setting.
struct Allowed {
  const std::optional<Bounds>& bounds;
  bool operator()(int* v) const { return !bounds || bounds->allow(*v); }
  bool operator()(double* v) const { return !bounds || bounds->allow(*v); }
  bool operator()(const auto&) const { return true; }
};

/// Without what only parts its words; of what a file may have instead of a name its beginning.
std::string letters_of(const std::string& name) {
  constexpr std::size_t longest = 100;
  std::string letters;
  for (const char c : name.substr(0, longest))
    if (std::string_view("-_. ").find(c) == std::string_view::npos) letters += char(std::tolower(std::uint8_t(c)));
  return letters;
}

/// How many letters are too few, too many, others, or exchanged with the next one.
std::size_t slips(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> of(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      of[i][j] = i == 0 || j == 0 ? i + j : of[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
      if (i > 0) of[i][j] = std::min(of[i][j], of[i - 1][j] + 1);
      if (j > 0) of[i][j] = std::min(of[i][j], of[i][j - 1] + 1);
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        of[i][j] = std::min(of[i][j], of[i - 2][j - 2] + 1);
    }
  return of.back().back();
}

/// In halves of a slip. Of a key the section may be left out ("width"), and of a name all but one of its words
/// ("noise").
std::size_t distance(const std::string& word, const std::string& name) {
  const std::size_t behind_section = name.find('.') + 1;  // 0 if there is none
  if (behind_section > 0 && word.starts_with(name.substr(0, behind_section)))
    return distance(word.substr(behind_section), name.substr(behind_section));
  const std::string typed = letters_of(word), letters = letters_of(name);
  std::size_t least = 2 * slips(typed, letters);
  if (behind_section > 0 && word.find('.') == word.npos)
    least = std::min(least, 1 + 2 * slips(typed, letters_of(name.substr(behind_section))));
  if (typed.size() > 2 && letters.find(typed) != letters.npos) least = std::min<std::size_t>(least, 3);
  return least;
}

/// For people to be told of it.
bool is_near(const std::string& word, const std::string& name) {
  const std::string typed = letters_of(word);
  if (typed.size() > 1 && name.starts_with(word)) return true;
  if (typed.size() > 2 && letters_of(name).find(typed) != std::string::npos) return true;
  return 3 * distance(word, name) <= 2 * typed.size();
}

}  // namespace

std::string Setting::text() const { return std::visit(Text{}, value); }

void Setting::set(const std::string& new_text) {
  if (std::visit(Assign{new_text, unit}, value)) return;
  std::string hint;
  if (const auto* c = std::get_if<Choice>(&value)) hint = did_you_mean(new_text, c->names);
  std::string with_point = new_text;
  std::ranges::replace(with_point, ',', '.');
  double ignored = 0.0;
  if (std::holds_alternative<double*>(value) && read_quantity(with_point, unit, ignored))
    hint = fmt::format("; did you mean '{}'?", with_point);
  throw std::invalid_argument(
      fmt::format("{} takes {}, not '{}'{}", key, std::visit(Expected{unit}, value), new_text, hint));
}

void Setting::require_in_bounds() const {
  if (!std::visit(Allowed{bounds}, value)) {
    const auto* length = unit == "m" ? std::get_if<double*>(&value) : nullptr;
    throw std::invalid_argument(
        fmt::format("{} must be {}, not {}", key, bounds->text(unit), length ? quantity_text(**length) : text()));
  }
  const auto* whole = std::get_if<std::uint64_t*>(&value);
  constexpr auto largest = std::uint64_t(std::numeric_limits<std::int64_t>::max());
  if (whole && **whole > largest)
    throw std::invalid_argument(
        fmt::format("{} must be at most {}, the largest whole number of TOML, not {}", key, largest, **whole));
}

std::string Setting::label() const {
  std::string name = key.substr(key.find('.') + 1);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string Setting::explanation() const { return unit.empty() ? help : fmt::format("{} [{}]", help, unit); }

Setting& find_setting(std::vector<Setting>& settings, const std::string& key) {
  const auto found = std::find_if(settings.begin(), settings.end(), [&](const Setting& s) { return s.key == key; });
  if (found != settings.end()) return *found;
  std::vector<std::string> keys;
  for (const Setting& setting : settings) keys.push_back(setting.key);
  throw std::invalid_argument(fmt::format("there is no setting '{}'{}", key, did_you_mean(key, keys)));
}

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  return *std::ranges::min_element(
      known, {}, [&](const std::string& name) { return std::pair(!name.starts_with(word), distance(word, name)); });
}

std::optional<std::string> meant(const std::string& word, const std::vector<std::string>& known) {
  if (known.empty()) return std::nullopt;
  const std::string name = nearest(word, known);
  return is_near(word, name) ? std::optional(name) : std::nullopt;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known, const std::string& otherwise) {
  const auto name = meant(word, known);
  return name ? fmt::format("; did you mean '{}'?", *name) : otherwise;
}

}  // namespace nextview
