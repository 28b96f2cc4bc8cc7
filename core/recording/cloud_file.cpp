#include "core/recording/cloud_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "core/file/counted.hpp"
#include "core/file/gzip_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

/// What a PCD file says of itself, and where its points begin.
struct PcdHeader {
  std::vector<std::string> fields, types;
  std::vector<std::size_t> sizes, counts;
  std::size_t points = 0, data = 0;
  std::string encoding;
  std::optional<Pose> viewpoint;
};

template <class Value>
std::vector<Value> values(std::istringstream& words) {
  std::vector<Value> found;
  for (Value value; words >> value;) found.push_back(value);
  return found;
}

std::optional<Pose> viewpoint(const std::vector<double>& v) {
  if (v.size() != 7) throw std::runtime_error("is a damaged PCD: VIEWPOINT takes tx ty tz qw qx qy qz");
  const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
  if (!(std::abs(q.norm() - 1.0) <= 1e-3) || !Vector3(v[0], v[1], v[2]).allFinite())
    throw std::runtime_error("its VIEWPOINT is no pose");
  const Pose pose = make_pose({v[0], v[1], v[2]}, q);
  if (pose.isApprox(Pose::Identity())) return std::nullopt;
  return pose;
}

void take_line(PcdHeader& header, const std::string& line) {
  std::istringstream words(line);
  std::string keyword;
  words >> keyword;
  if (keyword == "FIELDS") header.fields = values<std::string>(words);
  if (keyword == "TYPE") header.types = values<std::string>(words);
  if (keyword == "SIZE") header.sizes = values<std::size_t>(words);
  if (keyword == "COUNT") header.counts = values<std::size_t>(words);
  if (keyword == "VIEWPOINT") header.viewpoint = viewpoint(values<double>(words));
  if (keyword == "POINTS") words >> header.points;
  if (keyword == "DATA") words >> header.encoding;
}

PcdHeader parse_pcd_header(std::string_view bytes) {
  constexpr std::size_t longest_header = 1 << 16;
  PcdHeader header;
  while (header.encoding.empty()) {
    const std::size_t end = bytes.substr(header.data, longest_header).find('\n');
    if (end == std::string_view::npos || header.data > longest_header)
      throw std::runtime_error("is no PCD file: it has no line DATA");
    take_line(header, std::string(bytes.substr(header.data, end)));
    header.data += end + 1;
  }
  const std::size_t fields = header.fields.size();
  if (header.counts.empty()) header.counts.assign(fields, 1);
  if (header.sizes.size() != fields || header.types.size() != fields || header.counts.size() != fields || fields > 256)
    throw std::runtime_error("is a damaged PCD: FIELDS, SIZE, TYPE and COUNT do not fit each other");
  for (std::size_t i = 0; i < fields; ++i)
    if (header.sizes[i] > 8 || header.counts[i] > 1 << 16)
      throw std::runtime_error("is a damaged PCD: a field is too large");
  return header;
}

/// Of a field: its place among a point's bytes and among its numbers.
struct Place {
  std::size_t byte = 0, word = 0;
};

Place place_of(const PcdHeader& header, const std::string& field) {
  Place place;
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    if (header.fields[i] == field) {
      if (header.types[i] != "F" || header.sizes[i] != 4 || header.counts[i] != 1)
        throw std::runtime_error(fmt::format("its field {} is no float32", field));
      return place;
    }
    place.byte += header.sizes[i] * header.counts[i];
    place.word += header.counts[i];
  }
  throw std::runtime_error(fmt::format("has no field {}", field));
}

PointCloud binary_points(const PcdHeader& header, std::string_view data) {
  std::size_t step = 0;
  for (std::size_t i = 0; i < header.fields.size(); ++i) step += header.sizes[i] * header.counts[i];
  const Place places[3] = {place_of(header, "x"), place_of(header, "y"), place_of(header, "z")};  // so step is not 0
  if (header.points > data.size() / step)
    throw std::runtime_error(fmt::format("is truncated: it claims {} points, more than it holds", header.points));
  PointCloud points(header.points);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      std::memcpy(&points[i][axis], data.data() + i * step + places[axis].byte, sizeof(float));
  return points;
}

/// Where the words of a line begin.
void find_words(std::string_view line, std::vector<const char*>& words) {
  constexpr std::string_view blanks = " \t\v\f\r";
  words.clear();
  for (std::size_t at = line.find_first_not_of(blanks); at < line.size(); at = line.find_first_not_of(blanks, at)) {
    words.push_back(line.data() + at);
    at = std::min(line.find_first_of(blanks, at), line.size());
  }
}

/// @pre `data` are the last of a std::string, which ends with a nought: so does the last number
PointCloud ascii_points(const PcdHeader& header, std::string_view data) {
  if (header.points > data.size() / 2 + 1)
    throw std::runtime_error(fmt::format("is truncated: it claims {} points, more than it holds", header.points));
  const Place places[3] = {place_of(header, "x"), place_of(header, "y"), place_of(header, "z")};
  PointCloud points;
  std::vector<const char*> words;
  while (points.size() < header.points && !data.empty()) {
    const std::string_view line = data.substr(0, data.find('\n'));
    data.remove_prefix(std::min(line.size() + 1, data.size()));
    find_words(line, words);
    if (words.empty()) continue;
    Eigen::Vector3f point;
    for (int axis = 0; axis < 3; ++axis) {
      if (places[axis].word >= words.size()) throw std::runtime_error("has a point with too few numbers");
      point[axis] = std::strtof(words[places[axis].word], nullptr);
    }
    points.push_back(point);
  }
  if (points.size() < header.points)
    throw std::runtime_error(fmt::format("is truncated: {} of {} points", points.size(), header.points));
  return points;
}

CloudFile read_pcd(const std::string& bytes) {
  const PcdHeader header = parse_pcd_header(bytes);
  const std::string_view data = std::string_view(bytes).substr(header.data);
  if (header.encoding == "binary") return {binary_points(header, data), header.viewpoint};
  if (header.encoding == "ascii") return {ascii_points(header, data), header.viewpoint};
  throw std::runtime_error(fmt::format("its DATA are {}; ascii and binary are read", header.encoding));
}

bool is_pcd(const fs::path& file) { return without_gz(file).extension() == ".pcd"; }

/// What `read` makes of a file's bytes; what is wrong with them is told with its name.
template <class Read>
auto read_named(const fs::path& file, const Read& read) {
  const std::string bytes = read_plain_or_gzip(file);
  try {
    return read(bytes);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace

std::optional<Pose> read_viewpoint(const fs::path& file) {
  if (!is_pcd(file)) return std::nullopt;
  return read_named(file, [](const std::string& bytes) { return parse_pcd_header(bytes).viewpoint; });
}

CloudFile read_cloud_file(const fs::path& file) {
  CloudFile cloud;
  if (is_pcd(file)) {
    cloud = read_named(file, read_pcd);
  } else {
    cloud.points = read_ply(file, {}, NotFinite::kept);
  }
  constexpr float farthest = 1e9f;  // of any unit
  cloud.left_out = std::erase_if(
      cloud.points, [](const Eigen::Vector3f& p) { return !p.allFinite() || p.cwiseAbs().maxCoeff() > farthest; });
  return cloud;
}

std::string points_text(std::size_t points, std::size_t left_out) {
  return counted(points, "point") + (left_out > 0 ? fmt::format(" ({} that are not finite left out)", left_out) : "");
}

}  // namespace nextview
