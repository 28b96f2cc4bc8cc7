#include "core/recording/frame_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <stdexcept>

#include "core/file/gzip_file.hpp"
#include "core/file/inner_path.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::ptrdiff_t most_wildcards = 4;  // each more multiplies the ways that a long name can match

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes a run of digits off the front of a text, without leading zeros.
std::string_view take_number(std::string_view& text) {
  const auto end =
      std::min(text.size(), static_cast<std::size_t>(std::ranges::find_if_not(text, is_digit) - text.begin()));
  std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  while (digits.size() > 1 && digits.front() == '0') digits.remove_prefix(1);
  return digits;
}

/// What the wildcards of a pattern stand for in a name, and where the last of them ends there.
struct Match {
  std::vector<std::string_view> texts;
  std::size_t end = 0;
};

bool match(std::string_view name, std::size_t at, std::string_view pattern, Match& found) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return name.substr(at) == pattern;
  if (name.substr(at, star) != pattern.substr(0, star)) return false;
  for (std::size_t end = at + star; end <= name.size(); ++end) {
    found.texts.push_back(name.substr(at + star, end - at - star));
    const std::size_t before = found.end;
    found.end = end;
    if (match(name, end, pattern.substr(star + 1), found)) {
      found.end = std::max(found.end, end);
      return true;
    }
    found.end = before;
    found.texts.pop_back();
  }
  return false;
}

void require_pattern_within(const fs::path& folder, const fs::path& pattern) {
  const auto refuse = [&](const char* why) {
    throw std::runtime_error(fmt::format("{}: the pattern '{}' {}", folder.string(), pattern.string(), why));
  };
  if (const char* const why = why_not_within(pattern)) refuse(why);
  if (pattern.parent_path().string().find('*') != std::string::npos)
    refuse("may have a * in its last part only, the file's name");
  if (std::ranges::count(pattern.filename().string(), '*') > most_wildcards) refuse("has more than four *");
}

FrameFile frame_file(const fs::path& file, const std::string& name, const Match& found, bool has_wildcard) {
  FrameFile frame{file, name.substr(0, found.end), ""};
  if (!has_wildcard) frame.name = fs::path(name).stem().string();
  for (const std::string_view text : found.texts) {
    if (!frame.key.empty()) frame.key += '_';
    frame.key += text;
  }
  return frame;
}

}  // namespace

bool natural_order(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a, whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view x = take_number(a), y = take_number(b);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  if (a.empty() != b.empty()) return a.empty();
  return whole_a < whole_b;  // 01 and 1: an order all the same
}

bool same_key(std::string_view a, std::string_view b) {
  if (a == b) return true;
  if (a.empty() || b.empty() || !std::ranges::all_of(a, is_digit) || !std::ranges::all_of(b, is_digit)) return false;
  return take_number(a) == take_number(b);
}

std::optional<std::string> last_number(std::string_view text) {
  const std::size_t last = text.find_last_of("0123456789");
  if (last == std::string_view::npos) return std::nullopt;
  const std::size_t before = text.substr(0, last).find_last_not_of("0123456789");
  std::string_view rest = text.substr(before == std::string_view::npos ? 0 : before + 1);
  return std::string(take_number(rest));
}

std::vector<FrameFile> find_frame_files(const fs::path& folder, const std::string& pattern) {
  if (pattern.empty()) return {};
  require_pattern_within(folder, pattern);
  const fs::path place = folder / fs::path(pattern).parent_path();
  const std::string last = fs::path(pattern).filename().string();
  std::error_code error;
  std::map<std::string, fs::path> files;  // by their names without .gz
  for (fs::directory_iterator entry(place, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (!fs::is_regular_file(entry->path(), ignored)) continue;
    const std::string name = without_gz(entry->path().filename()).string();
    Match found;
    if (!match(name, 0, last, found)) continue;
    if (const auto [place_of, is_new] = files.emplace(name, entry->path());
        !is_new && entry->path().extension() != ".gz")
      place_of->second = entry->path();
  }
  if (error == std::errc::no_such_file_or_directory && fs::exists(folder)) return {};
  if (error) throw std::runtime_error(fmt::format("{}: cannot be read: {}", place.string(), error.message()));
  std::vector<FrameFile> frames;
  for (const auto& [name, file] : files) {
    Match found;
    match(name, 0, last, found);
    frames.push_back(frame_file(file, name, found, last.find('*') != std::string::npos));
  }
  std::ranges::sort(frames, [](const FrameFile& a, const FrameFile& b) {
    return natural_order(a.file.filename().string(), b.file.filename().string());
  });
  return frames;
}

}  // namespace nextview
