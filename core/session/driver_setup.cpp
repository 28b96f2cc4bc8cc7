#include "core/session/driver_setup.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>
#include <tuple>

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

std::string text(const Vector3& p) { return fmt::format("{} {} {}", p.x(), p.y(), p.z()); }

/// These are given from here on: no object's size changes them.
void follow_greeting(Configuration& c, const DriverGreeting& greeting) {
  const std::string owner = "the scanner";
  decide_camera(c, greeting.camera, owner);
  decide(c, "sensor.max_range", fmt::format("{}", greeting.max_range), owner);
  decide(c, "sensor.range_noise", fmt::format("{}", greeting.range_noise), owner);
  if (greeting.region)
    decide(c, "map.region", text(greeting.region->min()) + " " + text(greeting.region->max()), owner);
  auto all = settings(c);
  for (const char* key :
       {"sensor.width", "sensor.height", "sensor.intrinsics", "sensor.max_range", "sensor.range_noise", "map.region"})
    if (const Setting& setting = find_setting(all, key); !setting.text().empty())
      c.sources[key] = {key, "", setting.text()};
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

/// A scanner that is not connected.
class AbsentScanner : public ScanSource {
 public:
  explicit AbsentScanner(const Configuration& c)
      : name_(c.driver.name), description_{c.sensor.camera(), c.sensor.max_range, c.sensor.range_noise} {}
  const SourceDescription& describe() const override { return description_; }
  Result<Capture> capture(const View&, std::uint32_t, std::stop_token) override {
    return Failure{Failure::disconnected,
                   fmt::format("this was scanned with the scanner {}, which is not connected (--driver)", name_)};
  }

 private:
  std::string name_;
  SourceDescription description_;
};

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

void require_goes_on(const DriverConnection& connection, const Configuration& now, const Configuration& wanted) {
  const auto started_with = [](const DriverConfig& c) { return std::tie(c.timeout, c.hand_eye, c.working_volume); };
  if (started_with(now.driver) != started_with(wanted.driver))
    throw std::invalid_argument(
        "driver.timeout, driver.hand_eye and robot.working_volume hold from the next connection on: leave the scanner, "
        "set them, and connect it again");
  if (!connection.greeting().object.empty()) return;
  if (wanted.evaluation.enabled)
    throw std::invalid_argument(
        "evaluation.enabled: what the scanner sees is not known, so nothing is compared with it");
  if (wanted.map.region.empty())
    throw std::invalid_argument("map.region: a scanner needs one; connect it again, and its first scan shows it");
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

SessionParts absent_scanner_parts(const Configuration& c) {
  SessionParts parts;
  parts.name = c.driver.name;
  parts.source = std::make_unique<AbsentScanner>(c);
  return parts;
}

}  // namespace nextview
