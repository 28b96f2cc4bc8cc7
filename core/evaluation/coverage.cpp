#include "core/evaluation/coverage.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "core/progress/stopped.hpp"

namespace nextview {

constexpr double cells_along_longest_side = 128.0;  // about as many cells as samples on a surface, and 8 MB at most

SurfaceCoverage::SurfaceCoverage(std::span<const Eigen::Vector3f> samples, double d_reg)
    : cells_(make_cells(samples, d_reg)), observed_(samples.size(), 0) {}

std::shared_ptr<const SurfaceCoverage::Cells> SurfaceCoverage::make_cells(std::span<const Eigen::Vector3f> samples,
                                                                          double d_reg) {
  if (samples.empty()) throw std::invalid_argument("coverage: there are no surface samples");
  if (!(d_reg > 0.0 && std::isfinite(d_reg)))
    throw std::invalid_argument(fmt::format("coverage: d_reg must be over 0 m, not {}", d_reg));

  Eigen::AlignedBox3f box;
  for (const auto& sample : samples) box.extend(sample);
  auto cells = std::make_shared<Cells>();
  cells->d_reg = d_reg;
  cells->lower = box.min().cast<double>();
  const Vector3 extent = box.max().cast<double>() - cells->lower;
  cells->edge = std::max(d_reg, extent.maxCoeff() / cells_along_longest_side);
  cells->size = (extent / cells->edge).array().floor().matrix().cast<int>() + Eigen::Vector3i::Ones();

  std::vector<std::pair<std::size_t, std::uint32_t>> order(samples.size());  // cell and number
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3i cell = cells->at(samples[i].cast<double>());
    order[i] = {(std::size_t(cell.z()) * cells->size.y() + cell.y()) * cells->size.x() + cell.x(), i};
  }
  tbb::parallel_sort(order.begin(), order.end());
  for (const auto& [cell, i] : order) cells->samples.push_back({samples[i], i});
  return cells;
}

/// Limited to the grid and one cell around it, so that any coordinate fits an int.
Eigen::Vector3i SurfaceCoverage::Cells::at(const Vector3& point) const {
  const Vector3 position = (point - lower) / edge;
  return position.cwiseMax(-1.0).cwiseMin(size.cast<double>()).array().floor().matrix().cast<int>();
}

namespace {

/// Points sorted by cell, in a grid with a cell more around it on each side.
class PointsByCell {
 public:
  template <class CellOf>
  PointsByCell(const PointCloud& points, const Eigen::Vector3i& size, const CellOf& cell_of)
      : size_(size + Eigen::Vector3i::Constant(2)),
        begin_(std::size_t(size_.x()) * size_.y() * size_.z() + 1),
        points_(points.size()) {
    std::vector<std::uint32_t> cells(points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) cells[i] = std::uint32_t(index(cell_of(points[i])));
    });
    for (const std::uint32_t cell : cells) ++begin_[cell];
    std::inclusive_scan(begin_.begin(), begin_.end(), begin_.begin());  // of each cell its end, until it is filled
    for (std::size_t i = points.size(); i-- > 0;) points_[--begin_[cells[i]]] = points[i];
  }
  /// Those in a row of cells along x.
  std::span<const Eigen::Vector3f> row(int first_x, int last_x, int y, int z) const {
    const std::uint32_t first = begin_[index({first_x, y, z})], end = begin_[index({last_x, y, z}) + 1];
    return std::span(points_).subspan(first, end - first);
  }

 private:
  std::size_t index(const Eigen::Vector3i& cell) const {
    return (std::size_t(cell.z() + 1) * size_.y() + std::size_t(cell.y() + 1)) * size_.x() + std::size_t(cell.x() + 1);
  }
  Eigen::Vector3i size_;
  std::vector<std::uint32_t> begin_;  ///< of each cell its first point, and the end
  PointCloud points_;
};

}  // namespace

/// Looks around each sample that is not observed yet for a point: most points are of surface that was seen before.
void SurfaceCoverage::add(const PointCloud& points, const std::stop_token& stop) {
  if (points.empty()) return;
  const Cells& c = *cells_;
  const PointsByCell by_cell(points, c.size, [&](const auto& point) { return c.at(point.template cast<double>()); });
  const auto is_near_a_point = [&](const Vector3& sample) {
    const Vector3 reach = Vector3::Constant(c.d_reg + 1e-6 * c.edge);  // a cell may be off by what a quotient rounds
    const Eigen::Vector3i first = c.at(sample - reach), last = c.at(sample + reach);
    for (int z = first.z(); z <= last.z(); ++z)
      for (int y = first.y(); y <= last.y(); ++y)
        for (const Eigen::Vector3f& point : by_cell.row(first.x(), last.x(), y, z))
          if ((sample - point.cast<double>()).squaredNorm() <= c.d_reg * c.d_reg) return true;
    return false;
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, c.samples.size(), 512), [&](const auto& range) {
    if (stop.stop_requested()) return;
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      std::uint8_t& observed = observed_[c.samples[i].index];
      if (!observed && is_near_a_point(c.samples[i].point.cast<double>())) observed = 1;
    }
  });
  throw_if_stopped(stop);
}

void SurfaceCoverage::set_observed(std::vector<std::uint8_t> observed) {
  if (observed.size() != observed_.size()) throw std::invalid_argument("they are other samples");
  observed_ = std::move(observed);
}

double SurfaceCoverage::of_all() const {  // Eq. 17
  return double(std::count(observed_.begin(), observed_.end(), 1)) / double(observed_.size());
}

double SurfaceCoverage::of(std::span<const std::uint8_t> counted) const {  // Eq. 17 over some samples
  std::size_t all = 0, seen = 0;
  for (std::size_t i = 0; i < observed_.size(); ++i) {
    all += counted[i] != 0;
    seen += counted[i] && observed_[i];
  }
  return all == 0 ? 0.0 : double(seen) / double(all);
}

}  // namespace nextview
