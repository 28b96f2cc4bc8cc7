#include "core/evaluation/recorded_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "core/evaluation/coverage.hpp"
#include "core/evaluation/covering_order.hpp"
#include "core/progress/make_ahead.hpp"
#include "core/progress/stopped.hpp"
#include "core/random/counter_random.hpp"

namespace nextview {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::size_t hash = 0;
    for (const std::int64_t c : cell) hash = (hash ^ std::size_t(c)) * 0x9E3779B97F4A7C15u;
    return hash ^ (hash >> 32);
  }
};
using Cells = std::unordered_set<Cell, CellHash>;

/// The points that are the first in their cube of this edge [m]. `taken`: the cubes that have one.
PointCloud first_of_each_cell(const PointCloud& points, double edge, Cells& taken) {
  PointCloud first;
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Array3d at = (p.cast<double>().array() / edge).floor();
    if (taken.insert({std::int64_t(at.x()), std::int64_t(at.y()), std::int64_t(at.z())}).second) first.push_back(p);
  }
  return first;
}

/// The numbers below `count`, `first` before the others.
std::vector<std::size_t> in_order_from(std::size_t first, std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::rotate(order.begin(), order.begin() + std::ptrdiff_t(first), order.begin() + std::ptrdiff_t(first) + 1);
  return order;
}

std::vector<std::uint32_t> observed_by(SurfaceCoverage nothing, const PointCloud& points, const std::stop_token& stop) {
  nothing.add(points, stop);
  std::vector<std::uint32_t> observed;
  for (std::uint32_t s = 0; s < nothing.observed().size(); ++s)
    if (nothing.observed()[s]) observed.push_back(s);
  return observed;
}

}  // namespace

RecordedSurface::RecordedSurface(std::size_t frames, const std::function<PointCloud(std::size_t)>& cloud_of,
                                 double d_reg, const Progress& progress, const std::stop_token& stop)
    : d_reg_(d_reg) {
  std::vector<PointCloud> thinned(frames);
  Cells taken;
  const auto begin = [&](std::size_t frame) {
    if (progress) progress(double(frame) / double(frames), "reading what the frames show");
    throw_if_stopped(stop);
  };
  const auto thin = [&](std::size_t frame) {
    Cells of_frame;
    thinned[frame] = first_of_each_cell(cloud_of(frame), 0.5 * d_reg, of_frame);
  };
  make_ahead(frames, begin, thin, [&](std::size_t frame) {
    const PointCloud added = first_of_each_cell(thinned[frame], 0.5 * d_reg, taken);
    samples_.insert(samples_.end(), added.begin(), added.end());
  });
  if (samples_.empty()) throw std::invalid_argument("no frame has a point");
  const SurfaceCoverage nothing(samples_, d_reg);
  for (const PointCloud& points : thinned) seen_from_.push_back(observed_by(nothing, points, stop));
}

std::vector<std::uint8_t> RecordedSurface::seen(std::span<const std::size_t> frames) const {
  std::vector<std::uint8_t> seen(samples_.size());
  for (const std::size_t frame : frames)
    for (const std::uint32_t s : seen_from_[frame]) seen[s] = 1;
  return seen;
}

std::vector<double> RecordedSurface::coverage(std::span<const std::size_t> order) const {
  std::vector<double> shares;
  std::vector<std::uint8_t> seen(samples_.size());
  std::size_t count = 0;
  for (const std::size_t frame : order) {
    for (const std::uint32_t s : seen_from_[frame]) count += !std::exchange(seen[s], std::uint8_t{1});
    shares.push_back(double(count) / double(samples_.size()));
  }
  return shares;
}

double RecordedSurface::covered_by(std::span<const std::size_t> frames) const {
  const std::scoped_lock lock(memory_);
  const std::size_t before = covered_.frames.size();
  if (before > frames.size() || !std::ranges::equal(covered_.frames, frames.first(before))) covered_ = {};
  covered_.seen.resize(samples_.size());
  for (const std::size_t frame : frames.subspan(covered_.frames.size())) {
    for (const std::uint32_t s : seen_from_[frame]) covered_.count += !std::exchange(covered_.seen[s], std::uint8_t{1});
    covered_.frames.push_back(frame);
  }
  return double(covered_.count) / double(samples_.size());
}

std::vector<double> RecordedSurface::random_coverage(std::size_t first, std::uint64_t seed) const {
  constexpr int runs = 20;
  std::vector<double> mean(frames());
  for (int run = 0; run < runs; ++run) {
    std::vector<std::size_t> order = in_order_from(first, frames());
    const CounterRandom random(seed, random_stream::frame_orders, std::uint32_t(run));
    for (std::size_t i = order.size(); i > 2; --i)  // Fisher-Yates; the first stays
      std::swap(order[i - 1], order[1 + static_cast<std::size_t>(random.uniform(i)[0] * double(i - 1))]);
    const std::vector<double> shares = coverage(order);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += shares[k] / runs;
  }
  return mean;
}

CoverageByOrder RecordedSurface::compare_orders(std::span<const std::size_t> taken, std::uint64_t seed) const {
  const std::size_t first = taken.front();
  const std::scoped_lock lock(memory_);
  if (!others_ || others_->first != first || others_->seed != seed)
    others_ = OtherOrders{first, seed, coverage(in_order_from(first, frames())), random_coverage(first, seed)};
  return {coverage(taken), others_->recorded, others_->random};
}

std::vector<std::size_t> RecordedSurface::covering_order(std::uint64_t seed) const {
  return nextview::covering_order(seen_from_, samples_.size(), seed);
}

}  // namespace nextview
