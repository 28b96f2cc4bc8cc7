#pragma once
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "core/config/configuration.hpp"

namespace nextview {

/// Of names: an empty one, as a script has of a variable that is not set, would be taken for none.
CLI::Validator not_empty();

/// Of sessions: one that the window keeps is called by its name alone, as its lists have it, too.
CLI::Validator kept_session();

/// Of numbers with this unit: they are taken as settings take theirs, "1 mm" for 0.001 [m].
CLI::Validator quantity(const std::string& unit);

/// Of numbers from `least` to `most`, with a reason as settings have it.
template <class Number>
CLI::Validator within(Number least, Number most) {
  const char* kind = std::is_integral_v<Number> ? "whole number" : "number";
  return {[=](std::string& text) {
            Number value{};
            const bool good = CLI::detail::lexical_cast(text, value) && least <= value && value <= most;
            return good ? "" : fmt::format("takes a {} from {} to {}, not '{}'", kind, least, most, text);
          },
          fmt::format("in [{} - {}]", least, most)};
}

/// Of quantities within these bounds, in the same words.
CLI::Validator within(const Bounds& bounds, const std::string& unit);

/// Of a word that is one of these.
CLI::Validator one_of(const std::vector<std::string>& names);

/// What the command line says of a configuration: files, and settings by their keys, which override them.
class ConfigurationOptions {
 public:
  /// Adds OBJECT, --config, an option for every setting (`--sensor.range_noise 0.001`), and the short names of the
  /// common ones.
  void add_to(CLI::App& app);
  /// Adds --config and an option for each setting whose key begins with one of the prefixes. Of a file, too, only such
  /// settings are taken.
  void add_settings_to(CLI::App& app, const std::vector<std::string>& prefixes);

  /// @throws std::runtime_error, std::invalid_argument with one line for people.
  Configuration configuration() const;
  /// OBJECT, as it was given; empty if it was not.
  const std::string& object() const { return object_; }
  /// Whether anything but OBJECT was given.
  bool gives_settings() const { return !files_.empty() || !given_.empty(); }
  /// Sets what was given over a valid configuration that came from elsewhere.
  /// @throws std::runtime_error, std::invalid_argument likewise.
  void apply_to(Configuration& configuration) const;

 private:
  bool takes(const std::string& key) const;
  Configuration with_object() const;

  std::vector<std::string> prefixes_ = {""};
  std::vector<std::string> files_;  ///< later ones override earlier ones
  std::string object_;
  struct Given {
    std::string option, text;
  };

  std::map<std::string, Given> given_;  ///< by key
};

}  // namespace nextview
