#pragma once
#include "core/progress/progress.hpp"

namespace nextview {

/// The part of a job's progress from `begin` to `end`; nothing hears it if nothing hears the whole.
inline Progress part(const Progress& whole, double begin, double end) {
  if (!whole) return {};
  return [=](double fraction, std::string_view what) { whole(begin + (end - begin) * fraction, what); };
}

}  // namespace nextview
