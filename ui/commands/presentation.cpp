#include "ui/commands/presentation.hpp"

#include <algorithm>

namespace nextview {
namespace {

constexpr double fade = 0.35;   // [s]
constexpr double least = 1e-9;  // sums of frames' times are not exact [s]

void age(std::optional<ShownText>& shown, double seconds) {
  if (!shown) return;
  shown->age += seconds;
  if (shown->is_over()) shown.reset();
}

}  // namespace

double ShownText::opacity() const {
  const double in = age / fade, out = length ? (*length - age) / fade : 1.0;
  return std::clamp(std::min(in, out), 0.0, 1.0);
}

double ShownText::left() const { return length ? std::max(*length - age, 0.0) : 0.0; }

void Presentation::show_caption(const std::string& text, std::optional<double> seconds) {
  leaving_caption.reset();
  if (caption && caption->opacity() > 0) {
    leaving_caption = std::move(caption);
    leaving_caption->length = std::min(leaving_caption->length.value_or(1e9), leaving_caption->age + fade);
  }
  caption.reset();
  if (!text.empty()) caption = ShownText{text, "", leaving_caption ? -fade : 0.0, seconds};
}

void Presentation::show_title(const std::string& text, const std::string& subtitle, double seconds) {
  const double before = time > 0 ? 0.0 : fade;
  title = ShownText{text, subtitle, before, before + seconds};
}

void Presentation::wait(std::optional<double> seconds) { hold = seconds.value_or(left()); }

bool Presentation::holds() const { return hold > least; }

double Presentation::left() const {
  double longest = 0, flying = 0;
  for (const auto& shown : {caption, leaving_caption, title, highlight})
    if (shown) longest = std::max(longest, shown->left());
  for (const CameraFlight& flight : flights) flying += flight.seconds - flight.elapsed;
  return std::max(longest, flying);
}

bool Presentation::is_moving() const {
  return holds() || !flights.empty() || left() > 0 || (caption && caption->opacity() < 1);
}

double Presentation::pass(double seconds, bool script_plays) {
  if (paused) return 0;
  double now = seconds;
  if (script_plays) {
    if (holds()) due += seconds;
    now = std::min(due, hold);
    hold -= now;
    due -= now;
    if (due < least) due = 0;
  }
  time += now;
  for (auto* shown : {&caption, &leaving_caption, &title, &highlight}) age(*shown, now);
  return now;
}

double eased(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * t * (t * (6 * t - 15) + 10);
}

}  // namespace nextview
