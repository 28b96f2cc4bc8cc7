#include "app/commands/opened_session.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/driver_setup.hpp"
#include "core/session/saved_session.hpp"

namespace nextview {

std::unique_ptr<Session> opened_session(const std::filesystem::path& folder, const std::optional<int>& views,
                                        const ProgressLine& progress, const std::stop_token& stop) {
  SavedSession saved = read_session(folder);
  const Configuration& c = saved.configuration;
  SessionParts parts = c.driver.name.empty() ? SessionParts{} : absent_scanner_parts(c);
  auto session = std::make_unique<Session>(c, std::move(parts), progress, stop);
  std::stop_source enough;
  const std::stop_callback user_stops(stop, [&] { enough.request_stop(); });
  const auto wanted = views ? static_cast<std::size_t>(*views) : std::numeric_limits<std::size_t>::max();
  const auto stop_where_wanted = [&](std::uint32_t) {
    if (session->records().size() == wanted) enough.request_stop();
  };
  // All of it is there at once, a part of it is gone through again.
  if (views)
    restore(*session, saved, nullptr, stop_where_wanted, progress, enough.get_token());
  else
    restore(*session, saved, nullptr, {}, progress, stop);
  progress.clear();
  throw_if_stopped(stop);
  for (const std::string& notice : saved.notices)
    fmt::print(stderr, "notice: {}\n", printable(fmt::format("{}: {}", folder.string(), notice)));
  if (const std::size_t there = session->records().size(); views && there < wanted)
    throw std::invalid_argument(fmt::format("--step {}: {} has {}", *views, folder.string(), counted(there, "view")));
  return session;
}

}  // namespace nextview
