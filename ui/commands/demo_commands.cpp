#include "ui/commands/demo_commands.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

#include "ui/commands/branch_commands.hpp"
#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

using Values = std::vector<std::string>;
using Number = std::optional<double>;

constexpr double longest = 600;  // [s]

// In the order of Quantity and Relation.
const Values quantities = {"views", "coverage", "surface-left", "entropy", "gibbs-views"};
const Values relations = {"=", "<", "<=", ">", ">="};

ArgumentOf<double> seconds(const char* help) { return argument::number("seconds", help, 0, longest); }

bool is_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// wait until done
Values without_until_done(Values values) { return values == Values{"until", "done"} ? Values{} : values; }

/// title "TEXT" "SUBTITLE" SECONDS
Values subtitle_last(Values values) {
  if (values.size() == 3 && is_number(values[2]) && !is_number(values[1])) std::swap(values[1], values[2]);
  return values;
}

/// assert views 4
Values with_relation(Values values) {
  if (values.size() == 2 && is_number(values[1])) values.insert(values.begin() + 1, "=");
  return values;
}

/// @throws std::invalid_argument if it is not known
double value_of(const SessionSnapshot& s, Quantity quantity) {
  if (quantity == Quantity::views) return double(s.records.size());
  if (quantity == Quantity::gibbs_views) return s.gibbs ? double(s.gibbs->views) : 0.0;
  if (s.records.empty()) throw std::invalid_argument("no view was taken");
  const StepRecord& last = s.records.back();
  if (quantity == Quantity::entropy) return last.entropy;
  if (quantity == Quantity::coverage && s.is_evaluated()) return last.coverage_visible;
  if (quantity == Quantity::surface_left && last.surface_left) return *last.surface_left;
  throw std::invalid_argument(fmt::format("{} is not known here", quantities[std::size_t(quantity)]));
}

/// With the first sentence that the planner says of the next view in place of {reason}.
std::string filled(std::string text, const SessionSnapshot& s) {
  constexpr std::string_view place = "{reason}";
  const std::size_t at = text.find(place);
  if (at == text.npos) return text;
  const std::string reason = s.records.empty() ? "" : s.records.back().ranking.reason;
  return text.replace(at, place.size(), reason.substr(0, reason.find(". ")));
}

bool holds(double value, Relation relation, double wanted) {
  switch (relation) {
    case Relation::equal:
      return value == wanted;
    case Relation::less:
      return value < wanted;
    case Relation::at_most:
      return value <= wanted;
    case Relation::more:
      return value > wanted;
    case Relation::at_least:
      break;
  }
  return value >= wanted;
}

}  // namespace

const CommandOf<std::string, std::optional<double>> command::caption{
    {"caption", "Demo", "Show a caption…",
     "Shows a line of text beneath the scene, until the next one or for some seconds; {reason} in it is why the "
     "next view was chosen."},
    argument::text("text", "what it says; empty: none"),
    argument::optional(seconds("for how long [s]")),
    [](CommandTarget& t, const std::string& text, std::optional<double> length) {
      t.window.presentation.show_caption(filled(text, t.session), length);
    }};

const CommandOf<std::string, double, std::optional<std::string>> command::title{
    {.name = "title",
     .menu = "Demo",
     .text = "Show a title…",
     .help = "Shows a title over the whole window; the subtitle may stand before the seconds.",
     .respell = subtitle_last},
    argument::text("text", "what it says"),
    seconds("for how long [s]"),
    argument::optional(argument::text("subtitle", "the line beneath")),
    [](CommandTarget& t, const std::string& text, double length, const std::optional<std::string>& subtitle) {
      t.window.presentation.show_title(text, subtitle.value_or(""), length);
    }};

const CommandOf<std::string, double> command::highlight{
    {"highlight", "Demo", "Highlight a panel…", "Brings a panel to the front, with a frame around it."},
    argument::name("panel", "its name", [](const SessionSnapshot&) { return panel_names(); }),
    seconds("for how long [s]"),
    [](CommandTarget& t, const std::string& panel, double length) {
      t.window.bring_to_front(panel);
      t.window.presentation.highlight = ShownText{panel, "", 0.0, length};
    }};

const CommandOf<double, double, std::optional<double>> command::orbit{
    {"orbit",
     "Demo",
     "Orbit…",
     "Moves the scene's camera around what it looks at, smoothly; motions follow one another.",
     {},
     {},
     {},
     true},
    argument::number("azimuth", "to the right [deg]", -3600, 3600),
    seconds("that it takes [s]"),
    argument::optional(argument::number("elevation", "up [deg]", -180, 180)),
    [](CommandTarget& t, double azimuth, double length, std::optional<double> elevation) {
      t.window.presentation.flights.push_back({true, azimuth, elevation.value_or(0), 1, length});
    }};

const CommandOf<double, double, double, Number, Number, Number, Number> command::fly_to{
    {.name = "fly-to",
     .menu = "Demo",
     .text = "Fly to…",
     .help = "Moves the scene's camera, smoothly, to where the object, or a point, is looked at from this direction.",
     .adds_up = true},
    argument::number("azimuth", "from x towards y [deg]", -360, 360),
    argument::number("elevation", "above the horizon [deg]", -89, 89),
    seconds("that it takes [s]"),
    argument::optional(argument::number("zoom", "how much nearer than where the object is framed", 0.01, 100)),
    argument::optional(argument::number("x", "of the point [m]", -1e4, 1e4)),
    argument::optional(argument::number("y", "of the point [m]", -1e4, 1e4)),
    argument::optional(argument::number("z", "of the point [m]", -1e4, 1e4)),
    [](CommandTarget& t, double azimuth, double elevation, double length, Number zoom, Number x, Number y, Number z) {
      if (x && !z) throw std::invalid_argument("fly-to: a point has three numbers");
      CameraFlight flight{false, azimuth, elevation, zoom.value_or(1), length};
      if (z) flight.focus = Vector3(*x, *y, *z);
      t.window.presentation.flights.push_back(flight);
    }};

/// Branches are compared where both have as many views.
const CommandOf<std::string> command::split{
    {.name = "split",
     .menu = "Demo",
     .text = "Split the scene…",
     .help = "Shows another branch beside this one, view for view: where it had as many. stop-comparing ends it.",
     .why_not = needs_other_branch},
    argument::text("branch", "its name", other_branches),
    [](CommandTarget& t, const std::string& branch) {
      t.worker.post(request::Compare{branch, true});
    }};

const CommandOf<std::optional<double>> command::wait{
    {.name = "wait",
     .menu = "Demo",
     .text = "Wait",
     .help = "Lets a script wait for some seconds, or (wait until done) until what it began is done.",
     .adds_up = true,
     .respell = without_until_done},
    argument::optional(seconds("for how long [s]; none: until motions, titles and captions have ended")),
    [](CommandTarget& t, std::optional<double> length) { t.window.presentation.wait(length); }};

const CommandOf<Quantity, Relation, double> command::assert_that{
    {.name = "assert",
     .menu = "Demo",
     .text = "Assert…",
     .help = "Fails unless a number of the scan is as a script expects it; = may be left out.",
     .why_not = needs_session,
     .respell = with_relation},
    argument::choice<Quantity>("quantity", "of the last view", quantities),
    argument::choice<Relation>("relation", "=, <, <=, > or >=", relations),
    argument::number("value", "coverage and surface-left are shares from 0 to 1", -1e9, 1e9),
    [](CommandTarget& t, Quantity quantity, Relation relation, double wanted) {
      const double value = value_of(t.session, quantity);
      if (!holds(value, relation, wanted))
        throw std::invalid_argument(fmt::format("{} is {:.6g}, not {} {:g}", quantities[std::size_t(quantity)], value,
                                                relations[std::size_t(relation)], wanted));
    }};

}  // namespace nextview
