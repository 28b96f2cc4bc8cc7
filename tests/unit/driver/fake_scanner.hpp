#pragma once
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>

#include "core/driver/driver_scanner.hpp"
#include "tests/unit/mesh/temporary_folder.hpp"

namespace nextview {

/// A driver that does what a test says (fake/fake_driver.cpp).
class FakeScanner {
 public:
  explicit FakeScanner(const std::string& abilities = {}, double time_out = 20.0) {
    options.command = fmt::format("'{}' '{}' {}", NEXTVIEW_FAKE_DRIVER, (folder / "fault").string(), abilities);
    options.timeout = time_out;
    options.folder = folder / "captures";
    options.stop_time = 0.2;
    options.grace = 0.05;
  }

  /// What goes wrong from now on, at a request: "nan", "move".
  void misbehave(const std::string& fault, const std::string& request) const {
    folder.write("fault", fault + " " + request);
  }
  void behave() const { folder.write("fault", ""); }

  std::shared_ptr<DriverConnection> connect() const { return std::make_shared<DriverConnection>(options); }
  /// Why there is no connection.
  std::string refusal() const {
    try {
      connect();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "it is connected";
  }

  TemporaryFolder folder;
  DriverOptions options;
};

inline Pose at(double x, double y, double z) {
  return make_pose({x, y, z}, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3(1, 2, 3).normalized())));
}

/// Why something failed; of no meaning if it did not.
template <class T>
Failure failure_of(const Result<T>& result) {
  const auto* failure = std::get_if<Failure>(&result);
  return failure ? *failure : Failure{Failure::refused, "it worked"};
}

/// Of one request, that of 0.2 s and the driver's end included, on a busy machine [s].
inline constexpr double limit = 3.0;

/// Does what a request is for, and says how it failed.
inline Failure ask_for(DriverConnection& connection, const std::string& request) {
  if (request == "reach")
    return failure_of(connection.reach(Pose::Identity(), std::vector<Pose>{at(1, 0, 0), at(0, 1, 0)}));
  if (request == "move") return failure_of(connection.move(at(1, 2, 3), {}));
  if (request == "capture") return failure_of(connection.capture(1, 7, {}));
  return connection.reconnect().value_or(Failure{Failure::refused, "it worked"});
}

inline void expect_all_is_well(DriverConnection& connection) {
  for (const char* request : {"reach", "move", "capture"})
    EXPECT_EQ(ask_for(connection, request).reason, "it worked") << request;
  EXPECT_EQ(connection.pose().matrix(), at(1, 2, 3).matrix());
}

/// What a part of a test took.
class Seconds {
 public:
  double passed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace nextview
