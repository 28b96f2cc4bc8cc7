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

  void add(LogEntry::Level level, std::string text);
  std::shared_ptr<const Entries> entries() const;  ///< never null, never changes; the last `most` of them
  std::size_t count() const;                       ///< of all that were added

  static constexpr std::size_t most = 500;

 private:
  mutable std::mutex mutex_;
  std::size_t count_ = 0;
  std::shared_ptr<const Entries> entries_ = std::make_shared<Entries>();
};

}  // namespace nextview
