// Compiled once for each instruction set (Highway's foreach_target); the processor's best is chosen when it runs.
#include <numeric>

#include "core/gibbs/read_out.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/gibbs/read_out_network.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

float answer_of(const ReadOutNetwork& network, const ReadOutFeatures::Vector& features) {
  using Floats = hn::CappedTag<float, 16>;
  constexpr Floats floats;
  constexpr std::size_t lanes = hn::MaxLanes(floats), parts = ReadOutNetwork::units / lanes;
  hn::Vec<Floats> sums[parts];
  for (auto& sum : sums) sum = hn::Zero(floats);
  float straight = 0.0f;
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (features[k] == 0.0f) continue;  // in the open, where most voxels are, most are so
    straight += features[k] * network.linear[k];
    const auto feature = hn::Set(floats, features[k]);
    for (std::size_t p = 0; p < parts; ++p)
      sums[p] = hn::Add(sums[p], hn::Mul(feature, hn::LoadU(floats, &network.in[k][p * lanes])));
  }
  ReadOutNetwork::OfUnits bent;
  for (std::size_t p = 0; p < parts; ++p) {
    const auto weighted = hn::Mul(hn::LoadU(floats, &network.out[p * lanes]), sums[p]);
    hn::StoreU(hn::Div(weighted, hn::Add(hn::Set(floats, 1.0f), hn::Abs(sums[p]))), floats, &bent[p * lanes]);
  }
  return std::accumulate(bent.begin(), bent.end(), straight);
}

}  // namespace nextview::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nextview {
namespace {

HWY_EXPORT(answer_of);

}  // namespace

float ReadOutNetwork::log_odds(const ReadOutFeatures::Vector& features) const {
  return HWY_DYNAMIC_DISPATCH(answer_of)(*this, features);
}

}  // namespace nextview
#endif
