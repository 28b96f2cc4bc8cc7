#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/file/json_text.hpp"
#include "core/mesh/parts.hpp"

namespace nextview {
namespace {

using Json = nlohmann::json;
constexpr std::uintmax_t largest_file = 1u << 20;  // [bytes]
constexpr double largest_number = 1000.0;          // [m], as of a mesh at its own size
constexpr double rounding = 1e-6;                  // of unit vectors written with few digits

// Everything below throws std::runtime_error with the reason alone.

const Json& field(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw std::runtime_error(fmt::format("has no '{}'", key));
  return *found;
}

double number(const Json& json, const char* key) {
  if (!json.is_number()) throw std::runtime_error(fmt::format("'{}' must be a number, not {}", key, json.type_name()));
  const auto value = json.get<double>();
  if (!(std::abs(value) <= largest_number))
    throw std::runtime_error(fmt::format("'{}' holds {}, which is beyond {} m", key, value, largest_number));
  return value;
}

double length(const Json& opening, const char* key) {
  const double metres = number(field(opening, key), key);
  if (!(metres > 0.0)) throw std::runtime_error(fmt::format("'{}' must be over 0 m, not {}", key, metres));
  return metres;
}

Eigen::Vector3d vector(const Json& opening, const char* key) {
  const Json& json = field(opening, key);
  if (!json.is_array() || json.size() != 3) throw std::runtime_error(fmt::format("'{}' must be three numbers", key));
  return {number(json[0], key), number(json[1], key), number(json[2], key)};
}

Opening::Kind kind(const Json& opening) {
  const Json& json = field(opening, "kind");
  if (json == "slot") return Opening::Kind::slot;
  if (json == "bore") return Opening::Kind::bore;
  throw std::runtime_error("'kind' must be \"slot\" or \"bore\"");
}

Opening opening_of(const Json& json) {
  if (!json.is_object()) throw std::runtime_error(fmt::format("must be an object, not {}", json.type_name()));
  Opening opening{kind(json),
                  length(json, "width"),
                  length(json, "length"),
                  length(json, "depth"),
                  vector(json, "centre"),
                  vector(json, "axis"),
                  vector(json, "along")};
  const bool unit = std::abs(opening.axis.norm() - 1.0) < rounding && std::abs(opening.along.norm() - 1.0) < rounding;
  if (!unit || std::abs(opening.axis.dot(opening.along)) > rounding)
    throw std::runtime_error("'axis' and 'along' must be of unit length and at right angles");
  return opening;
}

/// The reader's own messages quote the file's bytes, whatever they are; these do not.
Json parsed(const std::string& text) {
  try {
    return parse_json<Json>(text);
  } catch (const Json::parse_error& error) {
    throw std::runtime_error(error.byte > text.size() ? "ends in the middle: truncated, or no JSON"
                                                      : fmt::format("is no JSON from byte {} on", error.byte));
  } catch (const Json::exception&) {
    throw std::runtime_error("has a number that is too large");
  }
}

std::vector<Opening> openings_of(const Json& json) {
  if (!json.is_object()) throw std::runtime_error(fmt::format("must be an object, not {}", json.type_name()));
  if (field(json, "unit") != "m") throw std::runtime_error("'unit' must be \"m\"");
  const Json& list = field(json, "openings");
  if (!list.is_array()) throw std::runtime_error(fmt::format("'openings' must be an array, not {}", list.type_name()));
  std::vector<Opening> openings;
  for (const Json& each : list) {
    try {
      openings.push_back(opening_of(each));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("opening {}: {}", openings.size(), error.what()));
    }
  }
  return openings;
}

}  // namespace

std::vector<Opening> read_openings(const std::filesystem::path& file) {
  const std::string text = read_file(file, largest_file);
  try {
    return openings_of(parsed(text));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

Opening placed(const Opening& opening, const MeshPlacement& placement) {
  Opening moved = opening;
  moved.width *= placement.scale;
  moved.length *= placement.scale;
  moved.depth *= placement.scale;
  moved.centre = placement(opening.centre);
  moved.axis = with_z_up(placement.up, opening.axis);
  moved.along = with_z_up(placement.up, opening.along);
  return moved;
}

}  // namespace nextview
