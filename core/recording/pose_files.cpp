#include "core/recording/pose_files.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>

#include "core/recording/number_lines.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;
using Matrix34 = Eigen::Matrix<double, 3, 4>;

constexpr double rotation_tolerance = 1e-3;
constexpr double farthest = 1e6;  // [m]

/// A pose as the file holds it, before directions and axes.
struct FoundPose {
  Matrix34 matrix;
  std::string heading;
  std::optional<double> time = {};
  std::size_t line = 0;
};

/// Why this is no pose, or nothing.
std::string fault(const Matrix34& m) {
  if (!m.allFinite()) return "the pose is not finite";
  const Eigen::Matrix3d r = m.leftCols<3>();
  const double error = (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= rotation_tolerance))
    return fmt::format("the pose's rotation is none: its columns are off length 1 and right angles by {:.3g}", error);
  if (r.determinant() < 0.0) return "the pose mirrors; its rotation must be right-handed";
  if (m.col(3).cwiseAbs().maxCoeff() > farthest) return fmt::format("the pose lies over {:g} m off", farthest);
  return "";
}

Pose rigid(const Matrix34& m) {
  Pose pose = Pose::Identity();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m.leftCols<3>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  pose.linear() = svd.matrixU() * svd.matrixV().transpose();  // the nearest rotation
  pose.translation() = m.col(3);
  return pose;
}

Pose T_world_camera(const fs::path& file, const FoundPose& found, PoseDirection direction, PoseAxes axes) {
  if (const std::string why = fault(found.matrix); !why.empty()) throw line_failure(file, found.line, why);
  Pose pose = rigid(found.matrix);
  if (direction == PoseDirection::world_to_sensor) pose = pose.inverse();
  return axes == PoseAxes::body ? pose * camera_in_body() : pose;
}

bool is_last_row(const std::vector<double>& row) {
  return row == std::vector<double>{0, 0, 0, 1} || (row.size() == 4 && row[0] == 0 && row[1] == 0 && row[2] == 0);
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
    if (by_four && block.rows[i + 3].numbers[3] != 1.0)
      throw line_failure(file, block.rows[i + 3].line, "the last row of a pose must be 0 0 0 1");
    found.push_back(pose);
  }
}

std::vector<FoundPose> matrices(const fs::path& file, const std::string& text) {
  std::vector<FoundPose> found;
  for (const NumberBlock& block : number_blocks(text)) {
    if (block.columns() == 4) add_rows(file, block, found);
    if (block.columns() != 12 && block.columns() != 16) continue;
    for (const NumberLine& row : block.rows)
      found.push_back({Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(row.numbers.data()),
                       row.words,
                       {},
                       row.line});
  }
  return found;
}

/// A line of position and quaternion; what stands before the seven numbers is a timestamp in tum.
FoundPose quaternion_pose(const fs::path& file, const NumberLine& line, PoseFormat format) {
  const std::size_t before = format == PoseFormat::tum ? 1 : 0;
  if (line.numbers.size() != before + 7)
    throw line_failure(file, line.line, fmt::format("expected {} numbers, found {}", before + 7, line.numbers.size()));
  const double* v = line.numbers.data() + before;
  const bool w_first = format == PoseFormat::quaternion_wxyz;
  Eigen::Quaterniond q =
      w_first ? Eigen::Quaterniond(v[3], v[4], v[5], v[6]) : Eigen::Quaterniond(v[6], v[3], v[4], v[5]);
  if (!(std::abs(q.norm() - 1.0) <= rotation_tolerance))
    throw line_failure(file, line.line, fmt::format("the quaternion has length {:.6g}; it must be 1", q.norm()));
  q.normalize();
  FoundPose pose{{}, line.words, {}, line.line};
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

std::vector<NamedPose> read_poses(const fs::path& file, PoseFormat format, PoseDirection direction, PoseAxes axes) {
  const std::string text = read_text(file);
  const std::vector<FoundPose> found =
      format == PoseFormat::matrix4x4 ? matrices(file, text) : quaternions(file, text, format);
  if (found.empty()) throw std::runtime_error(fmt::format("{}: holds no pose", file.string()));
  std::vector<NamedPose> poses;
  for (const FoundPose& pose : found)
    poses.push_back({T_world_camera(file, pose, direction, axes), pose.heading, pose.time, pose.line});
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
