#include "core/setting/mistyped_path.hpp"

#include <fmt/format.h>

#include "core/setting/setting.hpp"

namespace nextview {

std::string did_you_mean_path(const std::filesystem::path& missing, const std::vector<std::string>& known,
                              const std::string& otherwise,
                              const std::function<bool(const std::filesystem::path&)>& fits) {
  namespace fs = std::filesystem;
  constexpr std::size_t most = 10'000;  // of a folder's names: it is only a hint
  const fs::path path = missing.has_filename() ? missing : missing.parent_path();
  const fs::path folder = path.parent_path();
  std::vector<std::string> names = folder.empty() ? known : std::vector<std::string>();
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end;
       !error && entry != end && names.size() < most; entry.increment(error))
    if (!fits || fits(entry->path())) names.push_back(entry->path().filename().string());
  const auto name = meant(path.filename().string(), names);
  return name ? fmt::format("; did you mean '{}'?", (folder / *name).string()) : otherwise;
}

}  // namespace nextview
