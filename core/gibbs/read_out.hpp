#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/gibbs/posterior_sampler.hpp"
#include "core/gibbs/ray_lists.hpp"

/// From what the sampler draws to what people ask. Its levels say how many rays a voxel stops. Whether the surface
/// touches the voxel, and whether the voxel's centre is inside, are other questions: a voxel that the surface cuts by a
/// corner stops hardly a ray, and rays end just beside a surface by noise. What the levels of a voxel and of those
/// around it say of both was learned from made-up parts, whose surface is known.
namespace nextview {

/// The measured rays of a voxel; merged rays count as many as they stand for.
struct RayCount {
  float passed = 0.0f;  ///< whose range lies behind the voxel
  float ended = 0.0f;   ///< whose range lies in it
  float near = 0.0f;    ///< that end in it, or at most `reach` before or behind their way through it
  float behind = 0.0f;  ///< how far behind its centre those end, on average [voxel edges]; less than 0: in front
  float crossed() const { return passed + ended; }

  static constexpr float reach = 0.8f;  ///< [voxel edges]
};
/// One a voxel of the lists' grid.
std::vector<RayCount> ray_counts(const RayLists& lists);

/// What the read-out looks at: the posterior and the rays of a voxel, and those of the voxels around it.
class ReadOutFeatures {
 public:
  static constexpr std::size_t count = 27;
  using Vector = std::array<float, count>;

  /// Of GibbsPosterior::occupied, ::upper and ::informed.
  ReadOutFeatures(const GibbsPosterior& posterior, std::span<const RayCount> rays);
  /// Voxels beyond the grid are taken for free ones that rays pass.
  Vector of(std::uint32_t voxel) const;
  /// From here on features are of the rays alone, whatever the sampler makes of them; the first is 1.
  static constexpr std::size_t first_of_rays = 10;
  /// Whether one ended in the voxel or in those around it, or within RayCount::reach.
  static bool a_ray_ended_near(const Vector& features) {
    return features[17] > 0.0f || features[18] > 0.0f || features[20] > 0.0f;
  }

 private:
  /// What a voxel says to those around it. Ready made, as each has 26 that ask.
  struct Word {
    float uninformed = 0.0f;                     ///< 1: it is
    float occupied = 0.0f, upper = 0.0f;         ///< 0 if not informed
    float log_odds = 0.0f;                       ///< of being occupied; 0 if not informed
    float uncrossed = 0.0f;                      ///< 1: no measured ray crosses it
    float passed = 0.0f;                         ///< 1: rays do, and none ends near
    float ended = 0.0f;                          ///< share of its rays that end in it
    float log_ended = 0.0f, log_crossed = 0.0f;  ///< log(1 + rays)
    float near = 0.0f;                           ///< 1: any ends near it
    float behind = 0.0f;                         ///< RayCount's

    Word& operator+=(const Word& other) {
      uninformed += other.uninformed;
      occupied += other.occupied;
      upper += other.upper;
      log_odds += other.log_odds;
      uncrossed += other.uncrossed;
      passed += other.passed;
      ended += other.ended;
      log_ended += other.log_ended;
      log_crossed += other.log_crossed;
      near += other.near;
      behind += other.behind;
      return *this;
    }
  };
  /// Sums over the voxels that share a face with one, and over all 26.
  struct Around {
    Word faces, all;
  };
  Around around(std::uint32_t voxel) const;

  VoxelGrid grid_;
  std::span<const float> upper_;    ///< of the posterior, which must outlive it
  std::span<const RayCount> rays_;  ///< likewise
  std::vector<Word> words_;
};

/// One of the questions' answer: log-odds = linear . x + sum over the units of out s(in . x), s(a) = a / (1 + |a|). A
/// logistic regression, bent where features have a say only together.
struct ReadOutNetwork {
  static constexpr std::size_t units = 16;
  using OfUnits = std::array<float, units>;

  ReadOutFeatures::Vector linear{};
  OfUnits out{};
  std::array<OfUnits, ReadOutFeatures::count> in{};  ///< by feature

  float log_odds(const ReadOutFeatures::Vector& features) const;
};
struct ReadOutWeights {
  ReadOutNetwork touch, centre;
};
/// Fitted to made-up parts by tests/benchmarks/posterior_comparison --fit; nothing else was looked at.
const ReadOutWeights& fitted_read_out();

/// Fills in GibbsPosterior::touch and ::centre: 0.5 where not informed. The same bytes on any number of threads.
void read_out(GibbsPosterior& posterior, std::span<const RayCount> rays, const ReadOutWeights& weights);

}  // namespace nextview
