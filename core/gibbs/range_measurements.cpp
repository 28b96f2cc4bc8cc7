#include "core/gibbs/range_measurements.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace nextview {
namespace {

/// A ray of one scan with the cell of directions that it is in.
struct CellRay {
  std::uint64_t cell;
  float range;  ///< infinity beyond range
  std::uint32_t ray;

  bool operator<(const CellRay& other) const {
    return std::tie(cell, range, ray) < std::tie(other.cell, other.range, other.ray);
  }
};

/// Numbers the cells of a scan: gnomonic around the scan's mean direction within 60 degrees of it, one face of a cube
/// each beyond, so that a panorama has cells too.
class DirectionCells {
 public:
  DirectionCells(const Vector3& mean, double spacing) : spacing_(spacing) {
    z_ = mean.norm() > 1e-9 ? Vector3(mean.normalized()) : Vector3::UnitZ();
    x_ = z_.unitOrthogonal();
    y_ = z_.cross(x_);
  }
  std::uint64_t operator()(const Vector3& direction) const {
    const Vector3 d(direction.dot(x_), direction.dot(y_), direction.dot(z_));
    Eigen::Index axis = 2;
    if (d.z() < 0.5) d.cwiseAbs().maxCoeff(&axis);
    const double depth = std::abs(d[axis]);
    const auto cell = [&](double v) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v / depth / spacing_)) + (1 << 28)) &
             0x1fffffff;
    };
    const std::uint64_t face = axis * 2 + (d[axis] < 0.0);
    return face << 58 | cell(d[(axis + 1) % 3]) << 29 | cell(d[(axis + 2) % 3]);
  }

 private:
  double spacing_;
  Vector3 x_, y_, z_;
};

/// One ray for its members.
RangeMeasurement joined(const RangeMeasurements& from, std::span<const CellRay> members) {
  Vector3 end = Vector3::Zero();
  std::uint32_t weight = 0;
  for (const CellRay& m : members) {
    const RangeMeasurement& ray = from.rays[m.ray];
    end += ray.weight * ray.end.cast<double>();
    weight += ray.weight;
  }
  RangeMeasurement ray = from.rays[members.front().ray];
  ray.end = (end / weight).cast<float>();
  ray.weight = static_cast<std::uint16_t>(std::min<std::uint32_t>(weight, std::numeric_limits<std::uint16_t>::max()));
  return ray;
}

}  // namespace

void RangeMeasurements::add(const Scan& scan) {
  const auto origin = static_cast<std::uint32_t>(origins.size());
  origins.push_back(scan.origin);
  rays.reserve(rays.size() + scan.returns.size() + scan.passes.size());
  const auto append = [&](const Eigen::Vector3f& end, bool beyond_range) {
    const double range = (end.cast<double>() - scan.origin).norm();
    if (range > 0.0) rays.push_back({end, origin, 1, beyond_range || range > max_range});
  };
  for (const Eigen::Vector3f& end : scan.returns) append(end, false);
  for (const Eigen::Vector3f& end : scan.passes) append(end, true);
}

RangeMeasurements join_rays(const RangeMeasurements& measurements, double spacing, double spread) {
  if (spacing <= 0.0) return measurements;
  RangeMeasurements result{measurements.max_range, measurements.origins, {}};
  std::vector<Vector3> mean(measurements.origins.size(), Vector3::Zero());
  for (const RangeMeasurement& ray : measurements.rays) mean[ray.origin] += measurements.direction(ray);
  std::vector<std::vector<CellRay>> of_origin(measurements.origins.size());
  std::vector<DirectionCells> cells;
  for (const Vector3& m : mean) cells.emplace_back(m, spacing);
  for (std::uint32_t n = 0; n < measurements.rays.size(); ++n) {
    const RangeMeasurement& ray = measurements.rays[n];
    const float range =
        ray.beyond_range ? std::numeric_limits<float>::infinity() : static_cast<float>(measurements.range(ray));
    of_origin[ray.origin].push_back({cells[ray.origin](measurements.direction(ray)), range, n});
  }
  for (auto& rays : of_origin) {
    std::sort(rays.begin(), rays.end());
    for (std::size_t first = 0, last; first < rays.size(); first = last) {
      const float limit = rays[first].range + static_cast<float>(spread);  // infinite beyond range
      last = first + 1;
      while (last < rays.size() && rays[last].cell == rays[first].cell && rays[last].range <= limit) ++last;
      result.rays.push_back(joined(measurements, std::span(rays).subspan(first, last - first)));
    }
  }
  return result;
}

}  // namespace nextview
