#pragma once
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "core/driver/driver_connection.hpp"
#include "core/session/session.hpp"

namespace nextview {

// What a session with a live scanner is made of.

/// How a user reaches a scanner.
struct ScannerWishes {
  std::string command;                                                 ///< "PROGRAM ARG…"
  std::function<bool(const Pose& from, const Pose& to)> confirm = {};  ///< of each real move; null: never asked
  std::function<void(const std::string&)> log = {};                    ///< hears the driver's standard error
};

/// Errors of a robot are made up for the simulated camera that is built in, and for no driver.
/// @throws std::invalid_argument naming the setting
void require_exact_robot(const Configuration& configuration);

/// Starts the driver, and lets the configuration follow what it says of itself: camera, range and noise; the object of
/// a simulator, which is then evaluated, and its settings; the region of interest.
/// @throws std::invalid_argument naming a setting that conflicts, or that is missing; std::runtime_error with the
/// reason; Stopped
std::shared_ptr<DriverConnection> connect_scanner(Configuration& configuration, const ScannerWishes& wishes,
                                                  const std::stop_token& stop = {});

/// Whether a session with another configuration than that of now can go on with the scanner.
/// @throws std::invalid_argument saying why not
void require_goes_on(const DriverConnection& connection, const Configuration& now, const Configuration& wanted);

/// The parts of a session that scans through it, with a configuration that follows it.
SessionParts scanner_parts(const Configuration& configuration, const std::shared_ptr<DriverConnection>& connection);

/// The parts of a session that was scanned so, while the scanner is away: it can be looked at, and takes no view.
SessionParts absent_scanner_parts(const Configuration& configuration);

}  // namespace nextview
