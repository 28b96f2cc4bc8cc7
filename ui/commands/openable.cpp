#include "ui/commands/openable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/config/known_objects.hpp"
#include "core/config/opened_input.hpp"
#include "core/session/object_mesh.hpp"

namespace nextview {
namespace {

/// They are wrong, or what they scan is not there, or not whole.
void require_settings(const SessionSnapshot& session, const std::filesystem::path& file) {
  const Configuration wanted = with_next_input(session.configuration, file);
  wanted.validate();
  if (!session.live && wanted.recorded.folder.empty()) require_whole_object(resolve_object(wanted));
}

}  // namespace

void require_openable(const SessionSnapshot& session, const std::filesystem::path& file) {
  if (carries_settings(file)) return require_settings(session, file);
  std::error_code ignored;
  if (std::ranges::count(known_objects(), file.string()) > 0 || std::filesystem::is_directory(file, ignored)) return;
  const std::filesystem::path found = resolve_object(file.string());
  if (const std::string reason = not_an_input(found); !reason.empty())
    throw std::invalid_argument(fmt::format("{}: {}", file.string(), reason));
  require_whole_object(found);
}

}  // namespace nextview
