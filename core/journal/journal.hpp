#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/file/file_hash.hpp"
#include "core/journal/branches.hpp"
#include "core/journal/journal_file.hpp"
#include "core/registration/scan_registration.hpp"
#include "core/robot/robot.hpp"
#include "core/source/scan_source.hpp"

namespace nextview {

/// A capture that was accepted: from where, of which choice, and the file that holds it.
struct JournalStep {
  std::uint32_t number = 0;  ///< of the capture, from 1; never used again
  std::uint32_t after = 0;   ///< the step that it went on from; 0: none
  View wanted;
  std::optional<std::size_t> candidate = {};  ///< that it was chosen as; none: the start view, or a custom view
  bool is_custom = false, overridden = false;
  double gain = 0.0, utility = 0.0;        ///< that were expected of it
  std::string gain_unit = {};              ///< empty in journals of before 0.5.0, too
  Pose reached = Pose::Identity();         ///< as the robot knew it
  Pose believed = Pose::Identity();        ///< of the capture, as it came
  Pose T_world_camera = Pose::Identity();  ///< of the capture, corrected where registration did
  double max_range = 1.5;                  ///< [m]
  PinholeCamera camera = {};               ///< of ranges
  MotionCost motion;                       ///< of getting there
  std::optional<ScanRegistration> registration = {};
  std::size_t settings = 0;                    ///< how many texts of settings there were before it
  std::string scan;                            ///< file in scans/
  FileHash hash;                               ///< of it
  std::map<std::string, double> outcome = {};  ///< what it came to, by name; empty: it was not absorbed, or not kept
  std::vector<Reach> reach = {};  ///< what a live robot then said of the candidates, without turns; empty: not kept
};

/// What a session is of: a file or folder that must still be the one it was. None of a live scanner.
struct JournalInput {
  std::string path;                   ///< relative to the session's folder if it lies inside, absolute otherwise
  std::optional<FileHash> hash = {};  ///< of a file
};

/// What a session's journal says: a tree of steps, and where in it the session stands.
struct Journal {
  std::string program;  ///< that began it
  JournalInput input;
  std::vector<std::string> settings;                 ///< texts of config.toml, the last one of now
  std::map<std::uint32_t, JournalStep> steps;        ///< by number
  std::map<std::uint32_t, std::size_t> settings_at;  ///< how many texts there were when it last stood at a step
  std::uint32_t at = 0;                              ///< the step that the session stands at; 0: before the first
  Branches branches;                                 ///< the session stands on the current one
  bool closed = false;                               ///< nobody was in the middle of it
  std::vector<std::string> damage;                   ///< what is lost of it, a line each, for people
  std::uintmax_t bytes = 0;                          ///< of the file that it was read of; 0: of none

  /// The steps from the first to where it stands, or to another one.
  std::vector<JournalStep> line() const { return line(at); }
  std::vector<JournalStep> line(std::uint32_t tip) const;
  std::uint32_t last_number() const { return steps.empty() ? 0 : steps.rbegin()->first; }
};

inline constexpr const char* journal_name = "journal";
inline constexpr const char* scans_name = "scans";

/// Whether a folder holds a session with a journal.
bool has_journal(const std::filesystem::path& folder);
/// @throws std::runtime_error naming the file and the reason: none is there, or a newer version wrote it
Journal read_journal(const std::filesystem::path& folder);
/// The capture of a step, as it came. @throws std::runtime_error naming the file and the reason, e.g. that it changed
Capture read_capture(const JournalStep& step, const std::filesystem::path& folder);

/// @throws std::runtime_error naming the file if what a session is of has changed since, or is gone
void require_same_input(const Journal& journal, const std::filesystem::path& folder);

/// Writes the journal of a session and its scans. It is locked as long as this lives.
class JournalWriter {
 public:
  /// @throws std::runtime_error naming the file and the reason; then none is left behind
  static JournalWriter begin(const std::filesystem::path& folder, const JournalInput& input,
                             const std::string& settings);
  /// Goes on with what is there, which `journal` then says: where it was read before, and the file is as long as then,
  /// it is not read again, as nothing but appending is done to it. @throws as read_journal; JournalInUse
  static JournalWriter go_on(const std::filesystem::path& folder, Journal& journal);

  /// Keeps a capture. `step` gets its file's name and hash; both are durable when this returns, and the session then
  /// stands at it. @throws std::runtime_error naming the file and the reason
  void add(JournalStep& step, const Capture& capture);
  /// The text of config.toml, from here on.
  void keep_settings(const std::string& text);
  /// The session went to another step.
  void stand_at(std::uint32_t number);
  void keep_branches(const Branches& branches);
  /// What a step came to, by name: it need not be taken again to be told of.
  void keep_outcome(std::uint32_t number, const std::map<std::string, double>& outcome);
  /// What a robot said of the candidates after a step: who goes through the session again cannot ask it.
  void keep_reach(std::uint32_t number, const std::vector<Reach>& reach);
  void close();

  const std::filesystem::path& folder() const { return folder_; }

 private:
  JournalWriter(std::filesystem::path folder, JournalFile file);

  std::filesystem::path folder_;
  JournalFile file_;
};

}  // namespace nextview
