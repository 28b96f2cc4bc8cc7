#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace nextview {

/// "; did you mean 'scans/out-2'?": of the names in the folder where nothing is called `missing` the nearest that is
/// near (did_you_mean) and `fits`; of a bare name `known` counts, too. Else `otherwise`.
std::string did_you_mean_path(const std::filesystem::path& missing, const std::vector<std::string>& known = {},
                              const std::string& otherwise = "",
                              const std::function<bool(const std::filesystem::path&)>& fits = {});

}  // namespace nextview
