#include "core/gibbs/range_measurements.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace nextview {
namespace {

/// A ray of one scan with the cell of directions that it is in.
struct CellRay {
  std::uint64_t cell;
  float range;  ///< infinity beyond range
  std::uint32_t ray;

  /// By cell, then range, then number: compared as whole numbers, as ranges are not negative.
  bool operator<(const CellRay& other) const {
    return cell != other.cell ? cell < other.cell : within_cell() < other.within_cell();
  }
  std::uint64_t within_cell() const { return std::uint64_t{std::bit_cast<std::uint32_t>(range)} << 32 | ray; }
};

/// Each of 29 bits at the place of twice its number.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000ffff0000ffff;
  bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
  bits = (bits | bits << 2) & 0x3333333333333333;
  return (bits | bits << 1) & 0x5555555555555555;
}

/// Numbers the cells of a scan, neighbours near each other (a Z-order curve): gnomonic around the scan's mean direction
/// within 60 degrees of it, one face of a cube each beyond, so that a panorama has cells too.
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
    return face << 58 | spread(cell(d[(axis + 1) % 3])) << 1 | spread(cell(d[(axis + 2) % 3]));
  }

 private:
  double spacing_;
  Vector3 x_, y_, z_;
};

/// One ray for its members.
RangeMeasurement merged(const RangeMeasurements& from, std::span<const CellRay> members) {
  Vector3 end = Vector3::Zero();
  std::uint32_t weight = 0;
  for (const CellRay& m : members) {
    const RangeMeasurement& ray = from.rays[m.ray];
    end += ray.weight * ray.end.cast<double>();
    weight += ray.weight;
  }
  RangeMeasurement ray = from.rays[members.front().ray];
  ray.end = (end / weight).cast<float>();
  ray.weight = weight;
  return ray;
}

/// The rays of one origin, merged.
std::vector<RangeMeasurement> merge_origin(const RangeMeasurements& measurements,
                                           std::span<const std::uint32_t> numbers, double spacing, double spread) {
  Vector3 mean = Vector3::Zero();
  for (const std::uint32_t n : numbers) mean += measurements.direction(measurements.rays[n]);
  const DirectionCells cells(mean, spacing);
  std::vector<CellRay> rays;
  rays.reserve(numbers.size());
  for (const std::uint32_t n : numbers) {
    const RangeMeasurement& ray = measurements.rays[n];
    const float range =
        ray.beyond_range ? std::numeric_limits<float>::infinity() : static_cast<float>(measurements.range(ray));
    rays.push_back({cells(measurements.direction(ray)), range, n});
  }
  std::sort(rays.begin(), rays.end());
  std::vector<RangeMeasurement> result;
  for (std::size_t first = 0, last; first < rays.size(); first = last) {
    const float limit = rays[first].range + static_cast<float>(spread);  // infinite beyond range
    last = first + 1;
    while (last < rays.size() && rays[last].cell == rays[first].cell && rays[last].range <= limit) ++last;
    result.push_back(merged(measurements, std::span(rays).subspan(first, last - first)));
  }
  return result;
}

RangeMeasurements merge_each_origin(const RangeMeasurements& measurements, const std::vector<double>& spacings,
                                    double spread) {
  if (std::all_of(spacings.begin(), spacings.end(), [](double s) { return s <= 0.0; })) return measurements;
  std::vector<std::vector<std::uint32_t>> of_origin(measurements.origins.size());
  for (std::uint32_t n = 0; n < measurements.rays.size(); ++n) of_origin[measurements.rays[n].origin].push_back(n);
  std::vector<std::vector<RangeMeasurement>> merged(of_origin.size());
  tbb::parallel_for(std::size_t{0}, of_origin.size(),
                    [&](std::size_t k) { merged[k] = merge_origin(measurements, of_origin[k], spacings[k], spread); });
  RangeMeasurements result{measurements.max_range, measurements.origins, {}};
  for (const auto& rays : merged) result.rays.insert(result.rays.end(), rays.begin(), rays.end());
  return result;
}

}  // namespace

void RangeMeasurements::add(const Scan& scan) {
  const auto origin = static_cast<std::uint32_t>(origins.size());
  origins.push_back(scan.origin);
  const auto append = [&](const Eigen::Vector3f& end, bool beyond_range) {
    const double range = (end.cast<double>() - scan.origin).norm();
    if (range > 0.0) rays.push_back({end, origin, 1, beyond_range || range > max_range});
  };
  for (const Eigen::Vector3f& end : scan.hits) append(end, false);
  for (const Eigen::Vector3f& end : scan.misses) append(end, true);
}

RangeMeasurements measurements_of(std::span<const Scan> scans) {
  const double max_range = scans.front().max_range;
  if (!std::isfinite(max_range))
    throw std::invalid_argument(
        "a Gibbs map needs the sensor's maximum range (Scan::max_range): up to there a ray that met nothing saw");
  RangeMeasurements measurements{max_range, {}, {}};
  std::size_t rays = 0;
  for (const Scan& scan : scans) rays += scan.hits.size() + scan.misses.size();
  measurements.rays.reserve(rays);
  for (const Scan& scan : scans) measurements.add(scan);
  return measurements;
}

void RangeMeasurements::validate() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("range measurements: ") + what);
  };
  const auto near = [](const Vector3& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() <= 1e6; };
  require(max_range > 0.0 && max_range <= 1e6, "the maximum range must be over 0 and at most 1e6 m");
  for (const Vector3& origin : origins) require(near(origin), "a camera is not at a finite place within 1e6 m");
  for (const RangeMeasurement& ray : rays) {
    require(ray.origin < origins.size(), "a ray has a camera that does not exist");
    require(near(ray.end.cast<double>()), "a ray does not end at a finite place within 1e6 m");
    require(ray.weight > 0, "a ray stands for none");
    require(ray.end.cast<double>() != origins[ray.origin], "a ray ends where it begins");
  }
}

void RangeMeasurements::append(const RangeMeasurements& other) {
  const auto first = static_cast<std::uint32_t>(origins.size());
  origins.insert(origins.end(), other.origins.begin(), other.origins.end());
  for (RangeMeasurement ray : other.rays) {
    ray.origin += first;
    rays.push_back(ray);
  }
}

RangeMeasurements RangeMeasurements::after(const RangeMeasurements& earlier) const {
  const auto first_origin = static_cast<std::uint32_t>(earlier.origins.size());
  RangeMeasurements later{max_range,
                          {origins.begin() + first_origin, origins.end()},
                          {rays.begin() + static_cast<std::ptrdiff_t>(earlier.rays.size()), rays.end()}};
  for (RangeMeasurement& ray : later.rays) ray.origin -= first_origin;
  return later;
}

RangeMeasurements merge_rays(const RangeMeasurements& measurements, double spacing, double spread) {
  return merge_each_origin(measurements, std::vector<double>(measurements.origins.size(), spacing), spread);
}

RangeMeasurements merge_rays(const RangeMeasurements& measurements, const VoxelGrid& grid, double spacing,
                             double spread) {
  const Vector3 centre = 0.5 * (grid.lower() + grid.upper());
  std::vector<double> spacings;
  for (const Vector3& origin : measurements.origins)
    spacings.push_back(spacing * grid.resolution / std::max((origin - centre).norm(), grid.resolution));
  return merge_each_origin(measurements, spacings, spread * grid.resolution);
}

}  // namespace nextview
