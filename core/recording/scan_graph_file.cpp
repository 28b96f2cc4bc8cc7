#include "core/recording/scan_graph_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "core/file/read_file.hpp"
#include "core/recording/number_lines.hpp"
#include "core/recording/pose_files.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t point_bytes = 4 + 3 * 8;  // its size (3), and three doubles
constexpr double farthest = 1e6;                // [m]
constexpr std::uint64_t most_at_once = std::uint64_t{1} << 30;

std::runtime_error failure(const fs::path& file, const std::string& reason) {
  return std::runtime_error(fmt::format("{}: {}", file.string(), reason));
}

/// A file of which parts are read, each checked against its end.
class FileParts {
 public:
  explicit FileParts(const fs::path& file) : file_(file), descriptor_(open_regular_file(file)) {
    struct stat status {};
    if (::fstat(descriptor_.get(), &status) != 0) throw file_error(file, "read", errno);
    size_ = static_cast<std::uint64_t>(status.st_size);
  }
  std::uint64_t left() const { return size_ - at_; }
  std::uint64_t at() const { return at_; }
  void skip(std::uint64_t bytes) {
    if (bytes > left()) throw failure(file_, "is truncated");
    at_ += bytes;
  }
  std::string read(std::uint64_t bytes) {
    if (bytes > left()) throw failure(file_, "is truncated");
    if (bytes > most_at_once) throw failure(file_, fmt::format("a scan takes {} bytes: too many to be read", bytes));
    std::string part(bytes, '\0');
    for (std::size_t got = 0; got < bytes;) {
      const ssize_t more = ::pread(descriptor_.get(), part.data() + got, bytes - got, static_cast<off_t>(at_ + got));
      if (more < 0 && errno == EINTR) continue;
      if (more < 0) throw file_error(file_, "read", errno);
      if (more == 0) throw failure(file_, "is truncated");
      got += static_cast<std::size_t>(more);
    }
    at_ += bytes;
    return part;
  }
  std::uint32_t whole() {
    const std::string bytes = read(4);
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data(), 4);
    return value;
  }
  /// Doubles behind their number, which must be `count`.
  Eigen::VectorXd vector(std::uint32_t count) {
    if (whole() != count) throw failure(file_, "is no scan graph of OctoMap, or damaged");
    const std::string bytes = read(std::uint64_t{8} * count);
    Eigen::VectorXd values(count);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

 private:
  fs::path file_;
  Descriptor descriptor_;
  std::uint64_t size_ = 0, at_ = 0;
};

std::vector<ScanGraphNode> read_binary(const fs::path& file) {
  FileParts parts(file);
  const std::uint32_t count = parts.whole();
  constexpr std::uint64_t shortest_node = 4 + 28 + 36 + 4;
  if (count == 0) throw failure(file, "holds no scan");
  if (count > parts.left() / shortest_node)
    throw failure(file, fmt::format("claims {} scans, more than it can hold", count));
  std::vector<ScanGraphNode> nodes;
  for (std::uint32_t i = 0; i < count; ++i) {
    ScanGraphNode node;
    node.points = parts.whole();
    node.offset = parts.at();
    node.bytes = node.points * std::uint64_t{point_bytes};
    if (node.bytes > parts.left())
      throw failure(
          file, fmt::format("its scan {} claims {} points, more than the rest of the file holds", i + 1, node.points));
    parts.skip(node.bytes);
    const Vector3 position = parts.vector(3);
    const Eigen::VectorXd q = parts.vector(4);  // w x y z
    if (!(std::abs(q.norm() - 1.0) <= 1e-3) || !position.allFinite() || position.cwiseAbs().maxCoeff() > farthest)
      throw failure(file, fmt::format("the pose of its scan {} is none", i + 1));
    parts.skip(4);  // the node's number
    node.T_world_camera = make_pose(position, {q[0], q[1], q[2], q[3]}) * camera_in_body();
    nodes.push_back(node);
  }
  return nodes;
}

/// Takes the next line off a text.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = std::min(rest.find('\n'), rest.size());
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return line;
}

/// `count` finite numbers apart by blanks, and nothing else; none for a blank line.
bool parse_numbers(std::string_view line, double* values, int count) {
  int found = 0;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty()) return found == count;
    if (found == count) return false;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), values[found]);
    if (error != std::errc() || !std::isfinite(values[found]) || std::abs(values[found]) > farthest) return false;
    ++found;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  }
}

bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos || line.starts_with('#');
}

constexpr std::string_view node_keyword = "NODE ";

Pose node_pose(const fs::path& file, std::size_t number, std::string_view line) {
  double v[6];
  if (!parse_numbers(line.substr(node_keyword.size()), v, 6))
    throw line_failure(file, number, "expected `NODE x y z roll pitch yaw`");
  Pose pose = Pose::Identity();
  pose.linear() = (Eigen::AngleAxisd(v[5], Vector3::UnitZ()) * Eigen::AngleAxisd(v[4], Vector3::UnitY()) *
                   Eigen::AngleAxisd(v[3], Vector3::UnitX()))
                      .toRotationMatrix();
  pose.translation() << v[0], v[1], v[2];
  return pose * camera_in_body();
}

std::vector<ScanGraphNode> read_text_graph(const fs::path& file) {
  const std::string text = read_file(file);
  std::vector<ScanGraphNode> nodes;
  std::string_view rest = text;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = take_line(rest);
    const std::uint64_t end = text.size() - rest.size();
    if (line.starts_with(node_keyword)) {
      nodes.push_back({node_pose(file, number, line), end, 0, 0, number});
    } else if (nodes.empty() && !is_blank(line)) {
      throw line_failure(file, number, "expected `NODE x y z roll pitch yaw`");
    }
    if (!nodes.empty()) nodes.back().bytes = end - nodes.back().offset;
  }
  if (nodes.empty()) throw failure(file, "holds no line `NODE x y z roll pitch yaw`");
  return nodes;
}

std::vector<Vector3> text_points(const fs::path& file, const ScanGraphNode& node, std::string_view rest) {
  std::vector<Vector3> points;
  for (std::size_t number = node.line + 1; !rest.empty(); ++number) {
    const std::string_view line = take_line(rest);
    if (is_blank(line)) continue;
    double v[3];
    if (!parse_numbers(line, v, 3)) throw line_failure(file, number, "expected a point `x y z` within 1e6 m");
    points.emplace_back(v[0], v[1], v[2]);
  }
  return points;
}

std::vector<Vector3> binary_points(const fs::path& file, const ScanGraphNode& node, const std::string& bytes) {
  std::vector<Vector3> points(node.points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + i * point_bytes, 4);
    std::memcpy(points[i].data(), bytes.data() + i * point_bytes + 4, 24);
    if (size != 3 || !points[i].allFinite() || points[i].cwiseAbs().maxCoeff() > farthest)
      throw failure(file, fmt::format("a point at byte {} is none", node.offset + i * point_bytes));
  }
  return points;
}

}  // namespace

std::vector<ScanGraphNode> read_scan_graph(const fs::path& file) {
  return file.extension() == ".log" ? read_text_graph(file) : read_binary(file);
}

std::vector<Vector3> read_scan_graph_points(const fs::path& file, const ScanGraphNode& node) {
  FileParts parts(file);
  parts.skip(node.offset);
  const std::string bytes = parts.read(node.bytes);
  std::vector<Vector3> points = node.line > 0 ? text_points(file, node, bytes) : binary_points(file, node, bytes);
  const Eigen::Matrix3d to_camera = camera_in_body().linear().transpose();
  for (Vector3& point : points) point = to_camera * point;
  return points;
}

}  // namespace nextview
