#include "core/gain/new_surface_model.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nextview {
namespace {

template <std::size_t n>
double linear(const std::array<double, n>& coefficients, const std::array<float, n>& features) {
  return std::inner_product(coefficients.begin(), coefficients.end(), features.begin(), 0.0);
}

}  // namespace

NewSurfaceModel NewSurfaceModel::fitted() {
  return {{3.406, -0.837, 1.427, 0.08925, -0.206, -0.3809, -4.256, -6.813, 3.637},
          {-12.15, -0.2211, 2.913, 3.299, 0.05438, 0.3629},
          {-1.628, -0.3099, 0.08016, 0.4418, -0.3264, 1.07},
          1.689,
          {1.831, 0.7768},
          1.6};
}

float NewSurfaceModel::chance_in_block(const SurfaceEvidence& evidence, const Eigen::Vector3i& block) const {
  // A rate times the voxel's share of the object's size.
  return static_cast<float>(-std::expm1(-std::exp(linear(unmeasured, evidence.unmeasured(block))) / evidence.size()));
}

float NewSurfaceModel::chance(const SurfaceEvidence& evidence, const Eigen::Vector3i& cell) const {
  if (!evidence.may_hold_surface(cell)) return 0.0f;
  switch (evidence.kind(cell)) {
    case SurfaceEvidence::Kind::unmeasured:
      return chance_in_block(evidence, evidence.block_of(cell));
    case SurfaceEvidence::Kind::free:
      return static_cast<float>(probability(linear(free, evidence.measured(cell))));
    case SurfaceEvidence::Kind::occupied:  // never 0, whose sign would say nothing
      return -std::max(1e-9f, static_cast<float>(probability(linear(occupied, evidence.measured(cell)))));
  }
  return 0.0f;
}

std::vector<Setting> settings(NewSurfaceModel& m) {
  const auto any = from_to(-1000, 1000);
  const auto setting = [&](const char* key, const char* help, double& value) {
    return Setting{std::string("new_surface.") + key, "", help, &value, any};
  };
  return {
      setting("unmeasured", "ln of the rate at which rays meet surface in unmeasured voxels, per object size",
              m.unmeasured[0]),
      setting("unmeasured_from_occupied", "... times ln(distance to occupied / size)", m.unmeasured[1]),
      setting("unmeasured_from_free", "... times ln(distance to free / size)", m.unmeasured[2]),
      setting("unmeasured_from_free_squared", "... times its square", m.unmeasured[3]),
      setting("unmeasured_not_behind", "... where no surface was seen in front", m.unmeasured[4]),
      setting("unmeasured_behind", "... times ln(distance behind a surface / size)", m.unmeasured[5]),
      setting("unmeasured_root_outside", "... times the root of (distance outside the hull / size)", m.unmeasured[6]),
      setting("unmeasured_outside", "... times (distance outside the hull / size)", m.unmeasured[7]),
      setting("unmeasured_inside", "... times -(distance inside the hull / size)", m.unmeasured[8]),
      setting("free", "log-odds of new surface in a free voxel beside unmeasured or occupied ones", m.free[0]),
      setting("free_log_odds", "... times its log-odds", m.free[1]),
      setting("free_unmeasured", "... times ln(1 + its unmeasured neighbours)", m.free[2]),
      setting("free_beside_occupied", "... with an occupied neighbour", m.free[3]),
      setting("free_occupied", "... times its occupied neighbours", m.free[4]),
      setting("free_border", "... times ln(1 + 4 length of the border beside it where the scanned surface goes on)",
              m.free[5]),
      setting("occupied", "log-odds of new surface in an occupied voxel", m.occupied[0]),
      setting("occupied_log_odds", "... times its log-odds", m.occupied[1]),
      setting("occupied_unmeasured", "... times ln(1 + its unmeasured neighbours)", m.occupied[2]),
      setting("occupied_beside_occupied", "... with an occupied neighbour", m.occupied[3]),
      setting("occupied_occupied", "... times its occupied neighbours", m.occupied[4]),
      setting("occupied_border", "... times ln(1 + 4 length of the border beside it where the scanned surface goes on)",
              m.occupied[5]),
      {"new_surface.slant", "", "area of the surface that rays meet, over the area across them", &m.mean_slant,
       from_to(1, SurfaceSlant::most)},
      {"new_surface.slant_edge_on", "", "... of new surface that is expected with a normal across the ray",
       &m.slant.edge_on, from_to(SurfaceSlant::least, SurfaceSlant::most)},
      {"new_surface.slant_face_on", "", "... of new surface that is expected with a normal along the ray",
       &m.slant.face_on, from_to(SurfaceSlant::least, SurfaceSlant::most)},
      {"new_surface.left_at_border", "",
       "share of the surface that is left, over that of a strip along its border, as wide as points are told apart",
       &m.left_at_border, from_to(0, 1000)},
  };
}

}  // namespace nextview
