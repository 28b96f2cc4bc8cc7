#include "core/driver/driver_server.hpp"

#include <fmt/format.h>

#include <istream>
#include <mutex>
#include <ostream>
#include <stdexcept>
#include <stop_token>
#include <thread>

#include "core/driver/driver_answer.hpp"
#include "core/driver/driver_protocol.hpp"
#include "core/file/json_text.hpp"
#include "core/file/npy_file.hpp"

namespace nextview {
namespace {

using Json = nlohmann::json;

Pose pose_in(const Json& numbers) {
  const auto values = numbers.get<std::vector<double>>();
  if (values.size() != 16) throw std::invalid_argument("a pose has 16 numbers");
  return pose_of(values);
}

Json error(const Failure& failure) {
  return {{"error", failure.kind == Failure::cancelled ? "stopped" : failure.reason}};
}

/// Requests are read while one is worked on, as a stop may come.
class Server {
 public:
  Server(const ServedScanner& scanner, std::ostream& answers) : scanner_(scanner), answers_(answers) {}
  ~Server() {
    stop_.request_stop();
    finish();
  }

  void run(std::istream& requests) {
    for (std::string line; std::getline(requests, line);) {
      const Json request = parse_json_if_it_is<Json>(line);
      if (!request.is_object() || !request.contains("id") || !request.contains("request")) {
        say({{"id", 0}, {"error", "expected a JSON object with 'id' and 'request'"}});
        continue;
      }
      if (request["request"] == "bye") return;
      begin(request);
    }
  }

 private:
  void begin(const Json& request) {
    const bool stopping = request["request"] == "stop";
    if (stopping) stop_.request_stop();
    finish();
    stop_ = {};
    if (stopping)
      say({{"id", request["id"]}, {"ok", true}});
    else
      work_ = std::thread([this, request] { say(answer(request)); });
  }

  void finish() {
    if (work_.joinable()) work_.join();
  }

  void say(const Json& answer) {
    const std::lock_guard lock(mutex_);
    answers_ << json_text(answer) << '\n' << std::flush;
  }

  Json answer(const Json& request) {
    Json result;
    try {
      result = result_of(request);
    } catch (const std::exception& exception) {
      result = {{"error", exception.what()}};
    }
    if (!result.contains("error")) result["ok"] = true;
    result["id"] = request["id"];
    return result;
  }

  Json result_of(const Json& request) {
    const auto what = request.at("request").get<std::string>();
    if (what == "hello") return hello(request);
    if (what == "reach") return reach(request);
    if (what == "move") return move(request);
    if (what == "capture") return capture(request);
    throw std::invalid_argument("there is no request '" + what + "'");
  }

  Json hello(const Json& request) const {
    if (request.at("protocol") != driver_protocol_version)
      throw std::invalid_argument(fmt::format("this is version {} of the protocol", driver_protocol_version));
    const SourceDescription& d = scanner_.description;
    Json result = {{"protocol", driver_protocol_version},
                   {"name", scanner_.name},
                   {"abilities", scanner_.abilities},
                   {"intrinsics", {d.camera.fx, d.camera.fy, d.camera.cx, d.camera.cy}},
                   {"width", d.camera.width},
                   {"height", d.camera.height},
                   {"max_range", d.max_range},
                   {"range_noise", d.range_noise}};
    if (d.start) result["start"] = by_rows(*d.start);
    if (!scanner_.object.empty()) result["object"] = scanner_.object;
    if (!scanner_.settings.empty()) result["settings"] = scanner_.settings;
    return result;
  }

  Json reach(const Json& request) {
    std::vector<View> views;
    for (const Json& pose : request.at("poses")) views.push_back({pose_in(pose)});
    Json list = Json::array();
    for (const Reach& reach : scanner_.robot.reach(pose_in(request.at("from")), views))
      if (reach.unreachable.empty())
        list.push_back(
            {{"distance", reach.cost.distance}, {"rotation", reach.cost.rotation}, {"seconds", reach.cost.seconds}});
      else
        list.push_back({{"unreachable", reach.unreachable}});
    return {{"reach", list}};
  }

  Json move(const Json& request) {
    const Result<Pose> reached = scanner_.robot.move_to({pose_in(request.at("pose"))}, stop_.get_token());
    if (const auto* failure = std::get_if<Failure>(&reached)) return error(*failure);
    return {{"pose", by_rows(std::get<Pose>(reached))}};
  }

  Json capture(const Json& request) {
    const auto step = request.at("step").get<std::uint32_t>();
    const auto source = scanner_.source(request.value("seed", scanner_.seed));
    const Result<Capture> result = source->capture({scanner_.robot.pose()}, step, stop_.get_token());
    if (const auto* failure = std::get_if<Failure>(&result)) return error(*failure);
    const auto& taken = std::get<Capture>(result);
    const auto* image = std::get_if<DepthImage>(&taken.measured);
    if (!image) throw std::invalid_argument("points are not served");
    const std::string name = fmt::format("capture_{:04}.npy", step);
    write_npy({image->camera.width, image->camera.height, image->range},
              std::filesystem::path(request.at("folder").get<std::string>()) / name);
    return {{"pose", by_rows(taken.T_world_camera)}, {"file", name}};
  }

  const ServedScanner& scanner_;
  std::ostream& answers_;
  std::mutex mutex_;
  std::stop_source stop_;
  std::thread work_;
};

}  // namespace

void serve(const ServedScanner& scanner, std::istream& requests, std::ostream& answers) {
  Server(scanner, answers).run(requests);
}

}  // namespace nextview
