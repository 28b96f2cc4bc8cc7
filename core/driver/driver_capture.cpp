#include "core/driver/driver_capture.hpp"

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <cmath>
#include <stdexcept>

#include "core/cloud/point_cloud.hpp"
#include "core/driver/npy_file.hpp"
#include "core/file/printable.hpp"
#include "core/file/read_file.hpp"

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

DepthImage ranges_of_npy(const fs::path& file, const PinholeCamera& camera) {
  NpyTable table = read_npy(file);
  require_size(file, table.columns, table.rows, camera);
  for (const float range : table.values)
    if (range <= 0.0f)
      refuse(file, fmt::format("holds the range {:g}; ranges are over 0, NaN is an invalid pixel, inf one beyond range",
                               range));
  return {camera, std::move(table.values)};
}

/// Grey values of 16 bits, row by row, of an image of the camera's size.
std::vector<std::uint16_t> read_png(const fs::path& file, const PinholeCamera& camera) {
  const std::string bytes = read_file(file, std::uintmax_t{256} << 20);
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) refuse(file, "is no image that can be read");
  require_size(file, width, height, camera);
  if (channels != 1 || !stbi_is_16_bit_from_memory(data, size)) refuse(file, "is no image of 16-bit grey values");
  const std::unique_ptr<stbi_us, void (*)(void*)> pixels(
      stbi_load_16_from_memory(data, size, &width, &height, &channels, 1), stbi_image_free);
  if (!pixels) refuse(file, fmt::format("is damaged ({})", stbi_failure_reason()));
  return {pixels.get(), pixels.get() + std::size_t(width) * std::size_t(height)};
}

DepthImage ranges_of_png(const fs::path& file, const CapturedFile& captured, const PinholeCamera& camera) {
  if (captured.scale <= 0.0) refuse(file, "is an image, and the driver does not say its 'scale' [m]");
  if (captured.measures != "z" && captured.measures != "range")
    refuse(file, "is an image, and the driver does not say what it 'measures': \"z\" or \"range\"");
  const std::vector<std::uint16_t> pixels = read_png(file, camera);
  DepthImage image{camera, std::vector<float>(pixels.size(), DepthImage::invalid)};
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (pixels[i] == 0) continue;
    const auto column = i % std::size_t(camera.width), row = i / std::size_t(camera.width);
    const double z_of_ray = camera.direction(double(column), double(row)).z();
    image.range[i] = float(pixels[i] * captured.scale / (captured.measures == "z" ? z_of_ray : 1.0));
  }
  return image;
}

std::vector<Vector3> points_of_ply(const fs::path& file) {
  open_regular_file(file);
  std::vector<Vector3> points;
  for (const Eigen::Vector3f& point : read_ply(file)) points.push_back(point.cast<double>());
  return points;
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
  return capture;
}

}  // namespace nextview
