#include "core/sensor/recorded_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "core/file/gzip_file.hpp"

namespace nextview {
namespace {

/// Takes a text apart line by line and word by word, and knows where it is when something is wrong.
class LineReader {
 public:
  LineReader(const std::filesystem::path& file, std::string_view text) : file_(file), rest_(text) {}

  /// False at the end of the text. Goes to the next line that has a word.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      skip_blanks();
      if (!line_.empty()) return true;
    }
    return false;
  }
  /// Empty at the end of the line.
  std::string_view word() {
    const std::string_view taken = line_.substr(0, line_.find_first_of(blanks));
    line_.remove_prefix(taken.size());
    skip_blanks();
    return taken;
  }
  double number(const char* form) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(line_.data(), line_.data() + line_.size(), value);
    if (error != std::errc() || !std::isfinite(value))
      throw failure(fmt::format("expected finite numbers as `{}`", form));
    advance(end, form);
    return value;
  }
  std::size_t count(const char* form) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(line_.data(), line_.data() + line_.size(), value);
    if (error != std::errc()) throw failure(fmt::format("expected a count at the end of `{}`", form));
    advance(end, form);
    return value;
  }
  void end_of_line(const char* form) const {
    if (!line_.empty()) throw failure(fmt::format("has more than `{}`", form));
  }
  std::size_t bytes_left() const { return rest_.size(); }
  std::runtime_error failure(const std::string& reason) const {
    return std::runtime_error(fmt::format("{}:{}: {}", file_.string(), number_, reason));
  }

 private:
  static constexpr std::string_view blanks = " \t\r";

  void skip_blanks() { line_.remove_prefix(std::min(line_.find_first_not_of(blanks), line_.size())); }
  void advance(const char* end, const char* form) {
    line_.remove_prefix(static_cast<std::size_t>(end - line_.data()));
    if (!line_.empty() && blanks.find(line_.front()) == std::string_view::npos)
      throw failure(fmt::format("expected numbers apart by blanks as `{}`", form));
    skip_blanks();
  }

  const std::filesystem::path& file_;
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

constexpr const char* param_form = "param NAME VALUE";
constexpr const char* scan_form = "scan px py pz qx qy qz qw N";
constexpr const char* view_form = "view px py pz qx qy qz qw";
constexpr const char* point_form = "x y z";
constexpr double farthest_point = 1e6;  // along each axis [m]; rays to there are still told apart

Pose read_pose(LineReader& reader, const char* form) {
  double v[7];
  for (double& value : v) value = reader.number(form);
  const Eigen::Quaterniond orientation(v[6], v[3], v[4], v[5]);
  if (std::abs(orientation.norm() - 1.0) > 1e-3)
    throw reader.failure(
        fmt::format("the quaternion (qx qy qz qw) has length {:.6g}; it must be 1", orientation.norm()));
  return make_pose({v[0], v[1], v[2]}, orientation);
}

void read_parameter(LineReader& reader, RecordedScene& scene) {
  const std::string name(reader.word());
  const double value = reader.number(param_form);
  reader.end_of_line(param_form);
  if (!scene.parameters.emplace(name, value).second)
    throw reader.failure(fmt::format("parameter {} is given twice", name));
}

RecordedScan read_scan(LineReader& reader) {
  RecordedScan scan;
  scan.T_world_camera = read_pose(reader, scan_form);
  const std::size_t count = reader.count(scan_form);
  reader.end_of_line(scan_form);
  constexpr std::size_t shortest_point = 6;  // "0 0 0\n"; the last line may lack its end
  if (count > (reader.bytes_left() + 1) / shortest_point)
    throw reader.failure(fmt::format("claims {} points, more than the rest of the file can hold", count));
  scan.points.reserve(count);
  while (scan.points.size() < count) {
    if (!reader.next_line())
      throw reader.failure(fmt::format("the file ends after {} of {} points", scan.points.size(), count));
    const double x = reader.number(point_form), y = reader.number(point_form), z = reader.number(point_form);
    reader.end_of_line(point_form);
    if (!(std::max({std::abs(x), std::abs(y), std::abs(z)}) <= farthest_point))
      throw reader.failure(fmt::format("the point lies beyond {:g} m from the sensor; remove it", farthest_point));
    scan.points.emplace_back(x, y, z);
  }
  return scan;
}

}  // namespace

bool is_scene_file(const std::filesystem::path& file) { return without_gz(file).extension() == ".txt"; }

RecordedScene read_recorded_scene(const std::filesystem::path& file) {
  const std::string text = read_plain_or_gzip(file);
  if (text.empty()) throw std::runtime_error(fmt::format("{}: is empty", file.string()));
  LineReader reader(file, text);
  RecordedScene scene;
  while (reader.next_line()) {
    const std::string_view keyword = reader.word();
    if (keyword == "param") {
      read_parameter(reader, scene);
    } else if (keyword == "scan") {
      scene.scans.push_back(read_scan(reader));
    } else if (keyword == "view") {
      scene.views.push_back(read_pose(reader, view_form));
      reader.end_of_line(view_form);
    } else if (scene.scans.empty() && scene.views.empty() && scene.parameters.empty()) {
      throw std::runtime_error(fmt::format(
          "{}: is no scene, whose first line begins with 'param', 'scan' or 'view'; other files end otherwise: meshes "
          "(.stl, .ply, .obj, …), clouds (.ply, .pcd), scan graphs (.graph, .log), settings (.toml)",
          file.string()));
    } else {
      throw reader.failure(fmt::format("expected a line `{}`, `{}` or `{}`", param_form, scan_form, view_form));
    }
  }
  if (scene.scans.empty()) throw std::runtime_error(fmt::format("{}: holds no scan", file.string()));
  return scene;
}

}  // namespace nextview
