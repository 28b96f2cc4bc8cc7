#include "ui/commands/gibbs_commands.hpp"

#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

std::string refine_why_not(const CommandState& t) {
  const std::string reason = needs_view(t);
  return reason.empty() ? needs_rest(t) : reason;
}

/// A whole number, as a setting takes it.
ArgumentOf<int> like_setting(const std::string& name, const std::string& key) {
  Configuration defaults;
  auto all = settings(defaults);
  const Setting& setting = find_setting(all, key);
  return argument::whole<int>(name, setting.help, setting.bounds->low, setting.bounds->high);
}

}  // namespace

const CommandOf<std::optional<int>, std::optional<int>> command::refine{
    {"refine",
     "Gibbs",
     "Refine the map",
     "Samples the Gibbs map of all views so far until it is stationary.",
     {{key('G')}},
     refine_why_not},
    argument::optional(like_setting("chains", "gibbs.chains")),
    argument::optional(like_setting("sweeps", "gibbs.sweeps")),
    [](CommandTarget& t, std::optional<int> chains, std::optional<int> sweeps) {
      const auto& sampler = t.session.configuration.gibbs.sampler;
      t.worker.post(request::Refine{chains.value_or(sampler.chains), sweeps.value_or(sampler.sweeps)});
      t.window.bring_to_front(panel_name::gibbs);
    }};

const CommandOf<> command::pause_refinement{
    {"pause-refinement",
     "Gibbs",
     "Pause the sampler",
     "Pauses the sampler between two sweeps.",
     {{key('H')}},
     [](const CommandState& t) { return t.progress.refining && !t.progress.paused ? "" : "the sampler does not run"; }},
    [](CommandTarget& t) { t.worker.pause_refinement(true); }};

const CommandOf<> command::resume_refinement{
    {"resume-refinement",
     "Gibbs",
     "Resume the sampler",
     "Resumes the sampler after pause-refinement.",
     {{key('H')}},
     [](const CommandState& t) { return t.progress.paused ? "" : "the sampler is not paused"; }},
    [](CommandTarget& t) { t.worker.pause_refinement(false); }};

}  // namespace nextview
