#include "core/driver/driver_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/file/counted.hpp"
#include "core/file/json_text.hpp"
#include "core/file/printable.hpp"

namespace nextview {
namespace {

using Json = nlohmann::json;

/// How far a matrix may be from a rotation, as one is that was printed with few digits; and how far one is that was
/// printed with all.
constexpr double printed_roughly = 1e-4, printed_fully = 1e-12;

const Json& member(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) throw std::invalid_argument(fmt::format("there is no '{}'", key));
  return *found;
}

[[noreturn]] void wrong(const char* key, const std::string& expected, const Json& is) {
  const std::string text = is.is_number() ? fmt::format("{}", is.get<double>()) : json_text(is);
  throw std::invalid_argument(fmt::format("'{}' must be {}, not {}", key, expected, excerpt(text)));
}

double number_in(const Json& object, const char* key, double least, double largest) {
  const Json& value = member(object, key);
  if (!value.is_number()) wrong(key, "a number", value);
  const double number = value.get<double>();
  if (!(number >= least && number <= largest))
    wrong(key,
          least == DriverAnswer::over_zero     ? "over 0"
          : largest == DriverAnswer::unlimited ? fmt::format("at least {:g}", least)
                                               : fmt::format("from {:g} to {:g}", least, largest),
          value);
  return number;
}

std::string text_in(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (!value.is_string()) wrong(key, "a text", value);
  return value.get<std::string>();
}

/// Of who writes a driver.
const char* likely_mistake(const std::string& line) {
  if (line.find("NaN") != line.npos || line.find("Infinity") != line.npos) return " (which has no NaN and no Infinity)";
  return line.starts_with('{') ? "" : " (what is for people goes to standard error)";
}

}  // namespace

struct DriverAnswer::Object {
  Json json;
};

DriverAnswer::DriverAnswer(const std::string& line) : object_(std::make_unique<Object>()) {
  object_->json = parse_json_if_it_is<Json>(line);
  const Json& json = object_->json;
  if (json.is_discarded())
    throw std::invalid_argument(fmt::format("its answer is no JSON{}: {}", likely_mistake(line),
                                            line.empty() ? "an empty line" : excerpt(line)));
  if (!json.is_object()) throw std::invalid_argument("its answer is no JSON object: " + excerpt(line));
  const auto id = json.find("id");
  if (id == json.end() || !id->is_number_unsigned())
    throw std::invalid_argument("its answer has no 'id' that repeats the request's: " + excerpt(line));
  id_ = id->get<std::uint64_t>();
}

DriverAnswer::~DriverAnswer() = default;
DriverAnswer::DriverAnswer(DriverAnswer&&) noexcept = default;
DriverAnswer& DriverAnswer::operator=(DriverAnswer&&) noexcept = default;

std::optional<std::string> DriverAnswer::error() const {
  if (has("error")) {
    const std::string reason = text("error");
    return reason.empty() ? "it gives no reason" : excerpt(reason);
  }
  if (const auto ok = object_->json.find("ok"); ok == object_->json.end() || *ok != true)
    throw std::invalid_argument("its answer has neither 'ok': true nor an 'error'");
  return std::nullopt;
}

bool DriverAnswer::has(const char* key) const {
  const auto found = object_->json.find(key);
  return found != object_->json.end() && !found->is_null();
}

double DriverAnswer::number(const char* key, double least, double largest) const {
  return number_in(object_->json, key, least, largest);
}

int DriverAnswer::whole_number(const char* key, int least, int largest) const {
  const double value = number(key, least, largest);
  if (value != std::floor(value)) wrong(key, "a whole number", member(object_->json, key));
  return static_cast<int>(value);
}

std::vector<double> DriverAnswer::numbers(const char* key, std::size_t count) const {
  const Json& list = member(object_->json, key);
  const bool all =
      list.is_array() && list.size() == count && std::all_of(list.begin(), list.end(), [](const Json& value) {
        return value.is_number() && std::isfinite(value.get<double>());
      });
  if (!all) wrong(key, fmt::format("a list of {} numbers", count), list);
  return list.get<std::vector<double>>();
}

std::string DriverAnswer::text(const char* key) const { return text_in(object_->json, key); }

std::vector<std::string> DriverAnswer::texts(const char* key) const {
  const Json& list = member(object_->json, key);
  if (!list.is_array() || !std::all_of(list.begin(), list.end(), [](const Json& value) { return value.is_string(); }))
    wrong(key, "a list of texts", list);
  return list.get<std::vector<std::string>>();
}

std::map<std::string, std::string> DriverAnswer::texts_by_key(const char* key) const {
  const Json& entries = member(object_->json, key);
  if (!entries.is_object() || !std::ranges::all_of(entries, &Json::is_string))
    wrong(key, "an object of texts", entries);
  return entries.get<std::map<std::string, std::string>>();
}

Pose DriverAnswer::pose(const char* key) const {
  const std::vector<double> values = numbers(key, 16);
  try {
    return pose_of(values);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("'{}' {}", key, error.what()));
  }
}

std::vector<Pose> DriverAnswer::poses(const char* key) const {
  constexpr std::size_t most_poses = 100'000;
  const Json& list = member(object_->json, key);
  if (!list.is_array() || list.size() > most_poses) wrong(key, "a list of at most 100,000 poses", list);
  std::vector<Pose> result;
  for (const Json& entry : list) {
    if (!entry.is_array() || entry.size() != 16 || !std::ranges::all_of(entry, &Json::is_number))
      wrong(key, "a list of poses of 16 numbers", list);
    try {
      result.push_back(pose_of(entry.get<std::vector<double>>()));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("'{}' {}", key, error.what()));
    }
  }
  return result;
}

std::vector<Reach> DriverAnswer::reaches(const char* key, std::size_t count) const {
  const Json& list = member(object_->json, key);
  if (!list.is_array() || list.size() != count)
    throw std::invalid_argument(
        fmt::format("'{}' is no list with an entry for each of {}", key, counted(count, "pose")));
  std::vector<Reach> result;
  for (const Json& entry : list) {
    if (!entry.is_object()) wrong(key, "a list of objects", list);
    Reach& reach = result.emplace_back();
    if (const auto why = entry.find("unreachable"); why != entry.end() && !why->is_null()) {
      const std::string reason = excerpt(text_in(entry, "unreachable"));
      reach.unreachable = reason.empty() ? "the driver gives no reason" : reason;
    } else {
      reach.cost = {number_in(entry, "distance", 0.0, unlimited), number_in(entry, "rotation", 0.0, unlimited),
                    number_in(entry, "seconds", 0.0, unlimited)};
    }
  }
  return result;
}

Pose pose_of(const std::vector<double>& by_rows) {
  Pose pose;
  pose.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(by_rows.data());
  if (pose.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw std::invalid_argument("is no pose: its last row is not 0 0 0 1");
  const Eigen::Matrix3d given = pose.linear();
  const auto error = [](const Eigen::Matrix3d& r) {
    return (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  };
  if (!(error(given) <= printed_roughly) || given.determinant() <= 0.0)
    throw std::invalid_argument("is no rigid pose: its rotation is none");
  if (!(pose.translation().cwiseAbs().maxCoeff() <= farthest_pose))
    throw std::invalid_argument(fmt::format("is no pose: it lies over {:g} m off", farthest_pose));
  if (error(given) > printed_fully) pose.linear() = Eigen::Quaterniond(given).normalized().toRotationMatrix();
  return pose;
}

std::vector<double> by_rows(const Pose& pose) {
  std::vector<double> result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) result.push_back(pose.matrix()(row, column));
  return result;
}

std::string excerpt(const std::string& text) {
  constexpr std::size_t longest = 200;
  return text.size() <= longest ? printable(text) : printable(text.substr(0, longest)) + "…";
}

}  // namespace nextview
