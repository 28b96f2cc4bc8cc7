#pragma once
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/cloud/point_cloud.hpp"
#include "core/progress/progress.hpp"

namespace nextview {

/// How much of what a recording shows was seen after each view, by three orders that begin with the same frame.
struct CoverageByOrder {
  std::vector<double> planned;   ///< that of the views taken
  std::vector<double> recorded;  ///< that in which it was recorded
  std::vector<double> random;    ///< mean of 20 random ones
};

/// What all frames of a recording show together: where no mesh is known, the final cloud is what coverage is a share
/// of. What it says never changes; two answers that are asked for again and again are remembered.
class RecordedSurface {
 public:
  /// `cloud_of` gives the cleaned points of a frame [m, world]; each is asked for once, several at a time by different
  /// threads. Samples are the final cloud with one point per cube of half of `d_reg` [m]; a frame shows those that have
  /// a point of its own, thinned likewise, within d_reg.
  /// @throws std::invalid_argument if there are no points at all, and what cloud_of throws; Stopped
  RecordedSurface(std::size_t frames, const std::function<PointCloud(std::size_t)>& cloud_of, double d_reg,
                  const Progress& progress = {}, const std::stop_token& stop = {});

  std::size_t frames() const { return seen_from_.size(); }
  const PointCloud& samples() const { return samples_; }
  double d_reg() const { return d_reg_; }
  /// Which samples a frame shows, in ascending order.
  std::span<const std::uint32_t> seen_from(std::size_t frame) const { return seen_from_[frame]; }
  std::size_t visible_samples() const { return samples_.size(); }  ///< some frame shows each
  /// One per sample, 1: one of these frames shows it.
  std::vector<std::uint8_t> seen(std::span<const std::size_t> frames) const;

  /// Share of the samples that are seen after the first, the second, … of these frames.
  std::vector<double> coverage(std::span<const std::size_t> order) const;
  /// The same after the last of them. Where they begin with those that were asked for last, only the others are gone
  /// through. From any thread.
  double covered_by(std::span<const std::size_t> frames) const;
  /// The frames taken beside the orders that were not: theirs are of all frames, and found once while a scan goes on.
  /// From any thread. @pre !taken.empty()
  CoverageByOrder compare_orders(std::span<const std::size_t> taken, std::uint64_t seed) const;
  /// Frames in the order of a greedy set cover, shuffled by the seed (covering_order).
  std::vector<std::size_t> covering_order(std::uint64_t seed) const;

 private:
  /// Coverage by orders of all frames.
  struct OtherOrders {
    std::size_t first;
    std::uint64_t seed;
    std::vector<double> recorded, random;
  };
  /// What these frames show together.
  struct Covered {
    std::vector<std::size_t> frames;
    std::vector<std::uint8_t> seen;  ///< by sample
    std::size_t count = 0;           ///< of those
  };
  std::vector<double> random_coverage(std::size_t first, std::uint64_t seed) const;

  double d_reg_;
  PointCloud samples_;
  std::vector<std::vector<std::uint32_t>> seen_from_;
  mutable std::mutex memory_;  ///< of the two answers below, those that were asked for last
  mutable Covered covered_;
  mutable std::optional<OtherOrders> others_;
};

}  // namespace nextview
