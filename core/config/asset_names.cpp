#include "core/config/asset_names.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "core/config/configuration.hpp"

namespace nextview {

std::vector<std::string> asset_names(const char* folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(assets_folder() / folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".toml") names.push_back(entry->path().stem().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace nextview
