#include "core/memory/available_memory.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t left_of(std::uint64_t limit, std::uint64_t taken) { return limit > taken ? limit - taken : 0; }

/// What the process's own limits leave.
std::uint64_t left_by_limits() {
  std::array<std::uint64_t, 7> pages{};  // total, resident, shared, text, library, data, dirty
  std::ifstream statm("/proc/self/statm");
  for (std::uint64_t& n : pages) statm >> n;
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  const auto left = [&](auto resource, std::uint64_t taken) {
    rlimit limit{};
    const bool limited = ::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return limited ? left_of(limit.rlim_cur, taken) : unlimited;
  };
  return std::min(left(RLIMIT_AS, page * pages[0]), left(RLIMIT_DATA, page * pages[5]));
}

/// What the machine has left, swap included.
std::uint64_t left_by_machine(const fs::path& root) {
  std::ifstream meminfo(root / "proc/meminfo");
  std::uint64_t kilobytes = 0, sum = 0;
  bool found = false;
  for (std::string key; meminfo >> key;) {
    meminfo >> kilobytes;
    if (key == "MemAvailable:") found = true;
    if (key == "MemAvailable:" || key == "SwapFree:") sum += kilobytes;
    meminfo.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return found ? sum * 1024 : unlimited;
}

/// The number that a file of a control group holds; `otherwise` if there is none ("max", or no such file).
std::uint64_t number_in(const fs::path& file, std::uint64_t otherwise) {
  std::uint64_t value = 0;
  return std::ifstream(file) >> value ? value : otherwise;
}

/// Pages of files that a group would give back before anything is refused.
std::uint64_t reclaimable(const fs::path& group) {
  std::ifstream stat(group / "memory.stat");
  std::uint64_t value = 0;
  for (std::string key; stat >> key >> value;)
    if (key == "inactive_file" || key == "total_inactive_file") return value;
  return 0;
}

/// What a control group and those around it leave.
std::uint64_t left_by_group(const fs::path& root, fs::path group, const char* limit_file, const char* taken_file) {
  std::uint64_t left = unlimited;
  for (group = group.relative_path();; group = group.parent_path()) {
    const fs::path folder = root / group;
    const std::uint64_t limit = number_in(folder / limit_file, unlimited);
    if (limit != unlimited)
      left = std::min(left, left_of(limit + reclaimable(folder), number_in(folder / taken_file, 0)));
    if (group.empty()) return left;
  }
}

std::uint64_t left_by_groups(const fs::path& root) {
  std::uint64_t left = unlimited;
  const fs::path all = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");  // lines HIERARCHY:CONTROLLERS:PATH
  for (std::string line; std::getline(groups, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
    if (controllers.empty())
      left = std::min(left, left_by_group(all, path, "memory.max", "memory.current"));
    else if (controllers == "memory")
      left = std::min(left, left_by_group(all / "memory", path, "memory.limit_in_bytes", "memory.usage_in_bytes"));
  }
  return left;
}

std::string gigabytes(std::uint64_t bytes) {
  const double value = static_cast<double>(bytes) / 1e9;
  return value < 0.095 ? fmt::format("{:.0f} MB", 1e3 * value) : fmt::format("{:.1f} GB", value);
}

}  // namespace

std::uint64_t available_memory(const fs::path& root) {
  return std::min({left_by_limits(), left_by_machine(root), left_by_groups(root)});
}

void return_freed_memory() { ::malloc_trim(0); }

void require_memory(std::uint64_t bytes, std::string_view what, std::string_view advice) {
  constexpr std::uint64_t reserve = std::uint64_t{48} << 20;  // for what is small, and for the stacks of threads
  const std::uint64_t available = left_of(available_memory(), reserve);
  if (bytes <= available) return;
  throw OutOfMemory(
      fmt::format("{} needs {}, {} are available: {}", what, gigabytes(bytes), gigabytes(available), advice));
}

}  // namespace nextview
