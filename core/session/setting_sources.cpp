#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/session/configuration.hpp"

namespace nextview {
namespace {

/// Empty if all is well.
std::string complaint(const Configuration& configuration) {
  try {
    configuration.validate();
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

bool begins_with_key(const std::string& reason, const std::string& key) { return reason.starts_with(key + " "); }

/// The setting whose default would make a complaint go away; the end if there is none.
SettingSources::const_iterator culprit(const Configuration& configuration, const std::string& reason,
                                       const SettingSources& sources) {
  const auto named = std::find_if(sources.begin(), sources.end(),
                                  [&](const auto& source) { return begins_with_key(reason, source.first); });
  if (named != sources.end()) return named;
  Configuration defaults, other;
  const auto of_defaults = settings(defaults);
  auto of_other = settings(other);
  return std::find_if(sources.begin(), sources.end(), [&](const auto& source) {
    other = configuration;
    for (std::size_t i = 0; i < of_other.size(); ++i)
      if (of_other[i].key == source.first) of_other[i].set(of_defaults[i].text());
    return complaint(other) != reason;
  });
}

}  // namespace

std::string complaint_about(const std::string& key, const std::string& source, const std::string& reason) {
  if (!source.starts_with("--") || !begins_with_key(reason, key)) return source + ": " + reason;
  return (source == "--" + key ? source : fmt::format("{} ({})", source, key)) + reason.substr(key.size());
}

void validate(const Configuration& configuration, const SettingSources& sources) {
  const std::string reason = complaint(configuration);
  if (reason.empty()) return;
  const auto source = culprit(configuration, reason, sources);
  throw std::runtime_error(source == sources.end() ? reason : complaint_about(source->first, source->second, reason));
}

}  // namespace nextview
