#include "ui/commands/file_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <type_traits>

#include "core/config/known_objects.hpp"
#include "core/config/opened_input.hpp"
#include "core/file/atomic_file.hpp"
#include "core/setting/quantity.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/demo_file.hpp"
#include "ui/commands/needs.hpp"
#include "ui/commands/openable.hpp"
#include "ui/commands/recording_commands.hpp"
#include "ui/commands/window_commands.hpp"

namespace nextview {
namespace {

std::vector<std::string> objects(const SessionSnapshot&) { return {known_objects().begin(), known_objects().end()}; }

std::vector<std::string> setting_keys(const SessionSnapshot&) {
  Configuration configuration;
  std::vector<std::string> keys;
  for (const Setting& setting : settings(configuration)) keys.push_back(setting.key);
  return keys;
}

ArgumentOf<std::string> setting_key() { return argument::name("key", "as in the configuration file", setting_keys); }

Setting setting(Configuration& configuration, const std::string& key) {
  auto all = settings(configuration);
  return find_setting(all, key);
}

/// As the Session panel calls a setting.
std::string field_name(const Setting& setting) { return setting.key == "map.resolution" ? "Voxel" : setting.label(); }

/// As a message begins with it: "Views (termination.views)".
std::string shown_name(const Setting& setting) {
  std::string name = field_name(setting);
  name.front() = char(std::toupper(static_cast<unsigned char>(name.front())));
  return setting.key.find('.') == setting.key.npos ? name : fmt::format("{} ({})", name, setting.key);
}

constexpr const char* sensor_preset = "sensor.preset";  // sets other settings, too

/// What ends a scan and what ranks which views may change while it goes on; what was scanned depends on all else.
/// Before the first view the candidates are those that coverage is a share of. Nothing happens if the setting is so
/// already.
void change_setting(CommandTarget& target, const std::string& key, Configuration wanted) {
  wanted.validate();
  const bool is_so = to_toml(wanted) == to_toml(target.session.configuration);
  const bool changes_share = key.starts_with("views.") && target.session.records.empty();
  if (keeps_scan(key) && !changes_share) {
    // What waits may change it first: then it is to be changed back.
    if (!is_so || target.progress.busy) target.worker.post(request::ChangeSetting{key, setting(wanted, key).text()});
  } else if (!is_so) {
    target.worker.post(request::Load{std::move(wanted)});
  }
}

/// Fields show millimetres where a script has metres: a length with its unit is right in both.
void require_length(const Setting& wanted, const std::string& text) {
  double ignored = 0.0;
  const bool is_length = wanted.unit == "m" && std::holds_alternative<double*>(wanted.value);
  if (is_length && text.find(',') == text.npos && !read_quantity(text, wanted.unit, ignored))
    throw std::invalid_argument(
        fmt::format("{} takes a length with its unit, such as 5 mm, not '{}'", shown_name(wanted), text));
}

void set_as_text(CommandTarget& target, const std::string& key, const std::string& text) {
  Configuration configuration = target.session.configuration;
  const Setting wanted = setting(configuration, key);
  require_length(wanted, text);
  give(configuration, key, text, shown_name(wanted));
  change_setting(target, key, configuration);
}

void copy_value(const Setting& from, Setting& to) {
  const auto copy = [&]<class Value>(Value& value) {
    const Value& source = std::get<Value>(from.value);
    if constexpr (std::is_pointer_v<Value>) {
      *value = *source;
    } else {
      value.set(source.get());
    }
  };
  std::visit(copy, to.value);
}

void set_from(CommandTarget& target, const std::string& key, Configuration wanted) {
  Configuration configuration = target.session.configuration;
  if (key == sensor_preset) {
    apply_sensor_preset(configuration, wanted.sensor_preset);
  } else {
    Setting changed = setting(configuration, key);
    copy_value(setting(wanted, key), changed);
    configuration.sources[key] = {shown_name(changed), "", changed.text()};
  }
  change_setting(target, key, configuration);
}

/// "Voxel = 5 mm", as a question begins; the six coordinates of a box say nothing to people.
std::string change_text(const Setting& wanted) {
  if (wanted.key == "map.region") return wanted.text().empty() ? "The region as it was" : "Another region of interest";
  const auto* length = wanted.unit == "m" ? std::get_if<double*>(&wanted.value) : nullptr;
  std::string text = fmt::format("{} = {}", field_name(wanted), length ? quantity_text(**length) : wanted.text());
  text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// `values`: a key, and what it is to be; its default without.
CommandQuestion ask_before_restart(const CommandState& t, const std::vector<std::string>& values) {
  const std::string& key = values.at(0);
  Configuration now = t.session.configuration, standard;
  const bool is_known = std::ranges::any_of(settings(now), [&](const Setting& s) { return s.key == key; });
  if (!is_known || keeps_scan(key)) return {};
  const std::string before = setting(now, key).text();
  try {
    give(now, key, values.size() > 1 ? values[1] : setting(standard, key).text(), key);
    now.validate();
  } catch (const std::exception&) {
    return {};  // it will be refused, and nothing is lost
  }
  const Setting wanted = setting(now, key);
  if (wanted.text() == before) return {};
  return restart_question(t, change_text(wanted));
}

/// A file that is dropped by accident stops a robot, too.
CommandQuestion with_scanner(CommandQuestion question, const CommandState& t) {
  if (t.session.live)
    question.text += fmt::format(
        "{}The scanner is left, and what it does is stopped: undo, and then Reach the scanner again, go on with it.",
        question.text.empty() ? "" : " ");
  return question;
}

/// The settings of a file start the scan over as any other does; another object, everybody knows, takes its place.
CommandQuestion ask_before_opening(const CommandState& t, const std::vector<std::string>& values) {
  const std::filesystem::path file = values.at(0);
  if (is_demo_file(file)) return command::play_demo.question(t, values);
  const bool is_settings = carries_settings(file);
  const CommandQuestion question =
      with_scanner(is_settings ? restart_question(t, fmt::format("Taking the settings of {}", file.filename().string()))
                               : CommandQuestion{what_is_lost(t, true), "Open"},
                   t);
  if (question.text.empty()) return question;  // and nothing is looked at: only the worker reads
  try {
    require_openable(t.session, file);
    return question;
  } catch (const std::exception&) {
    return {};  // it will be refused, and nothing is lost
  }
}

CommandQuestion ask_before_quitting(const CommandState& t, const std::vector<std::string>&) {
  CommandQuestion question{what_is_lost(t, false), "Quit"};
  if (t.session.kept || t.session.records.empty()) return question;
  question.other = "Export…";
  question.instead = command::file_dialog(command::export_scan.name);
  return question;
}

void open_file(CommandTarget& t, const std::string& file) {
  if (is_demo_file(file)) return execute(command::play_demo(file), t);
  if (t.progress.busy) require_openable(t.session, file);  // what runs is not ended for what is refused
  t.worker.post(request::OpenFile{file});
}

std::string reset_settings_why_not(const CommandState& t) {
  return t.session.live ? "the scanner's own are among them: connect it again" : needs_session(t);
}

}  // namespace

bool keeps_scan(std::string_view key) {
  return key.starts_with("termination.") || key.starts_with("planner.") || key.starts_with("views.") ||
         key.starts_with("gibbs.");
}

const CommandOf<std::string> command::open{
    {"open",
     "File",
     "Open an object, scans, a map…",
     "Scans another object (a mesh file or a known name), goes through recorded scans (a folder, .graph, .log, .txt), "
     "goes on with a session (its folder), shows a map (.ot, .bt), takes the settings of a .toml file or of a picture "
     "(.png) that carries them, or plays a demo (.nextview).",
     {{key('O'), true}},
     {},
     {},
     false,
     ask_before_opening},
    argument::file("file", "a mesh file, a known object, recorded scans, a map, or a .toml file", objects),
    open_file};

const CommandOf<std::string, std::string> command::set{
    {"set",
     "File",
     "Change a setting…",
     "Changes a setting. Those of planner, gibbs, views and termination keep the scan, the others start it over.",
     {},
     needs_session,
     {},
     false,
     ask_before_restart},
    setting_key(),
    argument::text("value", "what it is to be"),
    set_as_text};

const CommandOf<std::string> command::reset_setting{
    {"reset-setting",
     "File",
     "Set a setting back…",
     "Gives a setting its default again. Those of planner, gibbs, views and termination keep the scan, the others "
     "start it over.",
     {},
     needs_session,
     {},
     false,
     ask_before_restart},
    setting_key(),
    [](CommandTarget& t, const std::string& key) { set_from(t, key, Configuration()); }};

const CommandOf<> command::reset_settings{
    {"reset-settings",
     "File",
     "Set all settings back",
     "Starts over with the default settings; the object stays.",
     {},
     reset_settings_why_not,
     {},
     false,
     [](const CommandState& t, const auto&) { return restart_question(t, "All settings as they were"); }},
    [](CommandTarget& t) {
      Configuration configuration;
      configuration.object = t.session.configuration.object;
      configuration.recorded = t.session.configuration.recorded;
      t.worker.post(request::Load{configuration});
    }};

const CommandOf<std::string> command::export_scan{
    {.name = "export",
     .menu = "File",
     .text = "Export the scan…",
     .help = "Writes what `nextview scan` writes: map, cloud, surfaces, tables, configuration; and the Gibbs map.",
     .shortcuts = {{key('E'), true}, {key('S'), true}},
     .why_not = needs_view,
     .writes = true},
    argument::file("folder", "a folder; it is made if it is not there", argument::fixed({"my_scan"})),
    [](CommandTarget& t, const std::string& folder) { t.worker.post(request::Export{folder}); }};

const CommandOf<std::string> command::save_script{
    {.name = "save-script",
     .menu = "File",
     .text = "Save the commands so far…",
     .help = "Writes what was done in this window as a script, to be done again with `nextview window --script`.",
     .writes = true},
    argument::file("file", "a text file", argument::fixed({"commands.txt"})),
    [](CommandTarget& t, const std::string& file) {
      write_file(file, fmt::format("{}\n", fmt::join(t.window.history.lines, "\n")));
      t.worker.log().add(LogEntry::Level::success, "Script written to " + file);
    }};

const CommandOf<> command::quit{
    {"quit", "File", "Quit", "Closes the window.", {{key('Q'), true}}, {}, {}, false, ask_before_quitting},
    [](CommandTarget& t) { t.window.quit = true; }};

}  // namespace nextview
