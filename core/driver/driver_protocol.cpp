#include "core/driver/driver_protocol.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/driver/words.hpp"
#include "core/file/json_text.hpp"
#include "core/file/printable.hpp"

namespace nextview {
namespace {

using Json = nlohmann::json;
using Received = DriverProcess::Received;

constexpr double longest_wait = 1e6;  // of the second [s]
constexpr int most_pixels = 1 << 14;  // along an edge

DriverProcess::Clock::time_point after(double seconds) {
  return DriverProcess::Clock::now() +
         std::chrono::duration_cast<DriverProcess::Clock::duration>(std::chrono::duration<double>(seconds));
}

std::optional<DriverProcess::Clock::time_point> deadline_of(double seconds) {
  return seconds > 0.0 ? std::optional(after(seconds)) : std::nullopt;
}

PinholeCamera camera_of(const DriverAnswer& answer) {
  const std::vector<double> k = answer.numbers("intrinsics", 4);
  if (!(k[0] > 0.0 && k[1] > 0.0))
    throw std::invalid_argument("'intrinsics' (fx, fy, cx, cy) need focal lengths over 0");
  return {answer.whole_number("width", 1, most_pixels),
          answer.whole_number("height", 1, most_pixels),
          k[0],
          k[1],
          k[2],
          k[3]};
}

Eigen::AlignedBox3d region_of(const DriverAnswer& answer) {
  const std::vector<double> corners = answer.numbers("region", 6);
  const Eigen::AlignedBox3d box(Vector3(corners[0], corners[1], corners[2]),
                                Vector3(corners[3], corners[4], corners[5]));
  if (!(box.sizes().minCoeff() > 0.0))
    throw std::invalid_argument("'region' is no box: its second corner must lie beyond its first");
  return box;
}

}  // namespace

DriverGreeting greeting_of(const DriverAnswer& answer) {
  if (const int version = answer.whole_number("protocol", 0, 1 << 20); version != driver_protocol_version)
    throw std::invalid_argument(fmt::format("it speaks version {} of the protocol, and this program version {}",
                                            version, driver_protocol_version));
  DriverGreeting greeting{answer.text("name"), answer.texts("abilities"), camera_of(answer),
                          answer.number("max_range", DriverAnswer::over_zero, DriverAnswer::unlimited),
                          answer.number("range_noise", 0.0, DriverAnswer::unlimited)};
  if (answer.has("start")) greeting.start = answer.pose("start");
  if (answer.has("region")) greeting.region = region_of(answer);
  if (answer.has("views")) greeting.views = answer.poses("views");
  if (answer.has("object")) greeting.object = answer.text("object");
  if (answer.has("settings")) greeting.settings = answer.texts_by_key("settings");
  if (answer.has("timeout")) greeting.timeout = answer.number("timeout", 0.0, longest_wait);
  return greeting;
}

CapturedFile captured_file_of(const DriverAnswer& answer) {
  CapturedFile captured{answer.pose("pose"), answer.text("file"), 0.0, {}};
  if (answer.has("scale")) captured.scale = answer.number("scale", DriverAnswer::over_zero, DriverAnswer::unlimited);
  if (answer.has("measures")) captured.measures = answer.text("measures");
  return captured;
}

bool DriverGreeting::can(const std::string& ability) const {
  return std::find(abilities.begin(), abilities.end(), ability) != abilities.end();
}

DriverProtocol::DriverProtocol(const std::vector<std::string>& words, std::function<void(const std::string&)> log,
                               double grace, double stop_time)
    : process_(words, std::move(log), grace), name_(printable(program_named(words))), stop_time_(stop_time) {}

DriverProtocol::~DriverProtocol() { process_.end(json_text(Json{{"id", last_id_ + 1}, {"request", "bye"}})); }

namespace {

/// What an answer holds, or the failure that stands in its place, or what is wrong with what it holds.
template <class T, class Read, class Fail>
Result<T> read_answer(const Result<DriverAnswer>& answer, const Read& read, const Fail& fail) {
  if (const auto* failure = std::get_if<Failure>(&answer)) return *failure;
  try {
    return read(std::get<DriverAnswer>(answer));
  } catch (const std::invalid_argument& error) {
    return fail(error.what());
  }
}

}  // namespace

Result<DriverGreeting> DriverProtocol::hello(const Wait& wait) {
  const auto answer = ask("hello", json_text(Json{{"protocol", driver_protocol_version}}), Failure::disconnected, wait);
  auto greeting = read_answer<DriverGreeting>(answer, greeting_of, [&](const std::string& reason) {
    return failure(Failure::disconnected, "hello: " + reason);
  });
  if (const auto* said = std::get_if<DriverGreeting>(&greeting)) {
    can_stop_ = said->can("stop");
    if (!said->name.empty()) name_ = excerpt(said->name);
  }
  return greeting;
}

Result<std::vector<Reach>> DriverProtocol::reach(const Pose& from, std::span<const Pose> poses, const Wait& wait) {
  Json list = Json::array();
  for (const Pose& pose : poses) list.push_back(by_rows(pose));
  const auto answer =
      ask("reach", json_text(Json{{"from", by_rows(from)}, {"poses", std::move(list)}}), Failure::disconnected, wait);
  return read_answer<std::vector<Reach>>(
      answer, [&](const DriverAnswer& a) { return a.reaches("reach", poses.size()); },
      [&](const std::string& reason) { return failure(Failure::unusable, "reach: " + reason); });
}

Result<Pose> DriverProtocol::move(const Pose& T_world_camera, const Wait& wait) {
  const auto answer = ask("move", json_text(Json{{"pose", by_rows(T_world_camera)}}), Failure::unreachable, wait);
  return read_answer<Pose>(
      answer, [](const DriverAnswer& a) { return a.pose("pose"); },
      [&](const std::string& reason) { return failure(Failure::unusable, "move: " + reason); });
}

Result<CapturedFile> DriverProtocol::capture(std::uint32_t step, std::uint64_t seed,
                                             const std::filesystem::path& folder, const Wait& wait) try {
  const auto answer = ask("capture", json_text(Json{{"step", step}, {"seed", seed}, {"folder", folder.string()}}),
                          Failure::no_data, wait);
  return read_answer<CapturedFile>(answer, captured_file_of, [&](const std::string& reason) {
    return failure(Failure::unusable, "capture: " + reason);
  });
} catch (const Json::exception&) {
  return failure(Failure::unusable, "capture: the folder's name is not UTF-8: " + printable(folder.string()));
}

/// `what` it is asked, and with it a JSON object that is not empty.
Result<DriverAnswer> DriverProtocol::ask(const std::string& what, std::string_view with, Failure::Kind on_error,
                                         const Wait& wait) {
  const std::uint64_t id = ++last_id_;
  if (process_.has_ended()) return failure(Failure::disconnected, "it does not run any more; reconnect");
  if (wait.stop.stop_requested()) return failure(Failure::cancelled, what + ": stopped");
  process_.send(fmt::format(R"({{"id":{},"request":"{}",{})", id, what, with.substr(1)));
  auto deadline = deadline_of(wait.seconds);
  bool stopping = false;
  for (std::string line;;) switch (process_.receive(line, deadline, stopping ? std::stop_token{} : wait.stop)) {
      case Received::line:
        try {
          DriverAnswer answer(line);
          if (answer.id() == id) return settle(std::move(answer), what, on_error, stopping);
          if (answer.id() == 0 || answer.id() > last_id_)
            throw std::invalid_argument(fmt::format("its answer has the id {}, which nobody asked with", answer.id()));
        } catch (const std::invalid_argument& error) {
          abandon();
          return failure(Failure::disconnected, fmt::format("{}: {}", what, error.what()));
        }
        // An answer that came too late, or that of the stop. A flood of them is no answer.
        if (deadline && DriverProcess::Clock::now() >= *deadline) return silent(what, wait.seconds, stopping);
        break;
      case Received::stopped:
        if (auto ended = stop_or_end(what)) return *std::move(ended);
        stopping = true;
        deadline = after(stop_time_);
        break;
      case Received::timed_out:
        return silent(what, wait.seconds, stopping);
      case Received::closed:
        return closed();
      case Received::too_long:
        process_.end();
        return failure(Failure::disconnected,
                       fmt::format("{}: it sent a line of more than {} MiB", what, DriverProcess::longest_line >> 20));
    }
}

Result<DriverAnswer> DriverProtocol::settle(DriverAnswer answer, const std::string& request, Failure::Kind on_error,
                                            bool stopping) {
  const auto error = answer.error();
  if (!error) return answer;
  if (stopping) return failure(Failure::cancelled, request + ": stopped");
  return failure(on_error, fmt::format("{}: {}", request, *error));
}

/// Asks the driver to stop, which the open request then answers to; ends it if it cannot.
std::optional<Failure> DriverProtocol::stop_or_end(const std::string& request) {
  if (can_stop_) {
    process_.send(json_text(Json{{"id", ++last_id_}, {"request", "stop"}}));
    return std::nullopt;
  }
  process_.end();
  return failure(Failure::cancelled, request + ": stopped; it was ended, as it has no ability to stop; reconnect");
}

Failure DriverProtocol::silent(const std::string& request, double seconds, bool stopping) {
  if (stopping) {
    process_.end();
    return failure(Failure::cancelled, request + ": it did not stop and was ended; reconnect");
  }
  abandon();
  return failure(Failure::disconnected, fmt::format("{}: no answer within {:g} s (driver.timeout)", request, seconds));
}

/// Nobody waits for what it does any more: it is not to go on moving.
void DriverProtocol::abandon() {
  if (can_stop_) process_.send(json_text(Json{{"id", ++last_id_}, {"request", "stop"}}));
}

Failure DriverProtocol::closed() {
  Failure why = failure(Failure::disconnected, process_.end_reason());
  process_.end();
  return why;
}

Failure DriverProtocol::failure(Failure::Kind kind, const std::string& reason) const {
  return {kind, fmt::format("driver {}: {}", name_, reason)};
}

}  // namespace nextview
