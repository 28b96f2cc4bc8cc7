#include "ui/workbench/session_log.hpp"

namespace nextview {

void SessionLog::add(LogEntry::Level level, std::string text) {
  const std::lock_guard lock(mutex_);
  Entries entries = *entries_;
  if (entries.size() == most) entries.erase(entries.begin());
  entries.push_back({level, std::move(text)});
  entries_ = std::make_shared<const Entries>(std::move(entries));
  ++count_;
}

std::shared_ptr<const SessionLog::Entries> SessionLog::entries() const {
  const std::lock_guard lock(mutex_);
  return entries_;
}

std::size_t SessionLog::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

}  // namespace nextview
