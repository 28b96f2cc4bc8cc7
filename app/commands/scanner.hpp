#pragma once
#include <CLI/CLI.hpp>
#include <memory>
#include <stop_token>
#include <string>

#include "core/session/driver_setup.hpp"

namespace nextview {

/// How the command line names a live scanner. These are no settings: no file may start a program.
struct ScannerOptions {
  std::string command, confirm = "always";

  /// Adds --driver and --driver-confirm to a command that has the options of ConfigurationOptions already.
  void add_to(CLI::App& app);
  bool wanted() const { return !command.empty(); }
};

/// A live scanner, used from a terminal.
class Scanner {
 public:
  /// Starts it; the configuration follows what it says of itself (connect_scanner). @throws as that
  Scanner(const ScannerOptions& options, Configuration& configuration, const std::stop_token& stop);
  SessionParts parts(const Configuration& configuration) const { return scanner_parts(configuration, connection_); }
  bool is_lost() const { return connection_->is_lost(); }
  /// @throws std::runtime_error with the reason
  void reconnect(const std::stop_token& stop);

 private:
  std::shared_ptr<DriverConnection> connection_;
};

}  // namespace nextview
