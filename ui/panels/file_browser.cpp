#include "ui/panels/file_browser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include "core/config/opened_input.hpp"
#include "core/file/lower_case.hpp"
#include "core/journal/journal.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most = 5000;  // of names that anybody would look through

std::vector<FolderEntry> entries_of(const fs::path& folder, std::error_code& error) {
  std::vector<FolderEntry> entries;
  for (fs::directory_iterator at(folder, error), end; !error && at != end && entries.size() < most;
       at.increment(error)) {
    std::error_code ignored;
    FolderEntry entry{.name = at->path().filename().string(), .is_folder = at->is_directory(ignored)};
    if (entry.is_folder)
      entry.is_session = has_journal(at->path());
    else if (const auto bytes = at->file_size(ignored); !ignored)
      entry.bytes = bytes;
    if (!entry.is_folder) entry.not_opened = not_an_input(at->path());
    entries.push_back(std::move(entry));
  }
  std::ranges::sort(entries, {},
                    [](const FolderEntry& e) { return std::tuple(!e.is_folder, lower_case(e.name), e.name); });
  return entries;
}

}  // namespace

void FileBrowser::go_to(const fs::path& wanted) {
  std::error_code error;
  fs::path folder = fs::absolute(wanted, error).lexically_normal();
  if (!folder.has_filename() && folder.has_parent_path()) folder = folder.parent_path();  // without a slash behind
  problem_.clear();
  for (;; folder = folder.parent_path()) {
    entries_ = entries_of(folder, error);
    if (error && problem_.empty()) problem_ = fmt::format("{}: {}", folder.string(), error.message());
    if (!error || folder == folder.parent_path()) break;
  }
  folder_ = std::move(folder);
}

std::string FileBrowser::enter(const std::string& written) {
  const std::size_t slash = written.rfind('/');
  if (slash == written.npos) return written;
  const fs::path before = meant(written.substr(0, slash + 1));
  std::error_code ignored;
  if (!fs::is_directory(before, ignored)) return written;
  go_to(before);
  return written.substr(slash + 1);
}

std::vector<std::size_t> FileBrowser::matching(std::string_view written) const {
  const std::string wanted = lower_case(written);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const bool hidden = entries_[i].name.starts_with('.') && !wanted.starts_with('.');
    if (!hidden && lower_case(entries_[i].name).find(wanted) != std::string::npos) found.push_back(i);
  }
  return found;
}

fs::path FileBrowser::meant(const std::string& written) const {
  const char* home = std::getenv("HOME");
  if (home && (written == "~" || written.starts_with("~/")))
    return fs::path(home) / fs::path(written.substr(1)).relative_path();
  return folder_ / written;  // an absolute one stays as it is
}

std::string FileBrowser::completed(const std::string& written) const {
  const std::size_t slash = written.rfind('/');
  const std::string before = slash == written.npos ? "" : written.substr(0, slash + 1);
  const std::string begun = written.substr(before.size());
  std::error_code error;
  std::string common;
  std::size_t count = 0;
  bool is_folder = false;
  for (const FolderEntry& entry : entries_of(before.empty() ? folder_ : meant(before), error)) {
    if (!entry.name.starts_with(begun) || (begun.empty() && entry.name.starts_with('.'))) continue;
    is_folder = entry.is_folder;
    if (count++ == 0) common = entry.name;
    common.resize(std::size_t(std::ranges::mismatch(common, entry.name).in1 - common.begin()));
  }
  if (count == 0) return written;
  return before + common + (count == 1 && is_folder ? "/" : "");
}

std::string size_in_words(std::uintmax_t bytes) {
  double size = double(bytes);
  for (const char* unit : {"B", "kB", "MB"}) {
    if (size < 1000) return fmt::format("{:.3g} {}", size, unit);
    size /= 1000;
  }
  return fmt::format("{:.3g} GB", size);
}

}  // namespace nextview
