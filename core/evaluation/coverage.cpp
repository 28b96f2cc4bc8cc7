#include "core/evaluation/coverage.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>

#include "core/progress/stopped.hpp"

namespace nextview {

constexpr double cells_along_longest_side = 128.0;  // about as many cells as samples on a surface, and 8 MB at most

SurfaceCoverage::SurfaceCoverage(std::span<const Eigen::Vector3f> samples, std::span<const std::uint8_t> visible,
                                 double d_reg)
    : cells_(make_cells(samples, visible, d_reg)), observed_(samples.size(), 0) {}

std::shared_ptr<const SurfaceCoverage::Cells> SurfaceCoverage::make_cells(std::span<const Eigen::Vector3f> samples,
                                                                          std::span<const std::uint8_t> visible,
                                                                          double d_reg) {
  if (samples.empty()) throw std::invalid_argument("coverage: there are no surface samples");
  if (visible.size() != samples.size())
    throw std::invalid_argument(
        fmt::format("coverage: {} samples, but visibility for {}", samples.size(), visible.size()));
  if (!(d_reg > 0.0 && std::isfinite(d_reg)))
    throw std::invalid_argument(fmt::format("coverage: d_reg must be over 0 m, not {}", d_reg));

  Eigen::AlignedBox3f box;
  for (const auto& sample : samples) box.extend(sample);
  auto cells = std::make_shared<Cells>();
  cells->d_reg = d_reg;
  cells->visible.assign(visible.begin(), visible.end());
  cells->lower = box.min().cast<double>();
  const Vector3 extent = box.max().cast<double>() - cells->lower;
  cells->edge = std::max(d_reg, extent.maxCoeff() / cells_along_longest_side);
  cells->size = (extent / cells->edge).array().floor().matrix().cast<int>() + Eigen::Vector3i::Ones();

  std::vector<std::uint32_t>& begin = cells->begin;
  begin.assign(std::size_t(cells->size.x()) * cells->size.y() * cells->size.z() + 1, 0);
  const auto cell_of = [&](const Eigen::Vector3f& p) { return cells->index(cells->at(p.cast<double>())); };
  for (const auto& sample : samples) ++begin[cell_of(sample)];
  std::exclusive_scan(begin.begin(), begin.end(), begin.begin(), 0u);
  std::vector<std::uint32_t> next = begin;
  cells->samples.resize(samples.size());
  for (std::uint32_t i = 0; i < samples.size(); ++i) cells->samples[next[cell_of(samples[i])]++] = {samples[i], i};
  return cells;
}

/// Limited to the grid and one cell around it, so that any coordinate fits an int.
Eigen::Vector3i SurfaceCoverage::Cells::at(const Vector3& point) const {
  const Vector3 position = (point - lower) / edge;
  return position.cwiseMax(-1.0).cwiseMin(size.cast<double>()).array().floor().matrix().cast<int>();
}

void SurfaceCoverage::observe_around(const Eigen::Vector3f& point) {
  const Cells& c = *cells_;
  const Vector3 p = point.cast<double>();
  const Eigen::Vector3i first = c.at(p - Vector3::Constant(c.d_reg)).cwiseMax(0);
  const Eigen::Vector3i last = c.at(p + Vector3::Constant(c.d_reg)).cwiseMin(c.size - Eigen::Vector3i::Ones());
  if (first.x() > last.x()) return;
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y) {
      const std::uint32_t end = c.begin[c.index({last.x(), y, z}) + 1];
      for (std::uint32_t i = c.begin[c.index({first.x(), y, z})]; i < end; ++i) {
        if ((c.samples[i].point.cast<double>() - p).squaredNorm() > c.d_reg * c.d_reg) continue;
        // Other threads may observe the same sample; they all write the same.
        std::atomic_ref(observed_[c.samples[i].index]).store(1, std::memory_order_relaxed);
      }
    }
}

void SurfaceCoverage::add(const PointCloud& points, const std::stop_token& stop) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end() && !stop.stop_requested(); ++i) observe_around(points[i]);
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

double SurfaceCoverage::of_visible() const { return of(cells_->visible); }

double SurfaceCoverage::of(std::span<const std::uint8_t> counted) const {  // Eq. 17 over some samples
  std::size_t all = 0, seen = 0;
  for (std::size_t i = 0; i < observed_.size(); ++i) {
    all += counted[i] != 0;
    seen += counted[i] && observed_[i];
  }
  return all == 0 ? 0.0 : double(seen) / double(all);
}

}  // namespace nextview
