#include "core/session/recent_files.hpp"

#include <algorithm>
#include <fstream>

#include "core/file/atomic_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kept_files = 12;
constexpr const char* list_name = "recent";  // a path a line

std::vector<fs::path> listed(const fs::path& state) {
  std::vector<fs::path> files;
  std::ifstream stream(state / list_name);
  for (std::string line; files.size() < kept_files && std::getline(stream, line);)
    if (fs::path(line).is_absolute()) files.emplace_back(line);
  return files;
}

}  // namespace

std::vector<fs::path> recent_files(const fs::path& state) {
  std::vector<fs::path> files = listed(state);
  std::erase_if(files, [](const fs::path& file) { return !is_there(file); });
  return files;
}

void add_recent_file(const fs::path& state, const fs::path& file) {
  try {
    const fs::path newest = fs::weakly_canonical(file);
    if (state.empty() || newest.string().find('\n') != std::string::npos) return;
    std::vector<fs::path> files = listed(state);
    std::erase(files, newest);
    files.insert(files.begin(), newest);
    files.resize(std::min(files.size(), kept_files));
    std::string text;
    for (const fs::path& each : files) text += each.string() + '\n';
    fs::create_directories(state);
    write_file(state / list_name, text);
  } catch (const std::exception&) {  // it is a comfort alone
  }
}

}  // namespace nextview
