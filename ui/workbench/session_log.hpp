#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace nextview {

struct LogEntry {
  enum class Level { note, success, warning };
  Level level = Level::note;
  std::string text;
};

/// What happened, oldest first. Safe to use from several threads.
class SessionLog {
 public:
  using Entries = std::vector<LogEntry>;
  /// Both of one moment: only so does the count say which entries are new.
  struct Told {
    std::shared_ptr<const Entries> entries =
        std::make_shared<Entries>();  ///< never null, never changes; the last `most`
    std::size_t count = 0;            ///< of all that were added

    bool operator==(const Told&) const = default;
  };

  void add(LogEntry::Level level, std::string text);
  Told told() const;
  std::shared_ptr<const Entries> entries() const { return told().entries; }

  static constexpr std::size_t most = 500;

 private:
  mutable std::mutex mutex_;
  Told told_;
};

}  // namespace nextview
