#include "app/commands/opened_session.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/driver_setup.hpp"
#include "core/session/saved_session.hpp"

namespace nextview {

namespace {

/// As it stood after so many views.
void stand_at(SavedSession& saved, int views) {
  const auto line = saved.journal->line();
  if (views < 1 || static_cast<std::size_t>(views) >= line.size()) return;
  saved.journal->at = line[static_cast<std::size_t>(views) - 1].number;
  saved.configuration = with_planning(saved.configuration, chosen_by(saved, line[static_cast<std::size_t>(views)]));
}

}  // namespace

std::unique_ptr<Session> opened_session(const std::filesystem::path& folder, const std::optional<int>& views,
                                        const ProgressLine& progress, const std::stop_token& stop) {
  SavedSession saved = read_session(folder);
  if (views && saved.journal) stand_at(saved, *views);
  const Configuration& c = saved.configuration;
  SessionParts parts = c.driver.name.empty() ? SessionParts{} : absent_scanner_parts(c);
  auto session = std::make_unique<Session>(began_with(saved), std::move(parts), progress, stop);
  std::stop_source enough;
  const std::stop_callback user_stops(stop, [&] { enough.request_stop(); });
  const auto stop_where_wanted = [&](std::uint32_t) {
    if (views && session->records().size() == static_cast<std::size_t>(*views)) enough.request_stop();
  };
  if (saved.journal)
    restore(*session, saved, nullptr, {}, progress, stop);
  else
    restore(*session, saved, nullptr, stop_where_wanted, progress, enough.get_token());
  progress.clear();
  throw_if_stopped(stop);
  for (const std::string& notice : saved.notices)
    fmt::print(stderr, "notice: {}\n", printable(fmt::format("{}: {}", folder.string(), notice)));
  if (const std::size_t there = session->records().size(); views && there < static_cast<std::size_t>(*views))
    throw std::invalid_argument(fmt::format("--step {}: {} has {}", *views, folder.string(), counted(there, "view")));
  return session;
}

}  // namespace nextview
