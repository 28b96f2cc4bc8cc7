#pragma once
#include <string>

#include "core/offline/refinement.hpp"
#include "core/session/shared_objects.hpp"

namespace nextview {

/// What runs that follow one another only read, and share: made for the first that wants it, kept until one wants
/// another. A run's result is the same without.
struct SharedByRuns {
  SharedObjects objects;
  RefinementJob views;     ///< of maps: what they are made of, and the truth
  std::string views_from;  ///< the settings that these follow from; empty: there are none
};

}  // namespace nextview
