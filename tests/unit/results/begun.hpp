#pragma once
#include "core/results/output_folder.hpp"

namespace nextview {

/// A folder that results can be written to at once.
inline OutputFolder begun(const std::filesystem::path& folder) {
  OutputFolder out(folder, {});
  out.begin("scan");
  return out;
}

}  // namespace nextview
