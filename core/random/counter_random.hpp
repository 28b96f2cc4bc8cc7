#pragma once
#include <array>
#include <cstdint>

namespace nextview {

/// Random numbers that depend on a key and a counter alone (Philox 4x32-10, Salmon et al. 2011), never on who drew
/// before: draw per pixel, per voxel or per sweep and the result is the same on any number of threads.
class CounterRandom {
 public:
  /// `stream` separates uses of one seed (sensor noise, random planner, …); `index` is for example the view number.
  CounterRandom(std::uint64_t seed, std::uint32_t stream, std::uint32_t index = 0)
      : seed_(seed), stream_(stream), index_(index) {}

  /// Four independent uniform numbers in (0, 1) for this counter.
  std::array<double, 4> uniform(std::uint64_t counter) const;

  /// Two independent standard normal numbers for this counter (Box-Muller).
  std::array<double, 2> normal(std::uint64_t counter) const;

 private:
  std::uint64_t seed_;
  std::uint32_t stream_;
  std::uint32_t index_;
};

/// The streams in use. One list, so that no two uses share one.
namespace random_stream {
inline constexpr std::uint32_t range_noise = 1;
inline constexpr std::uint32_t dropout = 2;
inline constexpr std::uint32_t surface_samples = 3;
inline constexpr std::uint32_t random_planner = 4;
inline constexpr std::uint32_t covering_order = 5;
inline constexpr std::uint32_t outliers = 6;
inline constexpr std::uint32_t training_parts = 7;
inline constexpr std::uint32_t training_views = 8;
inline constexpr std::uint32_t adaptive_views = 9;
inline constexpr std::uint32_t any_pose = 10;
inline constexpr std::uint32_t drawn_worlds = 11;
inline constexpr std::uint32_t frame_orders = 12;
inline constexpr std::uint32_t pose_errors = 13;
inline constexpr std::uint32_t gibbs = 1024;  ///< and on: chains and moves have streams of their own
}  // namespace random_stream

}  // namespace nextview
