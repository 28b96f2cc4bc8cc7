#include "ui/commands/scanner_commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "ui/commands/command_target.hpp"
#include "ui/commands/needs.hpp"

namespace nextview {
namespace {

std::string needs_scanner(const CommandState& s) { return s.session.live ? "" : "no scanner is connected (connect)"; }

std::string needs_question(const CommandState& s) {
  return s.progress.question.empty() ? "nothing waits for an answer" : "";
}

}  // namespace

const CommandOf<std::string> command::connect{
    {.name = "connect",
     .menu = "File",
     .text = "Connect a scanner…",
     .help = "Scans with a live scanner: starts the program that drives it (assets/drivers has examples).",
     .question =
         [](const CommandState& t, const auto&) {
           return CommandQuestion{what_is_lost(t, true), "Connect"};
         }},
    argument::text("command", "the program and its arguments, as in a shell"),
    [](CommandTarget& t, const std::string& words) { t.worker.post(request::Connect{words}); }};

const CommandOf<> command::disconnect{{.name = "disconnect",
                                       .menu = "File",
                                       .text = "Leave the scanner",
                                       .help = "Goes back to what was scanned before it.",
                                       .why_not = needs_scanner,
                                       .question =
                                           [](const CommandState& t, const auto&) {
                                             return CommandQuestion{what_is_lost(t, true), "Leave"};
                                           }},
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

CommandCall answer_to(const WorkerProgress& asked, const std::string& text) {
  CommandCall call = command::answer(text);
  call.run = [text, number = asked.question_number](CommandTarget& t) { t.worker.answer(text, number); };
  return call;
}

}  // namespace nextview
