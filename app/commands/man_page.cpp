#include "app/commands/man_page.hpp"

#include <fmt/format.h>

#include <string_view>

#include "app/commands/declared_options.hpp"
#include "core/config/configuration.hpp"

namespace nextview {
namespace {

constexpr std::string_view head = R"(.TH NEXTVIEW 1 "" "nextview {}" "User Commands"
.SH NAME
nextview \- decides where a scanner should look next, and shows why
.SH SYNOPSIS
.B nextview
[\fIFILE\fR]
.br
.B nextview
\fICOMMAND\fR [\fIOPTION\fR]...
.SH DESCRIPTION
Scans an object view by view with a simulated, recorded or real depth camera, keeps a map of what is surely surface, free
and not known, and takes the view that is expected to show most new surface. Without a command it opens the window, with
the mesh, the recorded scans or the session that is named.
.PP
\fBnextview help\fR has the manual, by topics; \fBnextview\fR \fICOMMAND\fR \fB\-\-help\fR the options of a command with
all settings.
)";

constexpr std::string_view tail = R"(.SH EXIT STATUS
.TP
0
what was asked for is done
.TP
2
it could not be done: one line on standard error names the file or setting, and the reason
.TP
130
stopped by Ctrl+C; a session is kept and goes on with \fBnextview scan \-\-resume\fR
.SH ENVIRONMENT
.TP
.B DISPLAY
where the window opens; all commands but the window do without
.TP
.B XDG_STATE_HOME
holds the folder \fInextview\fR of the window's untitled sessions (else \fI~/.local/state\fR)
.TP
.B NEXTVIEW_ASSETS
a folder of objects, sensors, configurations, demos and manual in the place of those installed
)";

/// What roff would take for its own: backslashes, hyphens, and a dot or a quote at the beginning of a line.
std::string roff(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') escaped += "\\e";
    if (c == '-') escaped += "\\-";
    if (c == '\n') escaped += ' ';
    if ((c == '.' || c == '\'') && escaped.empty()) escaped += "\\&";
    if (c != '\\' && c != '-' && c != '\n') escaped += c;
  }
  return escaped;
}

std::string entry(std::string_view name, std::string_view text) {
  return fmt::format(".TP\n.B {}\n{}\n", roff(name), roff(text));
}

/// What it may be and is, behind what it does.
std::string explanation(const Setting& setting) {
  std::string text = setting.explanation();
  if (const auto* choice = std::get_if<Setting::Choice>(&setting.value))
    text += fmt::format("; one of {}", fmt::join(choice->names, ", "));
  const std::string value = setting.text();
  return value.empty() ? text : fmt::format("{} (default {})", text, value);
}

}  // namespace

std::string man_page(const CLI::App& program) {
  const std::string version = program.version();
  std::string page = fmt::format(head, roff(version.substr(version.rfind(' ') + 1)));
  page += ".SH COMMANDS\n";
  for (const CLI::App* command : program.get_subcommands({})) {
    page += fmt::format(".SS nextview {}\n{}.\n", roff(command->get_name()), roff(command->get_description()));
    for (const CLI::Option* option : own_options(*command)) page += entry(usage(*option), description(*option));
  }
  page += ".SH SETTINGS\nOf a configuration file (TOML), or as options of the commands that take them.\n";
  Configuration configuration;
  for (const Setting& setting : settings(configuration)) page += entry("--" + setting.key, explanation(setting));
  return page.append(tail);
}

}  // namespace nextview
