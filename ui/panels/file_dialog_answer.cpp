// What a file dialog takes for an answer.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/config/opened_input.hpp"
#include "core/export/export_kind.hpp"
#include "core/file/read_file.hpp"
#include "core/journal/journal.hpp"
#include "core/session/untitled_sessions.hpp"
#include "ui/commands/demo_file.hpp"
#include "ui/commands/window_commands.hpp"
#include "ui/panels/file_dialog.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// A name without an ending has that of the one that is proposed, so that it is known what would be replaced.
fs::path with_ending(fs::path file, const fs::path& proposed) {
  if (!file.has_extension()) file += proposed.extension();
  return file;
}

}  // namespace

std::string FileDialog::why_not(const FolderEntry& entry) const {
  if (!to_read_ || entry.is_folder) return "";
  if (!plays_) return is_demo_file(entry.name) ? "" : entry.not_opened;
  return is_demo_file(entry.name) ? "" : "no demo: those end in .nextview";
}

std::string FileDialog::why_not_read(const fs::path& file) const {
  const std::string name = file.filename().string();
  if (!is_there(file))
    return fmt::format("{}: there is no such file, nor {} of this name.", name, plays_ ? "a demo" : "an object");
  if (::access(file.c_str(), R_OK) != 0) return fmt::format("{}: {}", name, std::generic_category().message(errno));
  try {
    if (is_demo_file(file)) require_data(read_demo(file.string()));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  std::error_code ignored;
  return is_demo_file(file) || fs::is_directory(file, ignored) ? "" : not_an_input(file);
}

std::string FileDialog::why_not_written(const Command& command, const fs::path& file) {
  std::error_code ignored;
  if (command.names_folder() && is_there(file) && !fs::is_directory(file, ignored))
    return fmt::format("{} is a file: a folder is wanted.", file.filename().string());
  try {
    for (const ExportEntry& entry : export_entries())
      if (command.name == fmt::format("export-{}", entry.name)) require_ending(entry, file.filename());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

fs::path FileDialog::wanted_folder() const {
  std::error_code ignored;
  if (const fs::path meant = browser_.meant(written_); !written_.empty() && fs::is_directory(meant, ignored))
    return meant;
  const std::vector<std::size_t> found = shown();
  const bool points_at_one = (is_chosen_ || !written_.empty()) && !found.empty();
  const FolderEntry* const entry =
      points_at_one ? &browser_.entries()[found[std::min(chosen_, found.size() - 1)]] : nullptr;
  return entry && entry->is_folder ? browser_.folder() / entry->name : browser_.folder();
}

/// Names are parts of what is there while a file is looked for; what cannot be opened comes last. Of the folder of kept
/// sessions our own lists are nobody's files.
std::vector<std::size_t> FileDialog::shown() const {
  std::vector<std::size_t> found = browser_.matching(to_read_ ? written_ : "");
  if (browser_.folder() == state_folder())
    std::erase_if(found, [&](std::size_t i) { return !browser_.entries()[i].is_folder; });
  if (to_read_)
    std::ranges::stable_partition(found, [&](std::size_t i) { return why_not(browser_.entries()[i]).empty(); });
  return found;
}

void FileDialog::accept_written(const PanelContext& context, const Command& command) {
  if (written_.empty() && std::exchange(entered_, false)) return;  // who writes a folder and Enter wants to see it
  const std::vector<std::size_t> found = shown();
  const bool by_name = !written_.empty() && (!to_read_ || found.empty() || is_there(browser_.meant(written_)));
  const auto& names = command.arguments().front().choices;  // of objects, or the one that is proposed
  const auto known = names ? names(context.snapshot) : std::vector<std::string>();
  if (to_read_ && found.empty() && std::ranges::find(known, written_) != known.end())
    call(context, command, written_);
  else if (by_name)
    accept(context, command, with_ending(browser_.meant(written_), to_read_ || known.empty() ? "" : known.front()));
  else if (!found.empty())
    accept(context, command, browser_.folder() / browser_.entries()[found[std::min(chosen_, found.size() - 1)]].name);
  else
    problem_ = to_read_ ? "There is nothing here to open." : "It needs a name.";
}

/// With it the dialog closes.
void FileDialog::call(const PanelContext& context, const Command& command, const std::string& file) {
  if (to_read_) opening_ = {command.name, written_, context.snapshot.failures, ""};
  context.post(command::file_dialog());
  std::vector<std::string> values = {file};
  for (std::size_t k = 0; k < which_.size(); ++k)
    values.push_back(command.arguments()[k + 1].choices(context.snapshot).at(which_[k]));
  context.post(command.read(std::move(values)));
}

void FileDialog::accept(const PanelContext& context, const Command& command, const fs::path& file) {
  std::error_code ignored;
  const bool is_folder = fs::is_directory(file, ignored);
  const bool looked_into = is_folder && (plays_ || (to_read_ ? !has_journal(file) : !command.names_folder()));
  if (looked_into) {
    look_into(file);
    return write("");
  }
  problem_ = to_read_ ? why_not_read(file) : why_not_written(command, file);
  if (!problem_.empty()) return;  // what was written stays, to be mended
  if (!to_read_ && !is_folder && is_there(file) && replaced_ != file.string()) {
    replaced_ = file.string();
    return;
  }
  if (to_read_) {
    last_read_ = file.parent_path();
  } else {
    wanted_ = file;
    failures_ = context.snapshot.failures;
  }
  call(context, command, file.string());
}

/// A file is read once the dialog is closed: what is wrong with it is told where it was chosen, to be mended.
void FileDialog::follow_opening(const PanelContext& context) {
  if (!opening_ || context.progress.opening || !context.progress.question.empty()) return;
  const SessionSnapshot& s = context.snapshot;
  if (s.failures == opening_->failures) return opening_.reset();
  const std::string folder = browser_.folder().string() + "/";
  opening_->problem = s.message.starts_with(folder) ? s.message.substr(folder.size()) : s.message;
  context.post(command::file_dialog(opening_->command));
}

}  // namespace nextview
