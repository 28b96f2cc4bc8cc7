#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/setting/bounds.hpp"

namespace nextview {

/// One setting of a configuration, declared once, beside what it configures: the function `settings` of each
/// configuration struct lists its own. Files, the command line, `--help`, panels and checks are all made from that.
struct Setting {
  struct Choice {
    std::vector<std::string> names;
    std::function<std::size_t()> get;
    std::function<void(std::size_t)> set;
  };
  std::string key;   ///< as in the file and, behind `--`, on the command line: "sensor.range_noise"
  std::string unit;  ///< "m", "deg", …; empty if it has none
  std::string help;
  std::variant<bool*, int*, double*, std::uint64_t*, std::string*, Choice> value;
  std::optional<Bounds> bounds = {};  ///< of int and double

  std::string text() const;
  /// Numbers may have their unit behind them, lengths any of theirs: "5 mm".
  /// @throws std::invalid_argument naming the key and what it takes.
  void set(const std::string& text);
  /// @throws std::invalid_argument naming the key and its bounds.
  void require_in_bounds() const;

  /// "range noise"
  std::string label() const;
  /// "horizontal field of view [deg]"
  std::string explanation() const;
};

/// A choice among the values of an enumeration, in their order.
template <class Enum>
Setting::Choice choice(Enum& value, std::vector<std::string> names) {
  return {std::move(names), [&value] { return static_cast<std::size_t>(value); },
          [&value](std::size_t i) { value = static_cast<Enum>(i); }};
}

/// That each setting of a configuration struct is within its bounds.
/// @throws std::invalid_argument naming the key and its bounds.
template <class Configuration>
void require_in_bounds(Configuration configuration) {
  for (const Setting& setting : settings(configuration)) setting.require_in_bounds();
}

/// Whether they say the same.
template <class Configuration>
bool same_settings(Configuration a, Configuration b) {
  const auto all_a = settings(a), all_b = settings(b);
  return std::ranges::equal(all_a, all_b, {}, &Setting::text, &Setting::text);
}

/// @throws std::invalid_argument if there is none with this key, with one that may be meant
Setting& find_setting(std::vector<Setting>& settings, const std::string& key);

/// Of `known`, the one that `word` is most likely meant to be. @pre there is one
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// The nearest of `known`, if it is near: `word` is its beginning, or one of its words, or the same but for slips in at
/// most a third of its letters.
std::optional<std::string> meant(const std::string& word, const std::vector<std::string>& known);

/// "; did you mean 'scan'?", with what is meant; `otherwise` if nothing is.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known,
                         const std::string& otherwise = "");

}  // namespace nextview
