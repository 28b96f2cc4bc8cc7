#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "core/cloud/ply_header.hpp"
#include "core/cloud/point_cloud.hpp"
#include "core/file/atomic_file.hpp"
#include "core/file/gzip_file.hpp"

namespace nextview {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written as the memory lies");
static_assert(sizeof(Eigen::Vector3f) == 12, "points are written as they lie in memory");

constexpr std::uintmax_t largest_file = std::uintmax_t(4) << 30;

template <class T>
T from_bytes(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

double decode(const char* bytes, const PlyType& type) {
  if (type.kind == PlyType::is_float) return type.size == 4 ? from_bytes<float>(bytes) : from_bytes<double>(bytes);
  const bool is_signed = type.kind == PlyType::is_signed;
  if (type.size == 1) return is_signed ? from_bytes<std::int8_t>(bytes) : from_bytes<std::uint8_t>(bytes);
  if (type.size == 2) return is_signed ? from_bytes<std::int16_t>(bytes) : from_bytes<std::uint16_t>(bytes);
  return is_signed ? double(from_bytes<std::int32_t>(bytes)) : double(from_bytes<std::uint32_t>(bytes));
}

/// Reads the vertices out of a file's bytes. Throws the reason alone; the file's name is added by who knows it.
class VertexReader {
 public:
  explicit VertexReader(std::string_view data) : data_(data), header_(parse_ply_header(data)), at_(header_.size) {}

  const std::vector<std::string>& unknown_lines() const { return header_.unknown_lines; }

  PointCloud read(NotFinite not_finite) {
    for (const PlyElement& element : header_.elements) {
      check_size(element);
      if (element.name == "vertex") return read_vertices(element, not_finite);
      for (std::uint64_t row = 0; row < element.count; ++row)
        for (const PlyProperty& property : element.properties) read_property(property, element, row);
    }
    throw std::runtime_error("it has no element 'vertex'");
  }

 private:
  /// Before anything is allocated: what an element claims must fit into what is left of the file.
  void check_size(const PlyElement& element) const {
    const bool ascii = header_.format == PlyFormat::ascii;
    std::uint64_t smallest_row = 0;  // ASCII: a digit and a separator each; the last of the file may lack the latter
    for (const PlyProperty& p : element.properties)
      smallest_row += ascii ? 2 : p.list_size ? p.list_size->size : p.type.size;
    const std::uint64_t left = data_.size() - at_;
    if (element.count > 0 && (smallest_row == 0 || element.count > (left + ascii) / smallest_row))
      throw std::runtime_error(fmt::format(
          "element '{:.60}' claims {} entries, but only {} bytes are left; the file is truncated or damaged",
          element.name, element.count, left));
  }

  double read_ascii(const PlyElement& element, std::uint64_t row) {
    at_ = std::min(data_.find_first_not_of(" \t\r\n", at_), data_.size());
    double value = 0.0;
    const auto [end, error] = std::from_chars(data_.data() + at_, data_.data() + data_.size(), value);
    if (error == std::errc::invalid_argument)
      throw std::runtime_error(fmt::format("{} {} of {} is cut off or holds something that is no number", element.name,
                                           row + 1, element.count));
    at_ = static_cast<std::size_t>(end - data_.data());
    return error == std::errc() ? value : std::nan("");  // beyond what a double holds
  }

  double read_scalar(const PlyType& type, const PlyElement& element, std::uint64_t row) {
    if (header_.format == PlyFormat::ascii) return read_ascii(element, row);
    if (data_.size() - at_ < type.size)
      throw std::runtime_error(
          fmt::format("it ends within {} {} of {}; the file is truncated", element.name, row + 1, element.count));
    std::array<char, 8> bytes{};
    std::memcpy(bytes.data(), data_.data() + at_, type.size);
    if (header_.format == PlyFormat::binary_big_endian) std::reverse(bytes.data(), bytes.data() + type.size);
    at_ += type.size;
    return decode(bytes.data(), type);
  }

  /// The value; of lists the length.
  double read_property(const PlyProperty& property, const PlyElement& element, std::uint64_t row) {
    if (!property.list_size) return read_scalar(property.type, element, row);
    const double length = read_scalar(*property.list_size, element, row);
    for (double i = 0.0; i < length; i += 1.0) read_scalar(property.type, element, row);
    return length;
  }

  PointCloud read_vertices(const PlyElement& element, NotFinite not_finite) {
    const std::vector<int> axis_of = axes(element);
    PointCloud cloud(element.count);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      for (std::size_t i = 0; i < axis_of.size(); ++i) {
        const double value = read_property(element.properties[i], element, row);
        if (axis_of[i] >= 0) cloud[row][axis_of[i]] = static_cast<float>(value);
      }
      if (not_finite == NotFinite::refused && !cloud[row].allFinite())
        throw std::runtime_error(fmt::format("vertex {} of {} is not finite", row + 1, element.count));
    }
    return cloud;
  }

  /// Of each property the axis whose coordinate it is, or -1.
  static std::vector<int> axes(const PlyElement& element) {
    std::vector<int> axis_of;
    int found = 0;
    for (const PlyProperty& p : element.properties) {
      const bool coordinate = !p.list_size && (p.name == "x" || p.name == "y" || p.name == "z");
      axis_of.push_back(coordinate ? p.name[0] - 'x' : -1);
      if (coordinate) found |= 1 << axis_of.back();
    }
    if (found != 7) throw std::runtime_error("its vertices lack x, y or z");
    return axis_of;
  }

  std::string_view data_;
  PlyHeader header_;
  std::size_t at_;  ///< where reading goes on [bytes]
};

}  // namespace

void write_ply(const PointCloud& cloud, const std::filesystem::path& file) {
  AtomicFile out(file);
  out.stream() << "ply\nformat binary_little_endian 1.0\ncomment points [m, world]\nelement vertex " << cloud.size()
               << "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  out.stream().write(reinterpret_cast<const char*>(cloud.data()), static_cast<std::streamsize>(cloud.size() * 12));
  out.commit();
}

PointCloud read_ply(const std::filesystem::path& file, const std::function<void(const std::string&)>& notice,
                    NotFinite not_finite) {
  const std::string data = file.extension() == ".gz" ? read_gzip_file(file) : read_file(file, largest_file);
  try {
    VertexReader reader(data);
    if (notice && !reader.unknown_lines().empty()) notice(reader.unknown_lines().front());
    return reader.read(not_finite);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: cannot be read: {}", file.string(), error.what()));
  }
}

}  // namespace nextview
