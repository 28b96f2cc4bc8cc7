// Compiled once for each instruction set (Highway's foreach_target); the processor's best is chosen when it runs.
#include "core/gibbs/front_terms.hpp"

#include <algorithm>
#include <limits>

#include "core/gibbs/optical_depth.hpp"
#include "core/gibbs/weighted_logs.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/gibbs/front_terms.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, FrontTerms::block>;
using Integers = hn::RebindToSigned<Floats>;
using Unsigned = hn::RebindToUnsigned<Floats>;
using Vector = hn::Vec<Floats>;
using IntegerVector = hn::Vec<Integers>;
constexpr Floats floats;
constexpr Integers integers;
constexpr Unsigned whole;

HWY_INLINE Vector number(float x) { return hn::Set(floats, x); }
HWY_INLINE IntegerVector whole_number(std::int32_t x) { return hn::Set(integers, x); }

/// WeightedLogs::log, to the last bit.
HWY_INLINE Vector log(Vector x) {
  constexpr std::uint32_t root_of_half = 0x3f3504f3, mantissa = 0x007fffff;
  const auto bits = hn::Add(hn::BitCast(whole, x), hn::Set(whole, 0x3f800000 - root_of_half));
  const auto exponent = hn::Sub(hn::BitCast(integers, hn::ShiftRight<23>(bits)), whole_number(127));
  const auto m = hn::BitCast(floats, hn::Add(hn::And(bits, hn::Set(whole, mantissa)), hn::Set(whole, root_of_half)));
  const Vector t = hn::Div(hn::Sub(m, number(1.0f)), hn::Add(m, number(1.0f))), squared = hn::Mul(t, t);
  Vector series = number(2.0f / 9.0f);
  for (const float next : {2.0f / 7.0f, 2.0f / 5.0f, 2.0f / 3.0f, 2.0f})
    series = hn::Add(number(next), hn::Mul(squared, series));
  return hn::Add(hn::Mul(hn::ConvertTo(floats, exponent), number(0.693147181f)), hn::Mul(t, series));
}

/// optical_depth::passing, to the last bit.
HWY_INLINE Vector passing(IntegerVector depth) {
  using optical_depth::Tables;
  constexpr int bits = 7;
  static_assert(1 << bits == Tables::size);
  const Tables& tables = optical_depth::tables();
  const IntegerVector most = whole_number(Tables::size - 1);
  const auto factor = [&](const std::array<float, Tables::size>& of, IntegerVector at)
                          HWY_ATTR { return hn::GatherIndex(floats, of.data(), at); };
  const Vector product = hn::Mul(hn::Mul(factor(tables.lower, hn::And(depth, most)),
                                         factor(tables.middle, hn::And(hn::ShiftRight<bits>(depth), most))),
                                 factor(tables.upper, hn::Min(hn::ShiftRight<2 * bits>(depth), most)));
  const auto passes = hn::Lt(depth, whole_number(optical_depth::opaque));
  return hn::IfThenElseZero(hn::RebindMask(floats, passes), product);
}

/// As many entries of a voxel as there are lanes.
struct Some {
  IntegerVector ray, chord;
  hn::Mask<Floats> there;
};
/// The first that are left, of `left`: where there are fewer, those lanes have the first one's ray.
HWY_INLINE Some some(const RayLists::FrontEntry* entries, std::size_t left) {
  static_assert(sizeof(RayLists::FrontEntry) == sizeof(std::uint32_t));
  const auto there = hn::FirstN(whole, left);
  const auto bits = hn::IfThenElse(there, hn::LoadU(whole, &entries->bits), hn::Set(whole, entries->bits));
  return {hn::BitCast(integers, hn::ShiftRight<10>(bits)), hn::BitCast(integers, hn::And(bits, hn::Set(whole, 1023u))),
          hn::RebindMask(floats, there)};
}

/// The parts of pairs of numbers.
struct Both {
  Vector first, second;
};
template <class Pair>
HWY_INLINE Both both(const Pair* pairs, IntegerVector at) {
  static_assert(sizeof(Pair) == sizeof(std::int64_t) && alignof(Pair) == alignof(std::int64_t));
#if HWY_TARGET == HWY_SCALAR
  const float* const begin = reinterpret_cast<const float*>(pairs);
  const IntegerVector twice = hn::Add(at, at);
  return {hn::GatherIndex(floats, begin, twice), hn::GatherIndex(floats, begin + 1, twice)};
#else
  // Fetched together: half as many elements, which is what gathers take time by.
  constexpr hn::Repartition<std::int64_t, Floats> wide;
  const auto* const begin = reinterpret_cast<const std::int64_t*>(pairs);
  const auto fetch = [&](auto half) HWY_ATTR {
    return hn::BitCast(floats, hn::GatherIndex(wide, begin, hn::PromoteTo(wide, half)));
  };
  const Vector lower = fetch(hn::LowerHalf(at)), upper = fetch(hn::UpperHalf(hn::Half<Integers>(), at));
  return {hn::ConcatEven(floats, upper, lower), hn::ConcatOdd(floats, upper, lower)};
#endif
}

/// s of rays if the voxel, which is not free, were.
HWY_INLINE Vector s_if_free(const FrontTerms& terms, const Some& of) {
  const Both survival = both(terms.survivals, of.ray);
  const IntegerVector depth = hn::BitCast(integers, survival.second);
  return hn::Mul(survival.first, passing(hn::Sub(depth, hn::GatherIndex(integers, terms.own_depth->data(), of.chord))));
}

/// Both halves of what there is added up, and again until one is left: in the same order whatever the lanes.
template <class Lanes>
HWY_INLINE float sum_of(Lanes, hn::Vec<Lanes> v) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(Lanes()) > 1) {
    constexpr hn::Half<Lanes> half;
    return sum_of(half, hn::Add(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
  }
#endif
  return hn::GetLane(v);
}
constexpr std::size_t lanes = hn::MaxLanes(floats), parts = FrontTerms::block / lanes;
HWY_INLINE float sum_of(Vector (&block)[parts]) {
  for (std::size_t half = parts / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i) block[i] = hn::Add(block[i], block[i + half]);
  return sum_of(floats, block[0]);
}

template <bool is_free>
bool add_terms(const FrontTerms& terms, double enough, std::span<double> log_weights) {
  const std::size_t count = terms.entries.size(), levels = log_weights.size();
  Vector logs[ForwardSensorModel::max_attenuations][parts];
  for (std::size_t begin = 0; begin < count; begin += FrontTerms::block) {
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t left = count - std::min(count, begin + part * lanes);
      if (left == 0) {
        for (std::size_t q = 0; q < levels; ++q) logs[q][part] = hn::Zero(floats);
        continue;
      }
      const Some of = some(terms.entries.data() + (count - left), left);
      const Both ray = both(terms.rays, of.ray);
      const Vector s = is_free ? ray.first : s_if_free(terms, of), below = hn::Add(number(1.0f), s);
      const Vector evidence = hn::IfThenElseZero(of.there, ray.second);
      const auto set = [&](std::size_t q, Vector passes) HWY_ATTR {
        logs[q][part] = hn::Mul(evidence, log(hn::Div(hn::Add(number(1.0f), hn::Mul(s, passes)), below)));
      };
      for (std::size_t q = 0; q < levels; q += 2) {
        const Both passes = both(terms.passing[q / 2].data(), of.chord);
        set(q, passes.first);
        if (q + 1 < levels) set(q + 1, passes.second);
      }
    }
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t q = 0; q < levels; ++q) largest = std::max(largest, log_weights[q] += sum_of(logs[q]));
    if (largest < enough) return true;
  }
  return false;
}

bool add_all_terms(const FrontTerms& terms, double enough, std::span<double> log_weights) {
  return terms.own_depth ? add_terms<false>(terms, enough, log_weights) : add_terms<true>(terms, enough, log_weights);
}

}  // namespace nextview::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nextview {
namespace {

HWY_EXPORT(add_all_terms);

}  // namespace

bool add_front_terms(const FrontTerms& terms, double enough, std::span<double> log_weights) {
  // A voxel of one level lets nothing pass, or little: the first ray's word is often enough.
  if (log_weights.size() == 1 && !terms.own_depth && !terms.entries.empty()) {
    const RayLists::FrontEntry first = terms.entries.front();
    const RayWitness& ray = terms.rays[first.ray()];
    const float factor = (1.0f + ray.s * terms.passing[0][first.chord()][0]) / (1.0f + ray.s);
    const double weight = log_weights[0] + ray.evidence * WeightedLogs::log(factor);
    if (weight < enough) {
      log_weights[0] = weight;
      return true;
    }
  }
  return HWY_DYNAMIC_DISPATCH(add_all_terms)(terms, enough, log_weights);
}

}  // namespace nextview
#endif
