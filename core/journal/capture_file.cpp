#include "core/journal/capture_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstring>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/file/npy_file.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "coordinates are copied as they are in the file");

constexpr std::string_view before_count = "ply\nformat binary_little_endian 1.0\nelement vertex ";
constexpr std::string_view after_count = "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";

void write_points(const std::vector<Vector3>& points, const fs::path& file) {
  AtomicFile out(file);
  out.stream() << before_count << points.size() << after_count;
  for (const Vector3& p : points) out.stream().write(reinterpret_cast<const char*>(p.data()), 3 * sizeof(double));
  out.commit();
}

std::vector<Vector3> points_of(const std::string& bytes, const fs::path& file) {
  const auto refuse = [&](const char* why) { throw std::runtime_error(fmt::format("{}: {}", file.string(), why)); };
  if (!bytes.starts_with(before_count)) refuse("is no PLY of points as sessions have them");
  std::size_t count = 0;
  const char* const end = bytes.data() + bytes.size();
  const auto [rest, error] = std::from_chars(bytes.data() + before_count.size(), end, count);
  const std::string_view body(rest, end);
  if (error != std::errc() || !body.starts_with(after_count)) refuse("is no PLY of points as sessions have them");
  const std::string_view values = body.substr(after_count.size());
  if (count > values.size() || values.size() != count * 3 * sizeof(double)) refuse("is cut short, or too long");
  std::vector<Vector3> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(points[i].data(), values.data() + i * 3 * sizeof(double), 3 * sizeof(double));
    if (!points[i].allFinite()) refuse("holds a point that is not finite");
  }
  return points;
}

DepthImage ranges_of(const std::string& bytes, const fs::path& file, const PinholeCamera& camera) {
  NpyTable table = npy_of(bytes, file);
  if (table.columns != camera.width || table.rows != camera.height)
    throw std::runtime_error(fmt::format("{}: has {} x {} pixels; the camera has {} x {}", file.string(), table.columns,
                                         table.rows, camera.width, camera.height));
  for (const float range : table.values)
    if (range < 0.0f) throw std::runtime_error(fmt::format("{}: holds the range {}", file.string(), range));
  return {camera, std::move(table.values)};
}

}  // namespace

std::string capture_name(const Capture& capture, std::uint32_t number) {
  return fmt::format("{:04}.{}", number, std::holds_alternative<DepthImage>(capture.measured) ? "npy" : "ply");
}

std::string write_capture(const Capture& capture, std::uint32_t number, const fs::path& folder) {
  std::string name = capture_name(capture, number);
  if (const auto* image = std::get_if<DepthImage>(&capture.measured))
    write_npy({image->camera.width, image->camera.height, image->range}, folder / name);
  else
    write_points(std::get<std::vector<Vector3>>(capture.measured), folder / name);
  keep_names(folder);
  return name;
}

std::variant<DepthImage, std::vector<Vector3>> captured_of(const std::string& bytes, const fs::path& file,
                                                           const PinholeCamera& camera) {
  if (file.extension() == ".ply") return points_of(bytes, file);
  return ranges_of(bytes, file, camera);
}

}  // namespace nextview
