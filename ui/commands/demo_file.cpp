#include "ui/commands/demo_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/config/configuration.hpp"
#include "core/file/installation.hpp"
#include "core/file/read_file.hpp"
#include "core/setting/mistyped_path.hpp"
#include "ui/commands/file_commands.hpp"
#include "ui/commands/recording_commands.hpp"
#include "ui/commands/script.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr const char* ending = ".nextview";
constexpr std::uintmax_t longest_demo = std::uintmax_t{1} << 20;  // [bytes]

fs::path demos() { return shared_folder("assets") / "demos"; }

fs::path file_of(const std::string& file_or_name) {
  std::error_code error;
  const bool is_name =
      file_or_name.find_first_of("/.") == std::string::npos && !fs::is_regular_file(file_or_name, error);
  if (!is_name) return file_or_name;
  const auto names = demo_names();
  if (std::ranges::find(names, file_or_name) == names.end())
    throw std::runtime_error(fmt::format(
        "there is no demo '{}', nor a file of this name{}", file_or_name,
        did_you_mean_path(file_or_name, names, fmt::format("; there are {}", fmt::join(names, ", ")), is_demo_file)));
  return demos() / (file_or_name + ending);
}

/// The same call with its file below a folder.
CommandCall below(const CommandCall& call, const fs::path& folder) {
  if (folder.empty()) throw std::invalid_argument(call.command->name + ": a demo writes below --out only; give one");
  auto values = call.values();
  const fs::path file = fs::path(values.front()).lexically_normal();
  if (file.is_absolute() || file.empty() || *file.begin() == "..")
    throw std::invalid_argument(
        fmt::format("{}: a demo writes below --out only, not {}", call.command->name, values.front()));
  values.front() = (folder / file).string();
  CommandCall result = call.command->read(values);
  result.line = call.line;
  return result;
}

/// Behind "# needs: " at the begin of a line; empty if there is none.
std::string needs_of(const std::string& text) {
  constexpr std::string_view mark = "\n# needs: ";
  const std::size_t at = text.find(mark);
  if (at == text.npos) return "";
  const std::size_t begin = at + mark.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

std::vector<std::string> demo_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(demos(), error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ending) names.push_back(entry->path().stem().string());
  std::ranges::sort(names);
  return names;
}

bool is_demo_file(const fs::path& file) { return file.extension() == ending; }

Demo read_demo(const std::string& file_or_name, const fs::path& folder) {
  Demo demo{file_of(file_or_name), {}};
  const std::string text = read_file(demo.file, longest_demo), place = demo.file.string() + ":";
  demo.needs = needs_of(text);
  try {
    demo.calls = parse_script(text, place);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(error.what());
  }
  for (CommandCall& call : demo.calls) try {
      const bool opens_demo = call.command == &command::open && is_demo_file(call.values().front());
      if (call.command == &command::play_demo || opens_demo)
        throw std::invalid_argument(call.command->name + ": a demo plays no other");
      if (std::string_view(call.command->name) == "connect")
        throw std::invalid_argument("connect: a demo starts no program");
      if (call.command->writes) call = below(call, folder);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format("{}{}: {}", place, call.line, error.what()));
    }
  if (demo.calls.empty()) throw std::runtime_error(demo.file.string() + ": has no commands");
  return demo;
}

std::vector<std::string> missing_data(const Demo& demo) {
  std::vector<std::string> missing;
  for (const CommandCall& call : demo.calls) {
    if (call.command != &command::open) continue;
    const std::string object = call.values().front();
    std::error_code error;
    if (fs::exists(object, error)) continue;
    try {
      resolve_object(object);
    } catch (const std::exception& reason) {
      missing.push_back(fmt::format("{}:{}: {}{}{}", demo.file.string(), call.line, reason.what(),
                                    demo.needs.empty() ? "" : "; it needs ", demo.needs));
    }
  }
  return missing;
}

void require_data(const Demo& demo) {
  if (const auto missing = missing_data(demo); !missing.empty()) throw std::runtime_error(missing.front());
}

}  // namespace nextview
