#include <fmt/format.h>

#include <algorithm>

#include "core/file/atomic_file.hpp"
#include "ui/window/command_list.hpp"
#include "ui/window/known_objects.hpp"

namespace nextview {
namespace {

std::vector<std::string> objects(const SessionSnapshot&) { return {known_objects().begin(), known_objects().end()}; }

std::vector<std::string> setting_keys(const SessionSnapshot&) {
  Configuration configuration;
  std::vector<std::string> keys;
  for (const Setting& setting : settings(configuration)) keys.push_back(setting.key);
  return keys;
}

constexpr std::string_view kept = "termination.";  // settings that leave the scan as it is

/// What ends a scan may change while it goes on; the views depend on all else. Nothing happens if the setting is so
/// already.
void change_setting(CommandTarget& target, const std::string& key, const std::string& text) {
  Configuration configuration = target.session.configuration;
  auto all = settings(configuration);
  give(configuration, key, text, fmt::format("{} ({})", find_setting(all, key).label(), key));
  configuration.validate();
  if (to_toml(configuration) == to_toml(target.session.configuration)) return;
  if (key.starts_with(kept)) return target.worker.post(request::SetTermination{configuration.termination});
  target.worker.post(request::Load{configuration});
}

std::string default_of(const std::string& key) {
  Configuration defaults;
  auto all = settings(defaults);
  return find_setting(all, key).text();
}

}  // namespace

std::vector<Command> file_commands() {
  const Argument setting_key{"key", Argument::Kind::choice, "as in the configuration file", 0, 0, setting_keys};
  return {
      {"open",
       "File",
       "Open an object or settings…",
       "Scans another object (a mesh file or a known name), or with the settings of a .toml file.",
       {{"file", Argument::Kind::file, "a mesh file, a known object, or a .toml file", 0, 0, objects}},
       {{key('O'), true}},
       [](CommandTarget& t, const Arguments& a) { t.worker.post(request::OpenFile{a.text(0)}); }},
      {"set",
       "File",
       "Change a setting…",
       "Changes a setting; starts the scan over, unless it is a termination setting.",
       {setting_key, {"value", Argument::Kind::text, "what it is to be"}},
       {},
       [](CommandTarget& t, const Arguments& a) { change_setting(t, a.text(0), a.text(1)); },
       needs_session},
      {"reset-setting",
       "File",
       "Set a setting back…",
       "Gives a setting its default again; starts the scan over, unless it is a termination setting.",
       {setting_key},
       {},
       [](CommandTarget& t, const Arguments& a) { change_setting(t, a.text(0), default_of(a.text(0))); },
       needs_session},
      {"reset-settings",
       "File",
       "Set all settings back",
       "Starts over with the default settings; the object stays.",
       {},
       {},
       [](CommandTarget& t, const Arguments&) {
         Configuration configuration;
         configuration.object = t.session.configuration.object;
         t.worker.post(request::Load{configuration});
       },
       needs_session},
      {"export",
       "File",
       "Export the scan…",
       "Writes what `nextview scan` writes: map, cloud, surfaces, tables, configuration.",
       {{"folder", Argument::Kind::file, "a folder; it is made if it is not there"}},
       {{key('E'), true}},
       [](CommandTarget& t, const Arguments& a) { t.worker.post(request::Export{a.text(0)}); },
       needs_view},
      {"save-picture",
       "File",
       "Save a picture…",
       "Writes the window as a PNG picture.",
       {{"file", Argument::Kind::file, "a file that ends in .png"}},
       {},
       [](CommandTarget& t, const Arguments& a) { t.window.picture_file = a.text(0); }},
      {"save-script",
       "File",
       "Save the commands so far…",
       "Writes what was done in this window as a script, to be done again with `nextview window --script`.",
       {{"file", Argument::Kind::file, "a text file"}},
       {},
       [](CommandTarget& t, const Arguments& a) {
         write_file(a.text(0), fmt::format("{}\n", fmt::join(t.window.script, "\n")));
         t.worker.log().add(LogEntry::Level::success, "Script written to " + a.text(0));
       }},
      {"quit",
       "File",
       "Quit",
       "Closes the window.",
       {},
       {{key('Q'), true}},
       [](CommandTarget& t, const Arguments&) { t.window.quit = true; }},
  };
}

}  // namespace nextview
