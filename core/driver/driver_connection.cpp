#include "core/driver/driver_connection.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "core/driver/driver_capture.hpp"
#include "core/driver/words.hpp"
#include "core/file/printable.hpp"
#include "core/progress/stopped.hpp"

namespace nextview {
namespace {

constexpr double longest_time = 1e6;  // that makes sense [s]
constexpr double usual_time = 30.0;   // where a time-out is needed and none is given [s]

void require_time(const char* name, double seconds) {
  if (!(seconds >= 0.0 && seconds <= longest_time))
    throw std::invalid_argument(fmt::format("{} is {:g} s; give 0 to {:g}", name, seconds, longest_time));
}

std::vector<std::string> words_of(const std::string& command) try {
  return shell_words(command);
} catch (const std::invalid_argument& error) {
  throw std::invalid_argument(fmt::format("the driver's command '{}': {}", printable(command), error.what()));
}

bool same(const PinholeCamera& a, const PinholeCamera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy;
}

/// Scans of one session are of one camera.
bool same_scanner(const DriverGreeting& a, const DriverGreeting& b) {
  return same(a.camera, b.camera) && a.max_range == b.max_range && a.range_noise == b.range_noise &&
         a.abilities == b.abilities && a.object == b.object && a.settings == b.settings;
}

}  // namespace

DriverConnection::DriverConnection(DriverOptions options, std::stop_token stop)
    : options_(std::move(options)), words_(words_of(options_.command)) {
  require_time("driver.timeout", options_.timeout);
  if (options_.folder.empty()) throw std::invalid_argument("a driver needs a folder for its captures");
  options_.folder = std::filesystem::absolute(options_.folder);
  const Result<DriverGreeting> greeting = start(stop);
  if (const auto* failure = std::get_if<Failure>(&greeting)) {
    if (failure->kind == Failure::cancelled) throw Stopped();
    throw std::runtime_error(failure->reason);
  }
  greeting_ = std::get<DriverGreeting>(greeting);
  if (greeting_.start) stands_at(*greeting_.start);
}

DriverConnection::~DriverConnection() {
  protocol_.reset();
  std::error_code ignored;
  if (made_folder_) std::filesystem::remove_all(options_.folder, ignored);
}

void DriverConnection::stands_at(const Pose& T_world_camera) {
  pose_ = T_world_camera;
  knows_pose_ = true;
}

Result<DriverGreeting> DriverConnection::start(const std::stop_token& stop) try {
  protocol_.reset();
  protocol_ = std::make_unique<DriverProtocol>(words_, options_.log, options_.grace, options_.stop_time);
  Result<DriverGreeting> greeting = protocol_->hello({limit(), stop});
  auto* const said = std::get_if<DriverGreeting>(&greeting);
  if (!said) protocol_.reset();
  if (said && said->start) *said->start = *said->start * options_.T_flange_camera;
  if (said)
    for (Pose& view : said->views) view = view * options_.T_flange_camera;
  return greeting;
} catch (const std::runtime_error& error) {
  return Failure{Failure::disconnected, error.what()};
}

SourceDescription DriverConnection::description() const {
  SourceDescription description{greeting_.camera, greeting_.max_range, greeting_.range_noise};
  description.start = greeting_.start;
  description.region = greeting_.region;
  return description;
}

/// Of what moves or captures [s].
double DriverConnection::patience() const { return greeting_.timeout.value_or(options_.timeout); }
/// Of what needs no person [s].
double DriverConnection::limit() const { return options_.timeout > 0.0 ? options_.timeout : usual_time; }

void DriverConnection::leave() {
  protocol_.reset();
  lost_ = true;
}

std::optional<Failure> DriverConnection::reconnect(std::stop_token stop) {
  lost_ = true;
  const Result<DriverGreeting> greeting = start(stop);
  if (const auto* failure = std::get_if<Failure>(&greeting)) return *failure;
  const auto& now = std::get<DriverGreeting>(greeting);
  if (!same_scanner(greeting_, now)) {
    protocol_.reset();
    return Failure{
        Failure::disconnected,
        fmt::format("driver {}: it is another scanner than before: camera, range, noise, abilities or object differ",
                    excerpt(now.name))};
  }
  lost_ = false;
  if (is_simulated()) {
    const Result<Pose> put_back = move(Pose(pose_), stop);
    if (const auto* failure = std::get_if<Failure>(&put_back)) return *failure;
  } else if (now.start) {
    stands_at(*now.start);
  }
  return std::nullopt;
}

namespace {

Failure not_running() { return {Failure::disconnected, "the driver does not run; reconnect"}; }

}  // namespace

/// Notes whether the driver is lost.
template <class T>
Result<T> DriverConnection::noted(Result<T> result) {
  const auto* failure = std::get_if<Failure>(&result);
  lost_ = failure && (failure->kind == Failure::disconnected || protocol_->has_ended());
  return result;
}

Result<std::vector<Reach>> DriverConnection::reach(const Pose& from, std::span<const Pose> poses) {
  if (!protocol_) return not_running();
  const Pose T_camera_flange = options_.T_flange_camera.inverse();
  std::vector<Pose> flanges;
  for (const Pose& pose : poses) flanges.push_back(pose * T_camera_flange);
  return noted(protocol_->reach(from * T_camera_flange, flanges, {limit()}));
}

Result<Pose> DriverConnection::move(const Pose& T_world_camera, std::stop_token stop) {
  if (!protocol_) return not_running();
  Result<Pose> reached =
      noted(protocol_->move(T_world_camera * options_.T_flange_camera.inverse(), {patience(), std::move(stop)}));
  if (auto* const pose = std::get_if<Pose>(&reached)) stands_at(*pose = *pose * options_.T_flange_camera);
  return reached;
}

Result<Capture> DriverConnection::capture(std::uint32_t step, std::uint64_t seed, std::stop_token stop) {
  if (!protocol_) return not_running();
  std::error_code error;
  if (std::filesystem::create_directories(options_.folder, error)) made_folder_ = true;
  if (error)
    return Failure{Failure::unusable, fmt::format("{}: the folder for captures cannot be made: {}",
                                                  printable(options_.folder.string()), error.message())};
  const Result<CapturedFile> captured =
      noted(protocol_->capture(step, seed, options_.folder, {patience(), std::move(stop)}));
  if (const auto* failure = std::get_if<Failure>(&captured)) return *failure;
  const CapturedFile& file = std::get<CapturedFile>(captured);
  const auto remove_file = [&] {
    if (std::filesystem::path(file.file).filename() == file.file)  // in our own folder: no one else's
      std::filesystem::remove(options_.folder / file.file, error);
  };
  const auto failed = [&](Failure::Kind kind, const std::exception& why) {
    remove_file();
    return Failure{kind, fmt::format("driver {}: capture: {}", protocol_->name(), why.what())};
  };
  try {
    Capture capture = read_capture(file, options_.folder, greeting_.camera, greeting_.max_range);
    remove_file();
    stands_at(capture.T_world_camera = capture.T_world_camera * options_.T_flange_camera);
    return capture;
  } catch (const NothingMeasured& why) {
    return failed(Failure::no_data, why);
  } catch (const std::runtime_error& unreadable) {
    return failed(Failure::unusable, unreadable);
  }
}

}  // namespace nextview
