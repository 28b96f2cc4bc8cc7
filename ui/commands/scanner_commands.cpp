#include "ui/commands/scanner_commands.hpp"

#include "ui/commands/command_target.hpp"

namespace nextview {
namespace {

std::string needs_scanner(const CommandState& s) { return s.session.live ? "" : "no scanner is connected (connect)"; }

std::string needs_question(const CommandState& s) {
  return s.progress.question.empty() ? "no robot waits for a move to be confirmed" : "";
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

const CommandOf<> command::allow_move{
    {"allow-move", "Scan", "Allow the robot's move", "Lets the robot move to the next view.", {}, needs_question},
    [](CommandTarget& t) { t.worker.answer(true); }};

const CommandOf<> command::refuse_move{
    {"refuse-move", "Scan", "Refuse the robot's move", "Leaves the robot where it is.", {}, needs_question},
    [](CommandTarget& t) { t.worker.answer(false); }};

}  // namespace nextview
