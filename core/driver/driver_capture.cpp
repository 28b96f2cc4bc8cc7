#include "core/driver/driver_capture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/cloud/point_cloud.hpp"
#include "core/file/npy_file.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"
#include "core/recording/depth_image_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
  throw std::runtime_error(fmt::format("{}: {}", printable(file.string()), reason));
}

void require_size(const fs::path& file, int width, int height, const PinholeCamera& camera) {
  if (width != camera.width || height != camera.height)
    refuse(file, fmt::format("has {} x {} pixels; the driver's camera has {} x {}", width, height, camera.width,
                             camera.height));
}

DepthImage ranges_of_png(const fs::path& file, const CapturedFile& captured, const PinholeCamera& camera) {
  if (captured.scale <= 0.0) refuse(file, "is an image, and the driver does not say its 'scale' [m]");
  if (captured.measures != "z" && captured.measures != "range")
    refuse(file, "is an image, and the driver does not say what it 'measures': \"z\" or \"range\"");
  DepthFormat format;
  format.scale = captured.scale;
  format.measures = captured.measures == "z" ? DepthMeasures::z : DepthMeasures::range;
  DepthImage image = read_depth_image(file, format, camera);
  require_size(file, image.camera.width, image.camera.height, camera);
  return image;
}

DepthImage ranges_of_npy(const fs::path& file, const PinholeCamera& camera) {
  NpyTable table = read_npy(file);
  require_size(file, table.columns, table.rows, camera);
  for (const float range : table.values)
    if (range <= 0.0f)
      refuse(file, fmt::format("holds the range {:g}; ranges are over 0, NaN is an invalid pixel, inf one beyond range",
                               range));
  return {camera, std::move(table.values)};
}

std::vector<Vector3> points_of_ply(const fs::path& file) {
  open_regular_file(file);
  std::vector<Vector3> points;
  for (const Eigen::Vector3f& point : read_ply(file)) points.push_back(point.cast<double>());
  return points;
}

/// Millimetres that were taken for metres would be a scan of what is not there.
void require_unit(const fs::path& file, const Capture& capture) {
  constexpr double by_far = 10.0;
  std::size_t ranges = 0, too_far = 0;
  double largest = 0.0;
  const auto look_at = [&](double range) {
    if (!std::isfinite(range)) return;
    ++ranges;
    too_far += range > by_far * capture.max_range;
    largest = std::max(largest, range);
  };
  if (const auto* points = std::get_if<std::vector<Vector3>>(&capture.measured))
    for (const Vector3& point : *points) look_at(point.norm());
  else
    for (const float range : std::get<DepthImage>(capture.measured).range) look_at(double(range));
  if (2 * too_far > ranges)
    refuse(file, fmt::format("ranges up to {:.3g} m, but hello says max_range {:.3g} m: are they millimetres?", largest,
                             capture.max_range));
}

bool is_empty(const std::variant<DepthImage, std::vector<Vector3>>& measured) {
  if (const auto* points = std::get_if<std::vector<Vector3>>(&measured)) return points->empty();
  return std::ranges::all_of(std::get<DepthImage>(measured).range, [](float range) { return std::isnan(range); });
}

}  // namespace

Capture read_capture(const CapturedFile& captured, const fs::path& folder, const PinholeCamera& camera,
                     double max_range) {
  const fs::path file = folder / captured.file;
  const std::string ending = file.extension().string();
  Capture capture{{}, captured.T_world_camera, max_range};
  if (ending == ".npy")
    capture.measured = ranges_of_npy(file, camera);
  else if (ending == ".png")
    capture.measured = ranges_of_png(file, captured, camera);
  else if (ending == ".ply")
    capture.measured = points_of_ply(file);
  else
    refuse(file, "is of no kind that a capture is read from: .npy, .png, .ply");
  if (is_empty(capture.measured))
    throw NothingMeasured(
        fmt::format("{}: nothing was measured: it holds neither a range nor a free way", printable(file.string())));
  require_unit(file, capture);
  return capture;
}

}  // namespace nextview
