#include "core/session/camera_bookmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/file/json_text.hpp"
#include "core/file/read_file.hpp"

namespace nextview {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longest_name = 60;          // [bytes]
constexpr std::uintmax_t largest_file = 1 << 20;  // [bytes]
constexpr double farthest = 1e6;                  // [m]

Json to_json(const CameraBookmark& camera) {
  const Vector3& at = camera.T_world_camera.translation();
  const Eigen::Quaterniond q(camera.T_world_camera.linear());
  return {{"name", camera.name},
          {"position_m", {at.x(), at.y(), at.z()}},
          {"orientation_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

CameraBookmark from_json(const Json& json) {
  const auto at = json.at("position_m").get<std::array<double, 3>>();
  const auto q = json.at("orientation_xyzw").get<std::array<double, 4>>();
  const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
  const Vector3 position(at[0], at[1], at[2]);
  if (!(position.cwiseAbs().maxCoeff() < farthest) || !(std::abs(turn.norm() - 1.0) < 1e-3))
    throw std::runtime_error("a camera is nowhere");
  CameraBookmark camera{json.at("name").get<std::string>()};
  camera.T_world_camera.translation() = position;
  camera.T_world_camera.linear() = turn.normalized().toRotationMatrix();
  return camera;
}

}  // namespace

void keep(std::vector<CameraBookmark>& cameras, CameraBookmark camera) {
  if (camera.name.empty() || camera.name.size() > longest_name)
    throw std::invalid_argument(fmt::format("a camera's name has 1 to {} bytes", longest_name));
  const auto same = std::ranges::find(cameras, camera.name, &CameraBookmark::name);
  if (same != cameras.end()) {
    *same = std::move(camera);
    return;
  }
  if (cameras.size() >= max_cameras)
    throw std::invalid_argument(fmt::format("{} cameras are kept already: remove one first", max_cameras));
  cameras.push_back(std::move(camera));
}

void forget(std::vector<CameraBookmark>& cameras, const std::string& name) {
  if (std::erase_if(cameras, [&](const CameraBookmark& camera) { return camera.name == name; }) == 0)
    throw std::invalid_argument(fmt::format("there is no camera '{}'", name));
}

std::string cameras_json(const std::vector<CameraBookmark>& cameras) {
  Json all = Json::array();
  for (const CameraBookmark& camera : cameras) all.push_back(to_json(camera));
  return json_text(Json{{"cameras", all}}, 2) + "\n";
}

std::vector<CameraBookmark> read_cameras(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / cameras_name;
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return {};
  try {
    if (std::filesystem::file_size(file) > largest_file) throw std::runtime_error("it is too large");
    std::vector<CameraBookmark> cameras;
    const Json all = parse_json<Json>(read_file(file));
    if (!all.at("cameras").is_array()) throw std::runtime_error("is no list of cameras");
    for (const Json& json : all.at("cameras")) keep(cameras, from_json(json));
    return cameras;
  } catch (const nlohmann::json::exception&) {
    throw std::runtime_error(fmt::format("{}: is no list of cameras", file.string()));
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace nextview
