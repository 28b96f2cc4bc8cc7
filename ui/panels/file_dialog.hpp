#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "ui/panels/file_browser.hpp"
#include "ui/panels/menu_bar.hpp"
#include "ui/panels/panel.hpp"

namespace nextview {

/// Asks for the file that a command begins with (WindowState::file_for): places and recent files at the left, the
/// folder at the right, and a field below that filters, completes and takes paths. Nothing is replaced unasked.
class FileDialog {
 public:
  void draw(const PanelContext& context, const Rectangle& place);

 private:
  void begin(const PanelContext& context, const Command& command);
  /// Opens again if what it was closed for did not come to be.
  void follow_opening(const PanelContext& context);
  void look_into(const std::filesystem::path& folder);
  void call(const PanelContext& context, const Command& command, const std::string& file);
  void draw_path();
  void draw_places(const PanelContext& context, const Command& command);
  void draw_place(const std::string& name, const std::filesystem::path& folder);
  void draw_entries(const PanelContext& context, const Command& command);
  void draw_field(const PanelContext& context, const Command& command);
  void draw_which(const Command& command, const SessionSnapshot& snapshot);
  void obey_keys(const PanelContext& context, const Command& command);
  /// Enter, or a double click: looks into a folder, does the command with a file.
  void accept(const PanelContext& context, const Command& command, const std::filesystem::path& file);
  /// With what is written, or else what is chosen.
  void accept_written(const PanelContext& context, const Command& command);
  std::string why_not(const FolderEntry& entry) const;  ///< it is of no use for the command; empty: it may be
  /// Why a file cannot be, as far as that is known at once.
  std::string why_not_read(const std::filesystem::path& file) const;
  static std::string why_not_written(const Command& command, const std::filesystem::path& file);
  /// That its button opens: what is written, or was chosen, or the one that is looked into.
  std::filesystem::path wanted_folder() const;
  std::vector<std::size_t> shown() const;  ///< places in the browser's entries
  void write(std::string text);
  void follow(ImGuiInputTextCallbackData& field);

  std::string command_;  ///< that it was begun for; empty: it is closed
  FileBrowser browser_;
  RecentMenu recent_;
  std::string written_, replaced_;  ///< replaced_: the file that the user was asked about
  std::string problem_;             ///< why what is written will not do
  std::string written_as_;          ///< its formats by their endings, and its coordinates; empty: nothing is written
  std::vector<std::size_t> which_;  ///< of several things is written: values of the arguments behind the file
  std::size_t chosen_ = 0;          ///< among those that match
  bool is_chosen_ = false;          ///< by a click or the arrow keys
  bool to_read_ = true, plays_ = false, scroll_ = false;
  bool opened_ = false;                             ///< just now: what is proposed can be written over
  bool entered_ = false;                            ///< the folder that was written, and nothing was done since
  std::filesystem::path last_read_, last_written_;  ///< folders that were used last
  std::filesystem::path wanted_;                    ///< what was to be written last
  std::size_t failures_ = 0;                        ///< of the session then
  /// What is being opened, and what was written for it.
  struct Opening {
    std::string command, written;
    std::size_t failures;  ///< of the session before
    std::string problem;   ///< why nothing came of it
  };
  std::optional<Opening> opening_;
};

}  // namespace nextview
