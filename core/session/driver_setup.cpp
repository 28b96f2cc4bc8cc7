#include "core/session/driver_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "core/cloud/object_region.hpp"
#include "core/config/object_lengths.hpp"
#include "core/driver/driver_scanner.hpp"
#include "core/file/printable.hpp"
#include "core/progress/stopped.hpp"
#include "core/session/captures_folder.hpp"
#include "core/session/session_parts.hpp"

namespace nextview {
namespace {

std::filesystem::path new_captures_folder() {
  static CapturesFolder folder(std::filesystem::temp_directory_path());
  return folder.next();
}

std::string text(const Eigen::AlignedBox3d& box) {
  const Vector3 &low = box.min(), &high = box.max();
  return fmt::format("{} {} {} {} {} {}", low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
}

/// What the scanner decides is given from here on: no object's size changes it.
void follow(Configuration& c, const std::string& key, const std::string& text) {
  decide(c, key, text, "the scanner");
  auto all = settings(c);
  if (const Setting& setting = find_setting(all, key); !setting.text().empty())
    c.sources[key] = {key, "", setting.text()};
}

/// Of our simulator, so that its scans have the bytes of those with the simulated camera built in.
void follow_simulator(Configuration& c, const std::map<std::string, std::string>& own) {
  auto all = settings(c);
  for (const auto& [key, text] : own) {
    const bool may_decide = (key.starts_with("object.") || key.starts_with("sensor.")) && key != "object.file";
    if (!may_decide || std::ranges::find(all, key, &Setting::key) == all.end())
      throw std::invalid_argument(
          fmt::format("the driver decides '{}', which is no setting of a sensor or object", printable(key)));
    follow(c, key, text);
  }
}

void follow_greeting(Configuration& c, const DriverGreeting& greeting) {
  follow_simulator(c, greeting.settings);
  const PinholeCamera& k = greeting.camera;
  if (!greeting.settings.contains("sensor.intrinsics")) {  // else the settings say all of it
    follow(c, "sensor.width", fmt::format("{}", k.width));
    follow(c, "sensor.height", fmt::format("{}", k.height));
    follow(c, "sensor.intrinsics", fmt::format("{} {} {} {}", k.fx, k.fy, k.cx, k.cy));
  }
  follow(c, "sensor.max_range", fmt::format("{}", greeting.max_range));
  follow(c, "sensor.range_noise", fmt::format("{}", greeting.range_noise));
  if (greeting.region) follow(c, "map.region", text(*greeting.region));
}

/// Where the object seems to stand, as the scanner sees it from where it is.
std::string region_of_first_scan(const Configuration& c, DriverConnection& connection, const std::stop_token& stop) {
  const std::string name = connection.greeting().name;
  const Result<Capture> capture = connection.capture(1, c.seed, stop);
  if (const auto* failure = std::get_if<Failure>(&capture)) {
    if (failure->kind == Failure::cancelled) throw Stopped();
    // A capture of the wrong size, or a file that is damaged, is so wherever the camera looks.
    const bool may_look_elsewhere = failure->kind == Failure::no_data;
    throw std::runtime_error(failure->reason + (may_look_elsewhere
                                                    ? "; the first scan is to show where the object stands, unless "
                                                      "map.region gives its box: six numbers [m]"
                                                    : ""));
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
  return text(found.box);
}

/// Of an object that no one has a mesh of.
void follow_region(Configuration& c, DriverConnection& connection, const std::stop_token& stop) {
  if (c.map.region.empty()) c.map.region = c.fitted["map.region"] = region_of_first_scan(c, connection, stop);
  fit_lengths(c, c.map.region_box().sizes().maxCoeff() / 1.2);  // as large as a margin of a tenth leaves
  std::vector<Pose> places = connection.greeting().views;
  if (connection.knows_pose()) places.push_back(connection.pose());
  lengthen_rays(c, places);
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

void require_exact_robot(const Configuration& c) {
  if (c.robot.exact()) return;
  throw std::invalid_argument(
      c.as_given(fmt::format("{}: a driver's robot has its own errors; leave it out",
                             c.robot.position_error > 0.0 ? "robot.position_error" : "robot.rotation_error")));
}

std::shared_ptr<DriverConnection> connect_scanner(Configuration& c, const ScannerWishes& wishes,
                                                  const std::stop_token& stop) try {
  require_exact_robot(c);
  DriverOptions options;
  options.command = wishes.command;
  options.timeout = c.driver.timeout;
  options.working_volume = c.driver.volume();
  options.T_flange_camera = c.driver.T_flange_camera();
  options.folder = new_captures_folder();
  options.confirm = wishes.confirm;
  options.log = wishes.log;
  auto connection = std::make_shared<DriverConnection>(std::move(options), stop);
  const DriverGreeting& greeting = connection->greeting();
  follow_greeting(c, greeting);
  c.recorded.folder.clear();
  // Who simulates an object that is known is done without, another time.
  c.driver.name = connection->is_simulated() && !greeting.object.empty() ? "" : greeting.name;
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

SessionParts scanner_parts(const Configuration& c, const std::shared_ptr<DriverConnection>& connection) {
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
