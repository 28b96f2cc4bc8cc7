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
    : d_reg_(d_reg), visible_(visible.begin(), visible.end()), observed_(samples.size(), 0) {
  if (samples.empty()) throw std::invalid_argument("coverage: there are no surface samples");
  if (visible.size() != samples.size())
    throw std::invalid_argument(
        fmt::format("coverage: {} samples, but visibility for {}", samples.size(), visible.size()));
  if (!(d_reg > 0.0 && std::isfinite(d_reg)))
    throw std::invalid_argument(fmt::format("coverage: d_reg must be over 0 m, not {}", d_reg));

  Eigen::AlignedBox3f box;
  for (const auto& sample : samples) box.extend(sample);
  lower_ = box.min().cast<double>();
  const Vector3 extent = box.max().cast<double>() - lower_;
  edge_ = std::max(d_reg, extent.maxCoeff() / cells_along_longest_side);
  size_ = (extent / edge_).array().floor().matrix().cast<int>() + Eigen::Vector3i::Ones();

  cell_begin_.assign(std::size_t(size_.x()) * size_.y() * size_.z() + 1, 0);
  const auto cell_of = [&](const Eigen::Vector3f& p) { return cell_index(cell_at(p.cast<double>())); };
  for (const auto& sample : samples) ++cell_begin_[cell_of(sample)];
  std::exclusive_scan(cell_begin_.begin(), cell_begin_.end(), cell_begin_.begin(), 0u);
  std::vector<std::uint32_t> next = cell_begin_;
  samples_.resize(samples.size());
  for (std::uint32_t i = 0; i < samples.size(); ++i) samples_[next[cell_of(samples[i])]++] = {samples[i], i};
}

/// Limited to the grid and one cell around it, so that any coordinate fits an int.
Eigen::Vector3i SurfaceCoverage::cell_at(const Vector3& point) const {
  const Vector3 position = (point - lower_) / edge_;
  return position.cwiseMax(-1.0).cwiseMin(size_.cast<double>()).array().floor().matrix().cast<int>();
}

void SurfaceCoverage::observe_around(const Eigen::Vector3f& point) {
  const Vector3 p = point.cast<double>();
  const Eigen::Vector3i first = cell_at(p - Vector3::Constant(d_reg_)).cwiseMax(0);
  const Eigen::Vector3i last = cell_at(p + Vector3::Constant(d_reg_)).cwiseMin(size_ - Eigen::Vector3i::Ones());
  if (first.x() > last.x()) return;
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y) {
      const std::uint32_t end = cell_begin_[cell_index({last.x(), y, z}) + 1];
      for (std::uint32_t i = cell_begin_[cell_index({first.x(), y, z})]; i < end; ++i) {
        if ((samples_[i].point.cast<double>() - p).squaredNorm() > d_reg_ * d_reg_) continue;
        // Other threads may observe the same sample; they all write the same.
        std::atomic_ref(observed_[samples_[i].index]).store(1, std::memory_order_relaxed);
      }
    }
}

void SurfaceCoverage::add(const PointCloud& points, const std::stop_token& stop) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end() && !stop.stop_requested(); ++i) observe_around(points[i]);
  });
  throw_if_stopped(stop);
}

void SurfaceCoverage::go_back(std::span<const std::uint8_t> observed) {
  std::copy(observed.begin(), observed.end(), observed_.begin());
}

double SurfaceCoverage::of_all() const {  // Eq. 17
  return double(std::count(observed_.begin(), observed_.end(), 1)) / double(observed_.size());
}

double SurfaceCoverage::of_visible() const {  // Eq. 17 over the visible samples
  std::size_t visible = 0, seen = 0;
  for (std::size_t i = 0; i < observed_.size(); ++i) {
    visible += visible_[i] != 0;
    seen += visible_[i] && observed_[i];
  }
  return visible == 0 ? 0.0 : double(seen) / double(visible);
}

}  // namespace nextview
