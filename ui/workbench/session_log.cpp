#include "ui/workbench/session_log.hpp"

namespace nextview {

void SessionLog::add(LogEntry::Level level, std::string text) {
  const std::lock_guard lock(mutex_);
  Entries entries = *told_.entries;
  if (entries.size() == most) entries.erase(entries.begin());
  entries.push_back({level, std::move(text)});
  told_ = {std::make_shared<const Entries>(std::move(entries)), told_.count + 1};
}

SessionLog::Told SessionLog::told() const {
  const std::lock_guard lock(mutex_);
  return told_;
}

}  // namespace nextview
