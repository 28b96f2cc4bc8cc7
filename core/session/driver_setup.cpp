#include "core/session/driver_setup.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>

#include "core/cloud/object_region.hpp"
#include "core/config/object_lengths.hpp"
#include "core/driver/driver_scanner.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/session_parts.hpp"

namespace nextview {
namespace {

/// Of its own for each program that runs: captures of two must not meet.
std::filesystem::path captures_folder() {
  return std::filesystem::temp_directory_path() / fmt::format("nextview-captures-{}", ::getpid());
}

/// The scanner's own; another one that was asked for is an error, not a wish.
void follow(Configuration& c, const std::string& key, const std::string& text) {
  auto all = settings(c);
  Setting& setting = find_setting(all, key);
  const std::string asked = setting.text();
  setting.set(text);
  const std::string own = setting.text();
  if (c.sources.contains(key) && asked != own) {
    setting.set(asked);  // which the message names as it was given
    throw std::invalid_argument(c.as_given(fmt::format("{}: the scanner's own is {}; leave it out", key, own)));
  }
  c.sources[key] = {key, "", own};
}

std::string text(const Vector3& p) { return fmt::format("{} {} {}", p.x(), p.y(), p.z()); }

void follow_greeting(Configuration& c, const DriverGreeting& greeting) {
  const PinholeCamera& camera = greeting.camera;
  follow(c, "sensor.width", fmt::format("{}", camera.width));
  follow(c, "sensor.height", fmt::format("{}", camera.height));
  follow(c, "sensor.intrinsics", fmt::format("{} {} {} {}", camera.fx, camera.fy, camera.cx, camera.cy));
  follow(c, "sensor.max_range", fmt::format("{}", greeting.max_range));
  follow(c, "sensor.range_noise", fmt::format("{}", greeting.range_noise));
  if (greeting.region) follow(c, "map.region", text(greeting.region->min()) + " " + text(greeting.region->max()));
}

/// Where the object seems to stand, as the scanner sees it from where it is.
std::string region_of_first_scan(const Configuration& c, DriverConnection& connection, const std::stop_token& stop) {
  const std::string name = connection.greeting().name;
  const Result<Capture> capture = connection.capture(1, c.seed, stop);
  if (const auto* failure = std::get_if<Failure>(&capture)) {
    if (failure->kind == Failure::cancelled) throw Stopped();
    throw std::runtime_error(fmt::format(
        "{}; the first scan was to show where the object stands: or give its box as map.region, six numbers [m]",
        failure->reason));
  }
  const auto scan = std::make_shared<const Scan>(to_scan(std::get<Capture>(capture), &c.cloud, stop).scan);
  ObjectRegionConfig config;
  config.remove_planes = c.map.remove_planes;
  config.range_noise = connection.greeting().range_noise;
  const ObjectRegion found = find_object({&scan, 1}, config, stop);
  if (found.box.isEmpty())
    throw std::runtime_error(
        fmt::format("{} sees no object from where it stands: give its box as map.region, six numbers [m]", name));
  if (const auto& log = connection.options().log) log(found.text());
  return text(found.box.min()) + " " + text(found.box.max());
}

/// Of an object that no one has a mesh of.
void follow_region(Configuration& c, DriverConnection& connection, const std::stop_token& stop) {
  if (c.map.region.empty()) {
    c.map.region = region_of_first_scan(c, connection, stop);
    c.fitted["map.region"] = c.map.region;
  }
  fit_lengths(c, c.map.region_box().sizes().maxCoeff() / 1.2);  // as large as a margin of a tenth leaves
  set_unless_given(c, "sensor.min_range", "0");
  c.evaluation.enabled = false;
}

}  // namespace

std::shared_ptr<DriverConnection> connect_scanner(Configuration& c, const ScannerWishes& wishes,
                                                  const std::stop_token& stop) try {
  DriverOptions options;
  options.command = wishes.command;
  options.timeout = c.driver.timeout;
  options.working_volume = c.driver.volume();
  options.T_flange_camera = c.driver.T_flange_camera();
  options.folder = captures_folder();
  options.confirm = wishes.confirm;
  options.log = wishes.log;
  auto connection = std::make_shared<DriverConnection>(std::move(options), stop);
  const DriverGreeting& greeting = connection->greeting();
  follow_greeting(c, greeting);
  c.recorded.folder.clear();
  c.driver.name = connection->is_simulated() ? "" : greeting.name;
  if (greeting.object.empty())
    follow_region(c, *connection, stop);
  else
    c.object.file = greeting.object;
  return connection;
} catch (const std::invalid_argument& error) {
  throw std::invalid_argument(c.as_given(error.what()));
}

SessionParts scanner_parts(const Configuration& c, std::shared_ptr<DriverConnection> connection) {
  SessionParts parts;
  parts.name = connection->greeting().name;
  parts.source = std::make_unique<DriverSource>(connection, c.seed);
  parts.robot = std::make_unique<DriverRobot>(connection, configured_start_view(c));
  if (const auto& views = connection->greeting().views; !views.empty())
    parts.candidates = std::make_unique<FixedCandidates>(views_at(views));
  return parts;
}

}  // namespace nextview
