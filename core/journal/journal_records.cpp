#include "core/journal/journal_records.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/file/json_text.hpp"
#include "core/file/whole_number.hpp"

namespace nextview {
namespace {

using Json = nlohmann::ordered_json;

constexpr int version = 1;

/// 16 numbers, by rows.
Json to_json(const Pose& pose) {
  Json numbers = Json::array();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) numbers.push_back(pose.matrix()(row, column));
  return numbers;
}

Pose pose_of(const Json& json) {
  const auto numbers = json.get<std::vector<double>>();
  Pose pose = Pose::Identity();
  if (numbers.size() != 16) throw std::runtime_error("no pose");
  for (int i = 0; i < 16; ++i) pose.matrix()(i / 4, i % 4) = numbers[std::size_t(i)];
  if (!is_pose(pose)) throw std::runtime_error("no pose");
  return pose;
}

/// JSON has no numbers that are not finite.
Json to_json(double number) { return std::isfinite(number) ? Json(number) : Json(fmt::format("{}", number)); }

double number_of(const Json& json) {
  if (json.is_number()) return json.get<double>();
  const auto text = json.get<std::string>();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (text == "inf") return infinity;
  if (text == "-inf") return -infinity;
  if (text == "nan" || text == "-nan") return std::numeric_limits<double>::quiet_NaN();
  throw std::runtime_error("no number");
}

Json to_json(const PinholeCamera& c) { return {c.width, c.height, c.fx, c.fy, c.cx, c.cy}; }

PinholeCamera camera_of(const Json& json) {
  const auto [width, height] = std::pair{whole_number<int>(json.at(0)), whole_number<int>(json.at(1))};
  constexpr int most = 1 << 16;
  if (width < 1 || height < 1 || width > most || height > most) throw std::runtime_error("no camera");
  const PinholeCamera camera{
      width, height, number_of(json.at(2)), number_of(json.at(3)), number_of(json.at(4)), number_of(json.at(5))};
  const bool is_one =
      std::isfinite(camera.fx) && std::isfinite(camera.fy) && std::isfinite(camera.cx) && std::isfinite(camera.cy);
  if (!is_one) throw std::runtime_error("no camera");
  return camera;
}

Json to_json(const FileHash& hash) { return {{"bytes", hash.bytes}, {"crc32", hash.crc32}}; }

FileHash hash_in(const Json& json) {
  return {whole_number<std::uintmax_t>(json.at("bytes")), json.at("crc32").get<std::string>()};
}

Json to_json(const ScanRegistration& r) {
  return {{"T_corrected_believed", to_json(r.T_corrected_believed)},
          {"shift", to_json(r.shift)},
          {"rotation", to_json(r.rotation)},
          {"overlap", to_json(r.overlap)},
          {"residual_before", to_json(r.residual_before)},
          {"residual_after", to_json(r.residual_after)},
          {"constrained", r.constrained},
          {"reliable", r.reliable},
          {"why_not", r.why_not}};
}

ScanRegistration registration_of(const Json& json) {
  ScanRegistration r;
  r.T_corrected_believed = pose_of(json.at("T_corrected_believed"));
  r.shift = number_of(json.at("shift"));
  r.rotation = number_of(json.at("rotation"));
  r.overlap = number_of(json.at("overlap"));
  r.residual_before = number_of(json.at("residual_before"));
  r.residual_after = number_of(json.at("residual_after"));
  r.constrained = whole_number<int>(json.at("constrained"));
  json.at("reliable").get_to(r.reliable);
  json.at("why_not").get_to(r.why_not);
  return r;
}

JournalStep step_of(const Json& json) {
  JournalStep step;
  step.number = whole_number<std::uint32_t>(json.at("number"));
  step.after = whole_number<std::uint32_t>(json.at("after"));
  if (step.number == 0 || step.after >= step.number) throw std::runtime_error("no step");
  step.wanted.T_world_camera = pose_of(json.at("wanted"));
  if (json.contains("frame")) step.wanted.frame = whole_number<std::uint32_t>(json["frame"]);
  if (json.contains("candidate")) step.candidate = whole_number<std::size_t>(json["candidate"]);
  json.at("custom").get_to(step.is_custom);
  json.at("overridden").get_to(step.overridden);
  step.gain = number_of(json.at("gain"));
  if (json.contains("gain_unit")) json["gain_unit"].get_to(step.gain_unit);
  step.utility = number_of(json.at("utility"));
  step.reached = pose_of(json.at("reached"));
  step.believed = pose_of(json.at("believed"));
  step.T_world_camera = pose_of(json.at("T_world_camera"));
  step.max_range = number_of(json.at("max_range"));
  step.camera = camera_of(json.at("camera"));
  const Json& motion = json.at("motion");
  step.motion = {number_of(motion.at(0)), number_of(motion.at(1)), number_of(motion.at(2))};
  if (json.contains("registration")) step.registration = registration_of(json["registration"]);
  json.at("scan").get_to(step.scan);
  // A name alone: no journal leads out of its folder.
  if (step.scan != fmt::format("{:04}.npy", step.number) && step.scan != fmt::format("{:04}.ply", step.number))
    throw std::runtime_error("no scan");
  step.hash = hash_in(json);
  return step;
}

Json to_json(const Reach& reach) {
  if (!reach.unreachable.empty()) return {{"unreachable", reach.unreachable}};
  return {{"distance", to_json(reach.cost.distance)}, {"seconds", to_json(reach.cost.seconds)}};
}

Reach reach_of(const Json& json) {
  if (json.contains("unreachable")) return {json["unreachable"].get<std::string>(), {}};
  return {"", {number_of(json.at("distance")), 0.0, number_of(json.at("seconds"))}};
}

Branches branches_of(const Json& json, std::uint32_t last_number) {
  Branches branches;
  branches.all.clear();
  branches.next_id = 0;
  for (const Json& branch : json.at("branches")) {
    branches.begin(branch.at("name").get<std::string>(), whole_number<std::uint32_t>(branch.at("tip")));
    if (branches.current().tip > last_number) throw std::runtime_error("no step");
  }
  branches.on = whole_number<std::size_t>(json.at("on"));
  if (branches.on >= branches.all.size()) throw std::runtime_error("no branch");
  return branches;
}

}  // namespace

std::string beginning_record(const JournalInput& input, const std::string& settings) {
  Json json = {
      {"record", "session"}, {"version", version}, {"program", "nextview " NEXTVIEW_VERSION}, {"input", input.path}};
  if (input.hash) json.update(to_json(*input.hash));
  json["toml"] = settings;
  return json_text(json);
}

std::string settings_record(const std::string& text) {
  return Json::object({{"record", "settings"}, {"toml", text}}).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string step_record(const JournalStep& step) {
  Json json = {{"record", "step"}, {"number", step.number}, {"after", step.after}};
  json["wanted"] = to_json(step.wanted.T_world_camera);
  if (step.wanted.frame) json["frame"] = *step.wanted.frame;
  if (step.candidate) json["candidate"] = *step.candidate;
  json["custom"] = step.is_custom;
  json["overridden"] = step.overridden;
  json["gain"] = to_json(step.gain);
  json["gain_unit"] = step.gain_unit;
  json["utility"] = to_json(step.utility);
  json["reached"] = to_json(step.reached);
  json["believed"] = to_json(step.believed);
  json["T_world_camera"] = to_json(step.T_world_camera);
  json["max_range"] = to_json(step.max_range);
  json["camera"] = to_json(step.camera);
  json["motion"] = {to_json(step.motion.distance), to_json(step.motion.rotation), to_json(step.motion.seconds)};
  if (step.registration) json["registration"] = to_json(*step.registration);
  json["scan"] = step.scan;
  json.update(to_json(step.hash));
  return json_text(json);
}

std::string position_record(std::uint32_t number) {
  return json_text(Json::object({{"record", "at"}, {"number", number}}));
}

std::string branches_record(const Branches& branches) {
  Json list = Json::array();
  for (const Branch& branch : branches.all) list.push_back({{"name", branch.name}, {"tip", branch.tip}});
  return json_text(Json::object({{"record", "branches"}, {"branches", list}, {"on", branches.on}}));
}

std::string outcome_record(std::uint32_t number, const std::map<std::string, double>& outcome) {
  Json values = Json::object();
  for (const auto& [name, value] : outcome) values[name] = to_json(value);
  return json_text(Json::object({{"record", "outcome"}, {"number", number}, {"values", values}}));
}

std::string reach_record(std::uint32_t number, const std::vector<Reach>& reach) {
  Json list = Json::array();
  for (const Reach& one : reach) list.push_back(to_json(one));
  return json_text(Json::object({{"record", "reach"}, {"number", number}, {"candidates", list}}));
}

std::string closing_record() { return json_text(Json::object({{"record", "closed"}})); }

bool read_record(const std::string& record, Journal& journal) {
  const Json json = parse_json<Json>(record);
  const auto kind = json.at("record").get<std::string>();
  journal.closed = kind == "closed";
  if (kind == "session") {
    if (whole_number<int>(json.at("version")) > version)
      throw NewerJournal(fmt::format("was written by a newer version ({}) than this one, {}",
                                     json.value("program", "of an unknown name"), NEXTVIEW_VERSION));
    json.at("program").get_to(journal.program);
    json.at("input").get_to(journal.input.path);
    if (json.contains("crc32")) journal.input.hash = hash_in(json);
    journal.settings.push_back(json.at("toml").get<std::string>());
    return true;
  }
  if (kind == "step") {
    JournalStep step = step_of(json);
    step.settings = journal.settings.size();
    journal.at = step.number;
    journal.settings_at[step.number] = step.settings;
    journal.branches.add_step(step.number, step.after);
    journal.steps.insert_or_assign(step.number, std::move(step));
  } else if (kind == "settings") {
    journal.settings.push_back(json.at("toml").get<std::string>());
    journal.settings_at[journal.at] = journal.settings.size();
  } else if (kind == "at") {
    const auto number = whole_number<std::uint32_t>(json.at("number"));
    if (number > journal.last_number()) throw std::runtime_error("no step");
    journal.at = number;
  } else if (kind == "branches") {
    journal.branches = branches_of(json, journal.last_number());
  } else if (kind == "outcome") {
    std::map<std::string, double> outcome;
    for (const auto& [name, value] : json.at("values").items()) outcome[name] = number_of(value);
    journal.steps.at(whole_number<std::uint32_t>(json.at("number"))).outcome = std::move(outcome);
  } else if (kind == "reach") {
    std::vector<Reach> reach;
    for (const Json& one : json.at("candidates")) reach.push_back(reach_of(one));
    journal.steps.at(whole_number<std::uint32_t>(json.at("number"))).reach = std::move(reach);
  } else if (kind != "closed") {
    throw std::runtime_error("no record");
  }
  return false;
}

}  // namespace nextview
