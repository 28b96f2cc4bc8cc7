#include "core/export/frame_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <vector>

#include "core/file/atomic_file.hpp"
#include "core/file/make_folder.hpp"
#include "core/results/manifest.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

bool is_frame_name(const std::string& name) {
  constexpr std::string_view begin = "frame_", end = ".png";
  if (!name.starts_with(begin) || !name.ends_with(end) || name.size() < begin.size() + end.size() + 5) return false;
  return std::all_of(name.begin() + begin.size(), name.end() - end.size(),
                     [](unsigned char c) { return std::isdigit(c); });
}

}  // namespace

std::string frame_name(int number) { return fmt::format("frame_{:05}.png", number); }

void make_frame_folder(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> earlier;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!is_frame_name(entry->path().filename().string()) || !is_plain_file(entry->path()))
      throw std::invalid_argument(fmt::format("{}: holds {}, which is no frame of a turntable; give an empty folder",
                                              folder.string(), entry->path().filename().string()));
    earlier.push_back(entry->path());
  }
  make_folder(folder);
  require_writable_folder(folder);
  for (const fs::path& file : earlier) fs::remove(file, error);
}

}  // namespace nextview
