#pragma once
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/robot/robot.hpp"
#include "core/source/scan_source.hpp"

namespace nextview {

/// A scanner of this program's own, as others see it through the driver protocol.
struct ServedScanner {
  std::string name;
  std::vector<std::string> abilities;  ///< "stop" is one in any case
  SourceDescription description;
  std::string object;  ///< file of the true object
  Robot& robot;
  /// The source whose noise has this seed.
  std::function<std::unique_ptr<ScanSource>(std::uint64_t seed)> source;
  std::uint64_t seed = 1;                            ///< where a request names none
  std::map<std::string, std::string> settings = {};  ///< DriverGreeting::settings
};

/// The other side of the driver protocol, version 1: answers requests, a line each, until `bye` or the end of the
/// input. Captures are written as .npy into the request's folder.
void serve(const ServedScanner& scanner, std::istream& requests, std::ostream& answers);

}  // namespace nextview
