#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/gibbs/gibbs_posterior.hpp"
#include "core/gibbs/ray_lists.hpp"
#include "core/gibbs/surface_patch.hpp"

/// From what the sampler draws to what people ask. Its levels say how many rays a voxel stops. Whether the surface
/// touches the voxel, and whether the voxel's centre is inside, are other questions: a voxel that the surface cuts by a
/// corner stops hardly a ray, and rays end just beside a surface by noise. What the levels of a voxel and of those
/// around it, and the planes through where rays end, say of both was learned from made-up parts, whose surface is
/// known.
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
/// What the measured rays say, whatever the sampler makes of them.
struct ReadOutRays {
  std::vector<RayCount> counts;  ///< one a voxel of the lists' grid
  RayEnds ends;
  std::optional<BitRows> counted = {};  ///< the voxels that counts are of, those of others are 0; none: of all
};
ReadOutRays read_out_rays(const RayLists& lists, std::optional<BitRows> counted = {});

/// What the read-out looks at: the posterior and the rays of a voxel, those of the voxels around it, and the planes
/// through where rays end there (SurfacePatch).
class ReadOutFeatures {
 public:
  static constexpr std::size_t count = 41;
  using Vector = std::array<float, count>;

  /// Layers of voxels along z.
  struct Layers {
    int first, last;  ///< the second is not among them
  };
  /// Of GibbsPosterior::occupied, ::upper and ::informed, which must outlive it as the rays must. `layers`: of() is
  /// asked for no others; it holds what it needs of them and of the two beside, as far as rays are counted there.
  ReadOutFeatures(const GibbsPosterior& posterior, const ReadOutRays& rays, const Layers& layers);
  ReadOutFeatures(const GibbsPosterior& posterior, const ReadOutRays& rays)
      : ReadOutFeatures(posterior, rays, {0, posterior.grid.size.z()}) {}
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
  enum Said {
    uninformed,         ///< 1: it is
    occupied,           ///< 0 if not informed; so is the next, and their log-odds
    upper,              ///< the uppermost level
    log_odds_occupied,  ///< of being occupied
    uncrossed,          ///< 1: no measured ray crosses it
    passed,             ///< 1: rays do, and none ends near
    ended,              ///< share of its rays that end in it
    log_ended,          ///< log(1 + rays that do)
    log_crossed,        ///< log(1 + rays that cross it)
    near,               ///< 1: any ends near it
    behind,             ///< RayCount's
    unused,             ///< registers hold four
    said
  };
  using Word = Eigen::Array<float, said, 1>;
  /// Sums over the voxels that share a face with one, and over all 26.
  struct Around {
    Word faces = Word::Zero(), all = Word::Zero();
  };
  Word word_of(std::uint32_t voxel) const;
  Around around(std::uint32_t voxel) const;
  const Word& said_by(std::uint32_t voxel) const { return words_[voxel - first_word_]; }

  const GibbsPosterior& posterior_;
  const ReadOutRays& rays_;
  std::size_t first_word_;  ///< the voxel that it is of
  std::vector<Word> words_;
};

/// One of the questions' answer: log-odds = linear . x + sum over the units of out s(in . x), s(a) = a / (1 + |a|). A
/// logistic regression, bent where features have a say only together.
struct ReadOutNetwork {
  static constexpr std::size_t units = 32;
  using OfUnits = std::array<float, units>;

  ReadOutFeatures::Vector linear{};
  OfUnits out{};
  std::array<OfUnits, ReadOutFeatures::count> in{};  ///< by feature

  float log_odds(const ReadOutFeatures::Vector& features) const;
};
struct ReadOutWeights {
  ReadOutNetwork touch, centre;
};
/// Fitted to made-up parts by tests/benchmarks/posterior_comparison --fit read-outs; nothing else was looked at.
const ReadOutWeights& fitted_read_out();

/// Fills in GibbsPosterior::touch and ::centre: 0.5 where not informed. `asked`: of those voxels alone, of which `rays`
/// need their neighbours' counts, too; the others stay as they are. The same bytes on any number of threads.
void read_out(GibbsPosterior& posterior, const ReadOutRays& rays, const ReadOutWeights& weights,
              const BitRows* asked = nullptr);

}  // namespace nextview
