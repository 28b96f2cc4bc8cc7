#include "ui/commands/former_commands.hpp"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <set>

namespace nextview {

std::string current_command_name(const std::string& name) {
  static const std::map<std::string, std::string> now = {{"own-view", "custom-view"},
                                                         {"take-own-view", "take-custom-view"},
                                                         {"hold-refinement", "pause-refinement"},
                                                         {"continue-refinement", "resume-refinement"}};
  const auto found = now.find(name);
  if (found == now.end()) return name;
  static std::mutex mutex;
  static std::set<std::string> said;
  const std::lock_guard lock(mutex);
  if (said.insert(name).second)
    fmt::print(stderr, "notice: the command {} is called {} now; its old name will go with version 0.6\n", name,
               found->second);
  return found->second;
}

}  // namespace nextview
