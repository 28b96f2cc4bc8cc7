#include "app/commands/scanner.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <iostream>
#include <stdexcept>

#include "core/file/printable.hpp"
#include "core/setting/length_text.hpp"

namespace nextview {
namespace {

std::string text(const Pose& pose) {
  const Vector3 p = pose.translation();
  const Vector3 forward = pose.linear().col(2);
  return fmt::format("({:.3f}, {:.3f}, {:.3f}) m, looking along ({:.2f}, {:.2f}, {:.2f})", p.x(), p.y(), p.z(),
                     forward.x(), forward.y(), forward.z());
}

/// A robot moves when someone looks. Ctrl+C refuses, which reading a line would not hear of.
bool confirmed(const Pose& from, const Pose& to, const std::stop_token& stop) {
  fmt::print(stderr, "\nMove the camera by {} to {}? n ends the scan, which --resume goes on with. [y/N] ",
             length_text((to.translation() - from.translation()).norm()), text(to));
  pollfd terminal{STDIN_FILENO, POLLIN, 0};
  while (!stop.stop_requested() && ::poll(&terminal, 1, 50) <= 0) {
  }
  if (stop.stop_requested()) {
    fmt::print(stderr, "\n");
    return false;
  }
  std::string answer;
  return std::getline(std::cin, answer) && (answer == "y" || answer == "Y" || answer == "yes");
}

}  // namespace

void ScannerOptions::add_to(CLI::App& app) {
  const auto names_nothing = [](const std::string& text) {
    return text.find_first_not_of(" \t") == text.npos ? std::string("it names no program") : std::string();
  };
  CLI::Option* driver =
      app.add_option("--driver", command, "scan with a live scanner: the program that drives it, with its arguments")
          ->type_name("COMMAND")
          ->check(names_nothing)
          ->group("Live scanner");
  for (const char* other : {"OBJECT", "--recorded", "--recorded.folder"}) driver->excludes(app.get_option(other));
  app.add_option("--driver-confirm", confirm, "ask before each move of a real robot: always or never")
      ->check(one_of({"always", "never"}))
      ->capture_default_str()
      ->group("Live scanner");
}

Scanner::Scanner(const ScannerOptions& options, Configuration& configuration, const std::stop_token& stop) {
  if (!configuration.recorded.folder.empty())
    throw std::invalid_argument(
        configuration.as_given("recorded.folder: --driver scans with a live scanner and goes through no recording"));
  ScannerWishes wishes{options.command};
  if (options.confirm == "always")
    wishes.confirm = [stop](const Pose& from, const Pose& to) { return confirmed(from, to, stop); };
  wishes.log = [](const std::string& line) { fmt::print(stderr, "{}\n", printable(line)); };
  connection_ = connect_scanner(configuration, wishes, stop);
  // Before there is a session, which would be in the way of the next try.
  if (wishes.confirm && !connection_->is_simulated() && !::isatty(STDIN_FILENO))
    throw std::runtime_error(
        "a real robot is to move, and no terminal is there to confirm it: --driver-confirm never moves without asking");
}

void Scanner::reconnect(const std::stop_token& stop) {
  if (const auto failure = connection_->reconnect(stop)) throw std::runtime_error(failure->reason);
  fmt::print(stderr, "The scanner is reached again.\n");
}

}  // namespace nextview
