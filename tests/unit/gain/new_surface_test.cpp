#include "core/gain/new_surface.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/gain/evidence_maps.hpp"
#include "tests/unit/map/random_scans.hpp"
#include "tests/unit/map/slab_test.hpp"

namespace nextview {
namespace {

using Eigen::Vector3i;
using evidence_maps::MadeMap;

RayBundle small_bundle(int columns = 11, int rows = 8, double field_of_view = 0.6) {
  return RayBundle::regular(PinholeCamera::from_field_of_view(110, 80, field_of_view), columns, rows);
}

/// Neither 0 nor 1 anywhere; other coefficients, other chances.
NewSurfaceModel model_of(double unmeasured, double free, double occupied) {
  NewSurfaceModel model;
  model.unmeasured = {unmeasured, -0.3, 0.2, 0.05, -0.2, 0.0, -1.0, -0.5, 0.7};
  model.free = {free, 0.4, 0.2, 0.5, -0.01};
  model.occupied = {occupied, -0.5, 0.1, 0.2, 0.02};
  return model;
}

std::vector<Pose> views_around(std::mt19937& random, int count, double distance = 0.6) {
  std::vector<Pose> views;  // now and then from inside, or looking away
  for (int n = 0; n < count; ++n) {
    const Vector3 position = (n % 5 == 4 ? 0.05 : distance) * random_scans::direction(random);
    views.push_back(look_at(position, n % 7 == 6 ? Vector3(2 * position) : random_scans::point_in_box(random, 0.05)));
  }
  return views;
}

/// A voxel on a ray, found by the slab test of all voxels.
struct Met {
  std::uint32_t voxel;
  double enter, range;
};
std::vector<Met> met_by(const VoxelGrid& grid, const Vector3& origin, const Vector3& direction, double length) {
  std::vector<Met> met;
  for (std::uint32_t v = 0; v < grid.voxel_count(); ++v) {
    const auto chord = slab_test::overlap(grid, v, 0.0, origin, direction, 100.0);
    if (chord.length() > 1e-12 && chord.enter < length)
      met.push_back({v, chord.enter, 0.5 * (chord.enter + chord.leave)});
  }
  std::sort(met.begin(), met.end(), [](const Met& a, const Met& b) { return a.enter < b.enter; });
  return met;
}

/// As SurfaceSlant has it, where there may be surface.
double slant_of(const NewSurfaceField& field, std::uint32_t voxel, const Vector3& direction,
                const NewSurfaceOptions& options) {
  if (field.at(voxel) == 0.0f) return 0.0;
  const Vector3i cell = field.grid().cell(voxel);
  const double cosine = field.normal(cell.x(), cell.y(), cell.z()).direction().dot(direction);
  return options.slant.edge_on * (1 - cosine * cosine) + options.slant.face_on * cosine * cosine;
}

struct Bounds {
  double value = 0.0, negligible = 0.0;  ///< ... part of it, of rays that hardly get so far
};
Bounds twin_of(const NewSurfaceField& field, const Pose& view, const RayBundle& rays, const NewSurfaceOptions& o) {
  Bounds result;
  for (std::size_t i = 0; i < rays.directions.size(); ++i) {
    double reach = 1.0;
    const Vector3 direction = view.linear() * rays.directions[i];
    for (const Met& met : met_by(field.grid(), view.translation(), direction, o.ray_length)) {
      const double q = std::abs(field.at(met.voxel));
      const double part =
          1e4 * slant_of(field, met.voxel, direction, o) * met.range * met.range * rays.solid_angles[i] * reach * q;
      result.value += part;
      if (reach < 2e-3) result.negligible += part;
      reach *= 1.0 - q;
      if (std::signbit(field.at(met.voxel))) break;
    }
  }
  return result;
}

TEST(NewSurface, AgreesWithTheSlabTestOfAllVoxels) {
  std::mt19937 random(1);
  double most = 0.0;
  for (const double unmeasured : {-3.0, 0.5, 3.0}) {
    const MadeMap made = evidence_maps::random_map(random, {13, 11, 12}, 0.06, 0.5);
    const NewSurfaceField field(made.evidence(), model_of(unmeasured, -3.0, -0.5));
    const std::vector<Pose> views = views_around(random, 10);
    for (const NewSurfaceOptions& options : {NewSurfaceOptions{1.5, {2.5, 1.2}}, NewSurfaceOptions{0.58, {1.0, 1.0}}}) {
      const auto found = expected_new_surface(field, views, small_bundle(), options);
      ASSERT_EQ(found.size(), views.size());
      for (std::size_t v = 0; v < views.size(); ++v) {
        const Bounds expected = twin_of(field, views[v], small_bundle(), options);
        EXPECT_LE(found[v], expected.value * (1 + 1e-7) + 1e-12) << v;
        EXPECT_GE(found[v], expected.value * (1 - 1e-7) - expected.negligible - 1e-12) << v;
        EXPECT_LE(expected.negligible, 0.05 * expected.value) << "too little is told";
        most = std::max(most, found[v]);
      }
    }
  }
  EXPECT_GT(most, 1.0);
}

// Worlds are drawn in which each voxel holds new surface or not; the mean of what rays meet first is what is expected.
TEST(NewSurface, IsTheMeanOverWorlds) {
  std::mt19937 random(2);
  const MadeMap made = evidence_maps::random_map(random, {11, 12, 10}, 0.05, 0.6);
  const NewSurfaceField field(made.evidence(), model_of(0.0, -2.5, -0.5));
  const NewSurfaceOptions options{1.5, {2.0, 1.1}};
  const RayBundle rays = small_bundle();
  for (const Pose& view : views_around(random, 3)) {
    std::vector<std::vector<Met>> met;
    for (const Vector3& direction : rays.directions)
      met.push_back(met_by(field.grid(), view.translation(), view.linear() * direction, options.ray_length));
    constexpr int worlds = 3000;
    double sum = 0.0, squares = 0.0;
    std::vector<std::uint8_t> holds_surface(field.grid().voxel_count());
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int world = 0; world < worlds; ++world) {
      for (std::size_t v = 0; v < holds_surface.size(); ++v) holds_surface[v] = uniform(random) < std::abs(field.at(v));
      double area = 0.0;
      for (std::size_t i = 0; i < met.size(); ++i)
        for (const Met& at : met[i]) {
          const Vector3 direction = view.linear() * rays.directions[i];
          if (holds_surface[at.voxel])
            area += 1e4 * slant_of(field, at.voxel, direction, options) * rays.solid_angles[i] * at.range * at.range;
          if (holds_surface[at.voxel] || field.at(at.voxel) < 0.0f) break;
        }
      sum += area, squares += area * area;
    }
    const double mean = sum / worlds, error = std::sqrt((squares / worlds - mean * mean) / worlds);
    const double expected = expected_new_surface(field, {&view, 1}, rays, options)[0];
    EXPECT_NEAR(expected, mean, 4 * error + 2e-3 * mean);
    EXPECT_LT(error, 0.02 * mean) << "too few worlds to tell";
  }
}

/// That only occupied voxels hold new surface, with this probability.
NewSurfaceModel of_occupied_alone(double probability) {
  NewSurfaceModel model;
  model.unmeasured[0] = model.free[0] = -200.0;
  model.occupied[0] = std::log(probability / (1.0 - probability));
  return model;
}

TEST(NewSurface, OfAWallIsItsAreaTimesItsChance) {
  MadeMap made({40, 60, 60}, 0.01);
  made.set_box({20, 10, 15}, {20, 49, 44}, 1.0);                          // 40 x 30 cm, 0.5 cm behind the origin
  const Pose view = look_at(Vector3(-1.195, 0.0, 0.0), Vector3::Zero());  // 1.2 m from its middle
  const RayBundle rays = small_bundle(330, 240, 0.5);
  // Rays aside see more of the wall than lies across them: the mean cosine, over the wall.
  double cosine = 0.0, cubed = 0.0;
  for (int y = -20; y < 20; ++y)
    for (int z = -15; z < 15; ++z) {
      const double one = 1.2 / Vector3(1.2, (y + 0.5) / 100, (z + 0.5) / 100).norm();
      cosine += one / 1200, cubed += one * one * one / 1200;
    }
  for (const double chance : {0.2, 0.9}) {
    const NewSurfaceField field(made.evidence(), of_occupied_alone(chance));
    for (const SurfaceSlant& slant : {SurfaceSlant{1.7, 1.7}, SurfaceSlant{3.0, 1.0}}) {
      // Its normal is known: all around it is unmeasured, and the object's box is as thin as the wall.
      const double expected = slant.edge_on * (cosine - cubed) + slant.face_on * cubed;
      const double found = expected_new_surface(field, {&view, 1}, rays, {1.5, slant})[0];
      EXPECT_NEAR(found / (1200.0 * expected * chance), 1.0, 0.015);
    }
    EXPECT_EQ(expected_new_surface(field, {&view, 1}, rays, {1.1, {}})[0], 0.0) << "out of reach";
  }
}

TEST(NewSurface, BehindAnOccupiedVoxelThereIsNone) {
  MadeMap made({40, 60, 60}, 0.01);
  made.set_box({20, 10, 10}, {20, 49, 49}, 1.0);
  made.set_box({25, 10, 10}, {25, 49, 49}, 1.0);  // as large, and hidden
  const Pose view = look_at(Vector3(-1.0, 0.0, 0.0), Vector3::Zero());
  const NewSurfaceField field(made.evidence(), of_occupied_alone(0.3));
  int meet_it = 0;
  for (const auto& ray :
       explain_new_surface(field, made.map.grid(), made.map.voxels(), view, small_bundle(), {}).rays) {
    std::size_t occupied = 0;
    for (const auto& voxel : ray.voxels) occupied += voxel.measured;
    EXPECT_LE(occupied, 1u);
    meet_it += occupied == 1;
  }
  EXPECT_GT(meet_it, 20);
}

TEST(NewSurface, ExplanationsOfManyRaysRoundAsTheScoreDoes) {
  std::mt19937 random(5);
  const MadeMap made = evidence_maps::random_map(random, {16, 14, 15}, 0.05, 0.5);
  const NewSurfaceField field(made.evidence(), model_of(0.0, -3.0, -0.5));
  const RayBundle many = small_bundle(64, 48);
  for (const Pose& view : views_around(random, 8)) {
    const ScoreExplanation why = explain_new_surface(field, made.map.grid(), made.map.voxels(), view, many, {});
    EXPECT_EQ(why.value, expected_new_surface(field, {&view, 1}, many, {})[0]);
  }
}

TEST(NewSurface, ExplanationsNameTheVoxelsAndSumToTheScore) {
  std::mt19937 random(4);
  const MadeMap made = evidence_maps::random_map(random, {16, 14, 15}, 0.05, 0.5);
  const NewSurfaceField field(made.evidence(), model_of(0.0, -3.0, -0.5));
  const NewSurfaceOptions options{1.4, {2.2, 1.3}};
  const VoxelGrid& whole = made.map.grid();
  for (const Pose& view : views_around(random, 8)) {
    const ScoreExplanation why = explain_new_surface(field, whole, made.map.voxels(), view, small_bundle(), options);
    EXPECT_EQ(why.value, expected_new_surface(field, {&view, 1}, small_bundle(), options)[0]);
    ASSERT_EQ(why.rays.size(), small_bundle().directions.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < why.rays.size(); ++i) {
      EXPECT_LT((why.rays[i].direction - view.linear() * small_bundle().directions[i]).norm(), 1e-12);
      const auto met = met_by(field.grid(), view.translation(), why.rays[i].direction, options.ray_length);
      double reach = 1.0, of_ray = 0.0;
      std::size_t next = 0;
      for (const auto& voxel : why.rays[i].voxels) {
        const Vector3i lattice(voxel.lattice[0], voxel.lattice[1], voxel.lattice[2]);
        const std::uint32_t number = field.grid().index(lattice - field.grid().first);
        while (next < met.size() && met[next].voxel != number) EXPECT_EQ(field.at(met[next++].voxel), 0.0f);
        ASSERT_LT(next, met.size()) << "not on the ray";
        const Vector3i cell = lattice - whole.first;
        EXPECT_EQ(voxel.measured, made.map.voxels().at(cell.x(), cell.y(), cell.z()).measured);
        EXPECT_EQ(voxel.probability, made.map.voxels().at(cell.x(), cell.y(), cell.z()).probability);
        EXPECT_NEAR(voxel.visibility, reach, 1e-9);
        const double range = met[next].range, q = std::abs(field.at(number));
        const double slant = slant_of(field, number, why.rays[i].direction, options);
        EXPECT_NEAR(voxel.contribution, 1e4 * slant * range * range * small_bundle().solid_angles[i] * reach * q, 1e-7);
        reach *= 1.0 - q;
        of_ray += voxel.contribution;
        ++next;
      }
      EXPECT_NEAR(why.rays[i].contribution, of_ray, 1e-9);
      sum += of_ray;
    }
    EXPECT_NEAR(why.value, sum, 1e-9 * (1 + sum));
  }
}

TEST(NewSurface, AForecastIsThatOfEachViewPartByPart) {
  std::mt19937 random(9);
  const MadeMap made = evidence_maps::random_map(random, {30, 28, 31}, 0.03, 0.7);
  const NewSurfaceField field(made.evidence(), model_of(0.0, -3.0, -0.5));
  const std::vector<Pose> views = views_around(random, 12);
  const auto forecast = forecast_new_surface(field, views, small_bundle(), {});
  EXPECT_EQ(forecast.areas, expected_new_surface(field, views, small_bundle(), {}));
  ASSERT_EQ(forecast.most.size(), 4u * 4u * 4u);
  double all = 0.0;
  for (std::size_t part = 0; part < forecast.most.size(); ++part) {
    double most = 0.0;
    for (std::size_t v = 0; v < views.size(); ++v) most = std::max(most, double(forecast.parts[v][part]));
    all += most;
  }
  EXPECT_NEAR(forecast.all, all, 1e-6 * all);
  for (std::size_t v = 0; v < views.size(); ++v) {
    // What lies in a part is what the rays say of the voxels there.
    std::vector<double> of_part(forecast.most.size(), 0.0);
    for (const auto& ray :
         explain_new_surface(field, made.map.grid(), made.map.voxels(), views[v], small_bundle(), {}).rays)
      for (const auto& voxel : ray.voxels) {
        const Vector3i p = (Vector3i(voxel.lattice[0], voxel.lattice[1], voxel.lattice[2]) - field.grid().first) / 8;
        of_part[std::size_t((p.z() * 4 + p.y()) * 4 + p.x())] += voxel.contribution;
      }
    for (std::size_t p = 0; p < of_part.size(); ++p)
      EXPECT_NEAR(forecast.parts[v][p], of_part[p], 1e-5 * (1 + forecast.areas[v]));
  }
}

// Along an axis, on the faces between voxels: rounding must not carry a ray anywhere.
TEST(NewSurface, ViewsAlongAnAxisAreLikeTheirNeighbours) {
  std::mt19937 random(8);
  const MadeMap made = evidence_maps::random_map(random, {30, 30, 30}, 0.03, 0.8);
  const NewSurfaceField field(made.evidence(), model_of(0.0, -3.0, -0.5));
  const RayBundle rays = small_bundle(19, 13);  // one ray in the middle
  for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, -1, 0), Vector3(-1, 1, 0), Vector3(1, 1e-17, -1e-17)}) {
    const Pose along = look_at(0.9 * axis, Vector3::Zero());
    const Pose beside = look_at(0.9 * axis + Vector3(1e-4, 1e-4, 1e-4), Vector3(1e-4, 1e-4, 1e-4));
    const double expected = expected_new_surface(field, {&beside, 1}, rays, {})[0];
    EXPECT_NEAR(expected_new_surface(field, {&along, 1}, rays, {})[0] / expected, 1.0, 0.1);
  }
}

TEST(NewSurface, AFieldHasTheChanceOfEachVoxelAndAMargin) {
  std::mt19937 random(11);
  const auto made = evidence_maps::random_map(random, {17, 14, 11}, 0.2, 0.8);
  for (const double finest : {SurfaceEvidence::finest_share, 0.1, 0.25}) {
    const SurfaceEvidence evidence = made.evidence(0.5, finest);
    ASSERT_EQ(evidence.block_edge(), finest < 0.1 ? 1 : finest < 0.2 ? 2 : 4);
    const NewSurfaceModel model = NewSurfaceModel::fitted();
    const NewSurfaceField field(evidence, model);
    const Eigen::Vector3i& size = field.grid().size;
    for (int z = -1; z <= size.z(); ++z)
      for (int y = -1; y <= size.y(); ++y)
        for (int x = -1; x <= size.x(); ++x) {
          const bool is_inside = field.grid().contains({x, y, z});
          ASSERT_EQ(field.at(x, y, z), is_inside ? model.chance(evidence, {x, y, z}) : ChanceField::outside);
          if (!is_inside || field.at(x, y, z) == 0.0f) continue;
          ASSERT_EQ(field.normal(x, y, z).direction(), evidence.normal(evidence.block_of({x, y, z})).direction());
        }
  }
}

TEST(NewSurface, OfAMapWithNothingOccupiedIsZero) {
  MadeMap made({20, 20, 20});
  made.set_box({3, 3, 3}, {12, 12, 12}, -1.0);
  const NewSurfaceField field(made.evidence(), NewSurfaceModel::fitted());
  EXPECT_EQ(field.grid().voxel_count(), 0u);
  std::mt19937 random(5);
  std::vector<Pose> views = views_around(random, 12);
  views.push_back(look_at(Vector3(1, 0, 0), Vector3::Zero()));  // along an axis
  for (const double area : expected_new_surface(field, views, small_bundle(), {})) EXPECT_EQ(area, 0.0);
  const auto why = explain_new_surface(field, made.map.grid(), made.map.voxels(), views[0], small_bundle(), {});
  EXPECT_EQ(why.value, 0.0);
  EXPECT_EQ(why.rays.size(), small_bundle().directions.size());
  EXPECT_TRUE(expected_new_surface(field, {}, small_bundle(), {}).empty());
}

TEST(NewSurface, TheSameBytesOnOneThreadAndTwo) {
  std::mt19937 random(6);
  const MadeMap made = evidence_maps::random_map(random, {30, 28, 31}, 0.05, 0.5);
  const std::vector<Pose> views = views_around(random, 40);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return expected_new_surface({made.evidence(), NewSurfaceModel::fitted()}, views, small_bundle(), {});
  };
  const auto one = run(1);
  EXPECT_EQ(one, run(2));
  const NewSurfaceField field(made.evidence(), NewSurfaceModel::fitted());
  for (std::size_t v = 0; v < views.size(); v += 7)
    EXPECT_EQ(expected_new_surface(field, {&views[v], 1}, small_bundle(), {})[0], one[v]) << "alone as in company";
}

TEST(NewSurface, AStopLeavesTheRestAtZero) {
  std::mt19937 random(7);
  const MadeMap made = evidence_maps::random_map(random, {12, 12, 12}, 0.1, 0.5);
  std::stop_source stop;
  stop.request_stop();
  const std::vector<Pose> views(20, look_at(Vector3(0.5, 0, 0), Vector3::Zero()));
  const NewSurfaceField field(made.evidence(), NewSurfaceModel::fitted());
  EXPECT_GT(expected_new_surface(field, views, small_bundle(), {})[0], 0.0);
  EXPECT_EQ(expected_new_surface(field, views, small_bundle(), {}, stop.get_token()), std::vector<double>(20, 0.0));
}

}  // namespace
}  // namespace nextview
