// Compiled once for each instruction set (Highway's foreach_target); the processor's best is chosen when it runs.
#include "core/gain/ray_lanes.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/gain/ray_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/gain/ray_follower-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace nextview::HWY_NAMESPACE {
HWY_INLINE Mask where(hn::Mask<Integers> mask) {
  return mask_of(hn::BitCast(integers, hn::VecFromMask(integers, mask)));
}

/// What rays find in the voxels that they are in.
struct Found {
  Vector worth, passes;
  Mask inside, ends;  ///< whether the voxels are the grid's; whether rays go no farther
};

/// What voxels have that are kept as numbers of states: twice the number, and 1 where a ray goes no farther.
template <class States>
HWY_INLINE IntegerVector states_at(const States& states, IntegerVector place) {
  using State = typename States::value_type;
  constexpr std::int64_t bits = (std::int64_t{1} << (8 * sizeof(State))) - 1;
  const auto* const begin = reinterpret_cast<const std::int64_t*>(states.data());
  const IntegerVector offset = hn::ShiftLeft<sizeof(State) / 2>(place);
  return hn::And(hn::GatherOffset(integers, begin, offset), hn::Set(integers, bits));
}

HWY_INLINE Found found_in(IntegerVector state, Vector worth, Vector passes) {
  const IntegerVector one = hn::Set(integers, std::int64_t{1});
  return {worth, passes, where(hn::Ne(state, hn::Set(integers, std::int64_t{StateField::outside}))),
          where(hn::Eq(hn::And(state, one), one))};
}

template <class States>
HWY_INLINE Found look_up(const StateField& field, const States& states, IntegerVector place) {
  const IntegerVector state = states_at(states, place), number = hn::ShiftRight<1>(state);
  return found_in(state, hn::GatherIndex(doubles, field.worth.data(), number),
                  hn::GatherIndex(doubles, field.passes.data(), number));
}

#if HWY_TARGET <= HWY_AVX3
/// The same of so few states that registers hold them all: a gather takes longer than two permutations of sixteen.
class FewStates {
 public:
  static constexpr std::size_t most = 4 * most_lanes;
  explicit FewStates(const StateField& field) {
    HWY_ALIGN double padded[2][most] = {};
    std::ranges::copy(field.worth, padded[0]);
    std::ranges::copy(field.passes, padded[1]);
    for (std::size_t i = 0; i < 4; ++i) {
      worth_[i] = hn::Load(doubles, padded[0] + i * most_lanes);
      passes_[i] = hn::Load(doubles, padded[1] + i * most_lanes);
    }
  }

  HWY_INLINE Found operator()(const StateField& field, IntegerVector place) const {
    const IntegerVector state = states_at(field.bytes, place), number = hn::ShiftRight<1>(state);
    const Mask upper = hn::RebindMask(doubles, hn::TestBit(number, hn::Set(integers, std::int64_t{2 * most_lanes})));
    const auto pick_from = [&](const Vector(&of)[4]) HWY_ATTR {
      // Highway 1.0 has no permutation of two registers; this one heeds an index's lowest four bits.
      const auto at = [&](int i)
                          HWY_ATTR { return Vector{_mm512_permutex2var_pd(of[i].raw, number.raw, of[i + 1].raw)}; };
      return hn::IfThenElse(upper, at(2), at(0));
    };
    return found_in(state, pick_from(worth_), pick_from(passes_));
  }

 private:
  Vector worth_[4], passes_[4];
};
#endif

/// Of voxels that are all different.
HWY_INLINE Found look_up(const StateField& field, IntegerVector place) {
  const Vector passes = hn::GatherIndex(doubles, field.passes.data(), place), size = hn::Abs(passes);
  return {hn::GatherIndex(doubles, field.worth.data(), place), size, hn::Le(size, hn::Set(doubles, 1.0)),
          where(hn::Lt(hn::BitCast(integers, passes), hn::Zero(integers)))};
}

/// `LookUp(field, place)` is one of these.
template <class LookUp>
struct States {
  const StateField& field;
  LookUp look_up;
  std::span<double> sums;
  std::size_t looked_at = 0;

  HWY_INLINE Mask visit(Walk& w, std::size_t, Vector) {
    const Found found = look_up(field, w.place);
    w.sum = hn::Add(w.sum, hn::Mul(w.left, found.worth));
    w.left = hn::Mul(w.left, found.passes);
    looked_at += hn::CountTrue(doubles, hn::And(found.inside, w.live));
    // What is less than half of the sum's last place is lost when it is added.
    const Mask lost =
        hn::Lt(hn::Mul(w.left, hn::Set(doubles, field.most_worth)), hn::Mul(w.sum, hn::Set(doubles, 0x1p-54)));
    return hn::Or(lost, found.ends);
  }
  void ended(std::size_t, std::size_t ray, double sum) { sums[ray] = sum; }
};

template <class LookUp>
std::size_t sum_by(const RaysThroughGrid& rays, const StateField& field, std::span<double> sums, LookUp look_up) {
  States<LookUp> states{field, look_up, sums};
  Follower<States<LookUp>>(rays, states).run();
  return states.looked_at;
}

std::size_t sum_states(const RaysThroughGrid& rays, const StateField& field, std::span<double> sums) {
#if HWY_TARGET <= HWY_AVX3
  if (!field.bytes.empty() && field.worth.size() <= FewStates::most) return sum_by(rays, field, sums, FewStates(field));
#endif
  if (!field.bytes.empty())
    return sum_by(rays, field, sums, [](const StateField& f, IntegerVector at) { return look_up(f, f.bytes, at); });
  if (!field.shorts.empty())
    return sum_by(rays, field, sums, [](const StateField& f, IntegerVector at) { return look_up(f, f.shorts, at); });
  return sum_by(rays, field, sums, [](const StateField& f, IntegerVector at) { return look_up(f, at); });
}

struct Chances {
  const ChanceField& field;
  Finds& finds;
  std::size_t longest;  ///< voxels that a ray may visit
  std::vector<Finds::Find> of_lane = {};
  std::array<std::size_t, rows * most_lanes> count{};

  HWY_INLINE Mask visit(Walk& w, std::size_t row, Vector to) {
    const hn::Rebind<float, Doubles> floats;
    const hn::Rebind<std::int32_t, Doubles> indices;
    const auto narrow =
        hn::TruncateTo(hn::Rebind<std::uint32_t, Doubles>(), hn::BitCast(hn::RebindToUnsigned<Doubles>(), w.place));
    const Vector chance =
        hn::PromoteTo(doubles, hn::GatherIndex(floats, field.chances.data(), hn::BitCast(indices, narrow)));
    const Mask outside = hn::Gt(chance, hn::Set(doubles, 1.5));
    // A ray that hardly moves along an axis may be a rounding beyond its face there, and meet it long ago.
    const Vector exit = hn::Max(to, w.enter);
    const Vector range = hn::Mul(hn::Set(doubles, 0.5), hn::Add(w.enter, exit));
    const Vector found = hn::IfThenZeroElse(outside, hn::Mul(w.left, hn::Abs(chance)));
    note(hn::Gt(found, hn::Zero(doubles)), w.place, hn::Mul(hn::Mul(found, range), range), row);
    w.left = hn::Sub(w.left, found);
    w.enter = exit;
    const Mask negligible = hn::Le(w.left, hn::Set(doubles, field.negligible));
    return hn::Or(hn::Or(outside, negligible), hn::Lt(chance, hn::Zero(doubles)));
  }
  HWY_INLINE void note(Mask found, IntegerVector place, Vector area, std::size_t row) {
    unsigned bits = bits_of(found);
    if (bits == 0) return;
    HWY_ALIGN std::int64_t places[most_lanes];
    HWY_ALIGN double areas[most_lanes];
    hn::Store(place, integers, places);
    hn::Store(area, doubles, areas);
    for (; bits != 0; bits &= bits - 1) {
      const std::size_t lane = std::countr_zero(bits), at = row * most_lanes + lane;
      of_lane[at * longest + count[at]++] = {static_cast<std::uint32_t>(places[lane]), areas[lane]};
    }
  }
  void ended(std::size_t lane, std::size_t ray, double) {
    const auto begin = of_lane.begin() + std::ptrdiff_t(lane * longest);
    finds.begins[ray] = finds.finds.size();
    finds.finds.insert(finds.finds.end(), begin, begin + std::ptrdiff_t(count[lane]));
    finds.ends[ray] = finds.finds.size();
    count[lane] = 0;
  }
};

void find_chances(const RaysThroughGrid& rays, const ChanceField& field, Finds& finds) {
  Chances chances{field, finds, std::size_t(rays.grid.size.sum()) + 3};
  chances.of_lane.resize(rows * most_lanes * chances.longest);
  Follower<Chances>(rays, chances).run();
}

}  // namespace nextview::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nextview {
namespace {

HWY_EXPORT(sum_states);
HWY_EXPORT(find_chances);

}  // namespace

std::size_t sum_along_rays(const RaysThroughGrid& rays, const StateField& field, std::span<double> sums) {
  std::ranges::fill(sums, 0.0);
  return rays.grid.voxel_count() == 0 ? 0 : HWY_DYNAMIC_DISPATCH(sum_states)(rays, field, sums);
}

Finds find_along_rays(const RaysThroughGrid& rays, const ChanceField& field) {
  Finds finds;
  finds.begins.assign(rays.directions.size(), 0);
  finds.ends.assign(rays.directions.size(), 0);
  if (rays.grid.voxel_count() > 0) HWY_DYNAMIC_DISPATCH(find_chances)(rays, field, finds);
  return finds;
}

}  // namespace nextview
#endif
