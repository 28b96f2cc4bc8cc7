#include "ui/commands/measure_commands.hpp"

#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

void switch_measuring(CommandTarget& t, const std::optional<MeasureKind>& kind) {
  std::optional<Measurement>& measurement = t.window.measurement;
  if (kind || !measurement)
    measurement = Measurement{kind.value_or(MeasureKind::distance), {}};
  else if (measurement->complete())
    measurement->points.clear();
  else if (measurement->points.empty() && measurement->kind == MeasureKind::distance)
    measurement->kind = MeasureKind::plane;
  else if (measurement->points.empty() && measurement->kind == MeasureKind::plane)
    measurement->kind = MeasureKind::bore;
  else
    measurement.reset();
}

void add_point(CommandTarget& t, double x, double y, double z) {
  Measurement& measurement = *t.window.measurement;
  if (measurement.complete()) measurement.points.clear();
  measurement.points.emplace_back(x, y, z);
  if (!measurement.complete()) return;
  const auto circle = measured_circle(measurement, t.session.cloud->points);
  // It stands in the scene: told beside that, it would lie on what was measured.
  const auto level = circle && circle->doubtful ? LogEntry::Level::warning : LogEntry::Level::note;
  t.worker.log().add(level, measured_text(measurement, circle));
}

ArgumentOf<double> metres(const char* name) { return argument::number(name, "[m]", -1000, 1000); }

}  // namespace

const CommandOf<std::optional<MeasureKind>> command::measure{
    {"measure",
     "Select",
     "Measure",
     "Measures between points that are clicked: a distance, the distance of a point to a plane through three, or the "
     "diameter of a bore by three points of its rim. Again, before a click: the next of these; once it is measured: "
     "another; else no more.",
     {{key('M')}},
     needs_session,
     [](const WindowState& w) { return w.measurement.has_value(); }},
    argument::optional(argument::choice<MeasureKind>("kind", "what is measured", {"distance", "plane", "bore"})),
    switch_measuring};

const CommandOf<double, double, double> command::measure_point{
    {"measure-point",
     "Select",
     "Measure from a point…",
     "Takes the next point of what is measured. Or click on it.",
     {},
     [](const CommandState& t) { return t.window.measurement ? needs_session(t) : "nothing is measured (measure)"; },
     {},
     true},
    metres("x"),
    metres("y"),
    metres("z"),
    add_point};

}  // namespace nextview
