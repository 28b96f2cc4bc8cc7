#include "ui/commands/scanner_commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "ui/commands/command_target.hpp"

namespace nextview {
namespace {

std::string needs_scanner(const CommandState& s) { return s.session.live ? "" : "no scanner is connected (connect)"; }

std::string needs_question(const CommandState& s) {
  return s.progress.question.empty() ? "nothing waits for an answer" : "";
}

}  // namespace

const CommandOf<std::string> command::connect{
    {"connect", "File", "Connect a scanner…",
     "Scans with a live scanner: starts the program that drives it (assets/drivers has examples)."},
    argument::text("command", "the program and its arguments, as in a shell"),
    [](CommandTarget& t, const std::string& words) { t.worker.post(request::Connect{words}); }};

const CommandOf<> command::disconnect{
    {"disconnect", "File", "Leave the scanner", "Goes back to what was scanned before it.", {}, needs_scanner},
    [](CommandTarget& t) { t.worker.post(request::Disconnect{}); }};

const CommandOf<> command::reconnect{{"reconnect",
                                      "File",
                                      "Reach the scanner again",
                                      "Starts its program anew; the scan goes on where it is.",
                                      {},
                                      needs_scanner},
                                     [](CommandTarget& t) { t.worker.post(request::Reconnect{}); }};

const CommandOf<std::string> command::answer{
    {"answer",
     "Scan",
     "Answer the question…",
     "Answers what a scan waits for: whether a robot may move, or what becomes of a scan that does not fit.",
     {},
     needs_question},
    argument::text("answer", "as its button says"),
    [](CommandTarget& t, const std::string& text) {
      if (std::ranges::find(t.progress.answers, text) == t.progress.answers.end())
        throw std::invalid_argument(
            fmt::format("answer: '{}' is none; there are {}", text, fmt::join(t.progress.answers, ", ")));
      t.worker.answer(text);
    }};

}  // namespace nextview
