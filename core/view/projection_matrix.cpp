#include "core/view/projection_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/file/counted.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 25;  // as the views file's [bytes]
constexpr std::size_t most = 100'000;                             // views, likewise; and files of a folder

/// A line that is not blank, as its words.
struct Line {
  std::size_t number = 0;  ///< in the file, from 1
  std::vector<std::string> words;
};

std::vector<Line> lines_of(const std::string& text, std::size_t at_most) {
  std::vector<Line> lines;
  std::istringstream in(text);
  std::size_t number = 1;
  for (std::string line; lines.size() < at_most && std::getline(in, line); ++number) {
    std::istringstream words(line);
    Line found{number, {std::istream_iterator<std::string>(words), {}}};
    if (!found.words.empty()) lines.push_back(std::move(found));
  }
  return lines;
}

std::optional<double> number(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  return end == word.c_str() + word.size() ? std::optional(value) : std::nullopt;
}

bool begins_as_projection(const std::vector<Line>& lines) {
  if (lines.empty() || (lines.front().words.size() != 4 && lines.front().words.size() != 12)) return false;
  return number(lines.front().words.front()).has_value();
}

Pose camera_of(const std::vector<double>& v) {
  return decompose_projection(Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(v.data())).T_world_camera;
}

std::vector<Pose> projections_in(const fs::path& file, const std::vector<Line>& lines) {
  const auto fail = [&](std::size_t line, const std::string& reason) {
    return std::runtime_error(fmt::format("{}:{}: {}", file.string(), line, reason));
  };
  std::vector<Pose> cameras;
  std::vector<double> values;
  std::size_t first = 0;
  const std::size_t columns = lines.front().words.size();
  for (const Line& line : lines) {
    if (line.words.size() != columns)
      throw fail(line.number, fmt::format("expected {} numbers of a 3 x 4 projection matrix, found {}", columns,
                                          counted(line.words.size(), "word")));
    if (values.empty()) first = line.number;
    for (const std::string& word : line.words) {
      values.push_back(number(word).value_or(std::nan("")));
      if (!std::isfinite(values.back()))
        throw fail(line.number, fmt::format("'{:.40}' is no finite number", printable(word)));
    }
    if (values.size() < 12) continue;
    try {
      cameras.push_back(camera_of(values));
    } catch (const std::invalid_argument& error) {
      throw fail(first, error.what());
    }
    values.clear();
  }
  if (!values.empty()) throw fail(first, "a 3 x 4 projection matrix has three lines of four numbers");
  if (cameras.size() > most) throw fail(1, fmt::format("more than {} views", most));
  return cameras;
}

/// The files of a folder, pos_2.txt before pos_10.txt.
std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error, ignored;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (fs::is_regular_file(entry->path(), ignored)) files.push_back(entry->path());
  if (error) throw std::runtime_error(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  if (files.size() > most) throw std::runtime_error(fmt::format("{}: holds over {} files", folder.string(), most));
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    return ::strverscmp(a.filename().c_str(), b.filename().c_str()) < 0;
  });
  return files;
}

std::vector<Pose> projections_in_folder(const fs::path& folder, const std::function<void(const std::string&)>& notice) {
  constexpr std::uintmax_t largest = 1 << 16;  // one matrix has some hundred bytes
  std::vector<Pose> cameras;
  std::vector<fs::path> others;
  for (const fs::path& file : files_of(folder)) {
    std::error_code ignored;
    const auto size = fs::file_size(file, ignored);
    const auto lines = size > largest ? std::vector<Line>{} : lines_of(read_file(file, largest), largest);
    if (!begins_as_projection(lines)) {
      others.push_back(file.filename());
      continue;
    }
    const std::vector<Pose> those = projections_in(file, lines);
    cameras.insert(cameras.end(), those.begin(), those.end());
  }
  if (cameras.empty())
    throw std::runtime_error(fmt::format(
        "{}: none of its {} holds a 3 x 4 projection matrix (three lines of four numbers, as DTU's pos_001.txt)",
        folder.string(), counted(others.size(), "file")));
  if (notice && !others.empty())
    notice(fmt::format("{}: {} without a projection matrix passed over: {}{}", folder.string(),
                       counted(others.size(), "file"), printable(others.front().string()),
                       others.size() > 1 ? ", …" : ""));
  return cameras;
}

}  // namespace

DecomposedProjection decompose_projection(const ProjectionMatrix& projection) {
  const auto refuse = [] {
    throw std::invalid_argument("the projection matrix is no camera's: its first three columns cannot be inverted");
  };
  if (!projection.allFinite()) refuse();
  Eigen::Matrix3d m = projection.leftCols<3>();
  const double scale = (m.determinant() < 0.0 ? -1.0 : 1.0) * m.row(2).norm();  // P is known up to a factor
  if (!(std::abs(scale) > 0.0)) refuse();
  m /= scale;
  // K by rows from below: the third row of R is m's, and each next one what is at right angles to those below.
  const Vector3 r3 = m.row(2);
  const double cy = m.row(1).dot(r3);
  const Vector3 v2 = m.row(1).transpose() - cy * r3;
  const double fy = v2.norm(), cx = m.row(0).dot(r3);
  if (!(fy > 1e-9 * m.row(1).norm())) refuse();
  const Vector3 r2 = v2 / fy;
  const double skew = m.row(0).dot(r2);
  const Vector3 v1 = m.row(0).transpose() - cx * r3 - skew * r2;
  const double fx = v1.norm();
  if (!(fx > 1e-9 * m.row(0).norm())) refuse();
  Pose T_camera_world = Pose::Identity();
  T_camera_world.linear() << (v1 / fx).transpose(), r2.transpose(), r3.transpose();
  const Vector3 centre = -m.inverse() * projection.col(3) / scale;
  T_camera_world.translation() = -(T_camera_world.linear() * centre);
  DecomposedProjection result{fx, fy, cx, cy, T_camera_world.inverse()};
  if (!is_pose(result.T_world_camera)) refuse();
  return result;
}

bool has_projections(const std::string& text) { return begins_as_projection(lines_of(text, 1)); }

std::vector<Pose> read_projections(const fs::path& file_or_folder,
                                   const std::function<void(const std::string&)>& notice) {
  std::error_code ignored;
  if (fs::is_directory(file_or_folder, ignored)) return projections_in_folder(file_or_folder, notice);
  const auto lines = lines_of(read_file(file_or_folder, largest_file), largest_file);
  if (!begins_as_projection(lines))
    throw std::runtime_error(
        fmt::format("{}:1: expected a 3 x 4 projection matrix, three lines of four numbers", file_or_folder.string()));
  return projections_in(file_or_folder, lines);
}

}  // namespace nextview
