#include "core/recording/pose_files.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/recording/number_lines.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using Matrix34 = Eigen::Matrix<double, 3, 4>;

constexpr double rotation_tolerance = 1e-3;

/// A pose as the file holds it, before directions and axes.
struct FoundPose {
  Matrix34 matrix;
  std::string heading;
  std::optional<double> time = {};
  std::size_t line = 0;
  std::string fault = {};  // that was seen before it was a matrix
};

/// Why this is no pose, or nothing.
std::string fault(const Matrix34& m) {
  const Eigen::Matrix3d r = m.leftCols<3>();
  const double error = (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= rotation_tolerance))
    return fmt::format("the pose's rotation is none: its columns are off length 1 and right angles by {:.3g}", error);
  if (r.determinant() < 0.0) return "the pose mirrors; its rotation must be right-handed";
  return "";
}

Pose rigid(const Matrix34& m) {
  Pose pose = Pose::Identity();
  pose.linear() = m.leftCols<3>();
  // The nearest rotation, by Newton's method (Higham 1986), which doubles the right digits each time.
  for (int i = 0; i < 6; ++i) pose.linear() = (0.5 * (pose.linear() + pose.linear().inverse().transpose())).eval();
  pose.translation() = m.col(3);
  return pose;
}

NamedPose named_pose(const fs::path& file, const FoundPose& found, PoseDirection direction, PoseAxes axes) {
  NamedPose named{Pose::Identity(), found.heading, found.time, found.line};
  named.is_unknown = !found.matrix.allFinite();
  if (named.is_unknown) return named;
  if (const std::string why = found.fault.empty() ? fault(found.matrix) : found.fault; !why.empty()) {
    named.fault = line_failure(file, found.line, why).what();
    return named;
  }
  Pose pose = rigid(found.matrix);
  if (direction == PoseDirection::world_to_sensor) pose = pose.inverse();
  if (!is_pose(pose)) {
    named.fault = line_failure(file, found.line, fmt::format("the pose lies over {:g} m off", farthest_pose)).what();
    return named;
  }
  named.T_world_camera = axes == PoseAxes::body ? pose * camera_in_body() : pose;
  return named;
}

/// Whether a row of four ends a matrix. Of a pose that is not known, it may be unknown too.
bool is_last_row(const std::vector<double>& row) {
  return (row[0] == 0 && row[1] == 0 && row[2] == 0) || !std::isfinite(row[0]);
}

/// The rows of one or several matrices below one another: of four rows each if each fourth is 0 0 0 1, else of three.
void add_rows(const fs::path& file, const NumberBlock& block, std::vector<FoundPose>& found) {
  const std::size_t rows = block.rows.size();
  bool by_four = rows % 4 == 0;
  for (std::size_t i = 3; by_four && i < rows; i += 4) by_four = is_last_row(block.rows[i].numbers);
  const std::size_t step = by_four ? 4 : 3;
  if (rows % step != 0)
    throw line_failure(file, block.rows.front().line,
                       fmt::format("expected 3 or 4 rows of 4 numbers as a pose, the fourth 0 0 0 1, found {}", rows));
  for (std::size_t i = 0; i < rows; i += step) {
    FoundPose pose{{}, block.heading, {}, block.rows[i].line};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) pose.matrix(r, c) = block.rows[i + std::size_t(r)].numbers[std::size_t(c)];
    if (by_four && block.rows[i + 3].numbers[3] != 1.0) pose.fault = "the last row of a pose must be 0 0 0 1";
    found.push_back(pose);
  }
}

/// Whether four of 16 numbers, `step` apart, are 0 0 0 1: the last row, or of a matrix by columns what is left of it.
bool is_end(const std::vector<double>& numbers, std::size_t first, std::size_t step) {
  constexpr double rounding = 1e-6;
  const auto off = [&](std::size_t k, double from) { return std::abs(numbers[first + k * step] - from); };
  return std::max({off(0, 0.0), off(1, 0.0), off(2, 0.0), off(3, 1.0)}) <= rounding;
}

/// Matrices in a line each, of 16 numbers or 12. Returns whether they stand by columns.
bool add_lines(const NumberBlock& block, std::vector<FoundPose>& found) {
  const bool whole = block.columns() == 16;
  const bool by_columns = whole && std::ranges::any_of(block.rows, [](const NumberLine& row) {
                            return is_end(row.numbers, 3, 4) && !is_end(row.numbers, 12, 1);
                          });
  for (const NumberLine& row : block.rows) {
    FoundPose pose{
        Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(row.numbers.data()), row.words, {}, row.line};
    if (by_columns) pose.matrix = Eigen::Map<const Eigen::Matrix4d>(row.numbers.data()).topRows<3>();
    if (whole && !is_end(row.numbers, by_columns ? 3 : 12, by_columns ? 4 : 1))
      pose.fault = "the last row of a pose must be 0 0 0 1";
    found.push_back(pose);
  }
  return by_columns;
}

std::vector<FoundPose> matrices(const fs::path& file, const std::string& text,
                                const std::function<void(const std::string&)>& notice) {
  std::vector<FoundPose> found;
  bool by_columns = false;
  for (const NumberBlock& block : number_blocks(text)) {
    if (block.columns() == 4) add_rows(file, block, found);
    if (block.columns() == 12 || block.columns() == 16) by_columns |= add_lines(block, found);
  }
  if (by_columns && notice) notice("poses of 16 numbers a line are taken by columns, for so they end with 0 0 0 1");
  return found;
}

/// A line of position and quaternion; what stands before the seven numbers is a timestamp in tum, else may be the
/// frame's number.
FoundPose quaternion_pose(const fs::path& file, const NumberLine& line, PoseFormat format) {
  const bool is_numbered = line.numbers.size() == 8 && line.words.empty() && format != PoseFormat::conf &&
                           line.numbers[0] >= 0.0 && line.numbers[0] == std::floor(line.numbers[0]);
  const std::size_t before = format == PoseFormat::tum || is_numbered ? 1 : 0;
  if (line.numbers.size() != before + 7)
    throw line_failure(file, line.line, fmt::format("expected {} numbers, found {}", before + 7, line.numbers.size()));
  const double* v = line.numbers.data() + before;
  const bool w_first = format == PoseFormat::quaternion_wxyz;
  Eigen::Quaterniond q =
      w_first ? Eigen::Quaterniond(v[3], v[4], v[5], v[6]) : Eigen::Quaterniond(v[6], v[3], v[4], v[5]);
  FoundPose pose{{}, is_numbered ? fmt::format("{:.0f}", line.numbers[0]) : line.words, {}, line.line};
  if (std::isfinite(q.norm()) && std::abs(q.norm() - 1.0) > rotation_tolerance)
    pose.fault = fmt::format("the quaternion has length {:.6g}; it must be 1", q.norm());
  q.normalize();
  pose.matrix << (format == PoseFormat::conf ? q.conjugate() : q).toRotationMatrix(), Vector3(v[0], v[1], v[2]);
  if (format == PoseFormat::tum) pose.time = line.numbers.front();
  return pose;
}

std::vector<FoundPose> quaternions(const fs::path& file, const std::string& text, PoseFormat format) {
  constexpr std::string_view keyword = "bmesh ";
  std::vector<FoundPose> found;
  for (NumberLine& line : number_lines(text)) {
    if (format == PoseFormat::conf) {
      if (!line.words.starts_with(keyword)) continue;
      line.words.erase(0, keyword.size());
    } else if (line.numbers.empty()) {
      continue;
    }
    found.push_back(quaternion_pose(file, line, format));
  }
  return found;
}

PinholeCamera camera_of(const NumberBlock& block) {
  if (block.rows.size() == 1) {
    const auto& v = block.rows.front().numbers;
    return {0, 0, v[0], v[1], v[2], v[3]};
  }
  const auto at = [&](std::size_t row, std::size_t column) { return block.rows[row].numbers[column]; };
  return {0, 0, at(0, 0), at(1, 1), at(0, 2), at(1, 2)};
}

}  // namespace

Pose camera_in_body() {
  Pose T_body_camera = Pose::Identity();
  T_body_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return T_body_camera;
}

std::optional<Pose> NamedPose::pose() const {
  if (!fault.empty()) throw std::runtime_error(fault);
  return is_unknown ? std::nullopt : std::optional(T_world_camera);
}

std::vector<NamedPose> read_poses(const fs::path& file, PoseFormat format, PoseDirection direction, PoseAxes axes,
                                  const std::function<void(const std::string&)>& notice) {
  const std::string text = read_text(file);
  const std::vector<FoundPose> found =
      format == PoseFormat::matrix4x4 ? matrices(file, text, notice) : quaternions(file, text, format);
  if (found.empty()) throw std::runtime_error(fmt::format("{}: holds no pose", file.string()));
  std::vector<NamedPose> poses;
  poses.reserve(found.size());
  for (const FoundPose& pose : found) poses.push_back(named_pose(file, pose, direction, axes));
  return poses;
}

PinholeCamera read_intrinsics(const fs::path& file, const std::string& heading) {
  for (const NumberBlock& block : number_blocks(read_text(file))) {
    if (block.heading.find(heading) == std::string::npos) continue;
    const bool matrix =
        (block.columns() == 3 && block.rows.size() == 3) || (block.columns() == 4 && block.rows.size() == 4);
    if (!matrix && !(block.columns() == 4 && block.rows.size() == 1)) continue;
    const PinholeCamera camera = camera_of(block);
    const Eigen::Vector4d values(camera.fx, camera.fy, camera.cx, camera.cy);
    if (!values.allFinite() || !(camera.fx > 0.0) || !(camera.fy > 0.0)) continue;
    return camera;
  }
  throw std::runtime_error(
      fmt::format("{}: holds no matrix of intrinsics{}{}", file.string(), heading.empty() ? "" : " below ", heading));
}

}  // namespace nextview
