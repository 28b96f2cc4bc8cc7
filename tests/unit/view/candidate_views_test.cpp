#include "core/view/candidate_views.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nextview {
namespace {

constexpr double pi = std::numbers::pi;
const Vector3 target(0.3, -0.2, 0.7);

struct Layout {
  ViewLayout layout;
  const char* name;
  double solid_angle;  ///< of the part of the sphere that the views spread over
};
const Layout layouts[] = {{ViewLayout::hemisphere, "hemisphere", 2 * pi},
                          {ViewLayout::sphere, "sphere", 4 * pi},
                          {ViewLayout::rings, "rings", 0},
                          {ViewLayout::fibonacci, "fibonacci", 4 * pi}};

CandidateViewsConfig config_of(ViewLayout layout, int count) {
  CandidateViewsConfig config;
  config.layout = layout;
  config.count = count;
  config.radius = 0.75;
  return config;
}

Vector3 bearing(const Pose& view) { return (view.translation() - target).normalized(); }

double angle(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

double smallest_angle(const std::vector<Pose>& views) {
  double smallest = pi;
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) smallest = std::min(smallest, angle(bearing(views[i]), bearing(views[k])));
  return smallest;
}

TEST(CandidateViews, AsManyAsAskedForAllFacingTheTargetAtTheRadius) {
  for (const Layout& layout : layouts)
    for (int count = 1; count <= 260; ++count) {
      CandidateViewsConfig config = config_of(layout.layout, count);
      config.rings = std::min(count, 1 + count % 7);
      const std::vector<Pose> views = candidate_views(config, target);
      ASSERT_EQ(views.size(), std::size_t(count)) << layout.name;
      for (const Pose& view : views) {
        const Vector3 to_target = target - view.translation();
        ASSERT_NEAR(to_target.norm(), config.radius, 1e-12) << layout.name;
        ASSERT_LT((view.linear().col(2) - to_target / config.radius).norm(), 1e-12) << layout.name;
        ASSERT_LT((view.linear().transpose() * view.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
        ASSERT_NEAR(view.linear().determinant(), 1.0, 1e-12);
        if (layout.layout == ViewLayout::hemisphere) {
          ASSERT_GE(view.translation().z(), target.z() - 1e-12);
        }
      }
    }
}

// The densest packing of n caps on a part of the sphere gives each about solid_angle / n: a distance of
// sqrt(2 / sqrt(3) * solid_angle / n). An even layout stays above half of it.
TEST(CandidateViews, NeighboursKeepTheirDistance) {
  for (const Layout& layout : layouts)
    for (const int count : {4, 5, 7, 10, 16, 20, 30, 48, 49, 64, 100, 150, 333, 500}) {
      if (layout.solid_angle == 0) continue;
      const std::vector<Pose> views = candidate_views(config_of(layout.layout, count), target);
      const double packing = std::sqrt(2.0 / std::sqrt(3.0) * layout.solid_angle / count);
      EXPECT_GT(smallest_angle(views), 0.5 * packing) << layout.name << " " << count;
    }
}

// No direction (of the hemisphere: above the horizon) lies far from all views.
TEST(CandidateViews, LeaveNoHoles) {
  for (const Layout& layout : layouts)
    for (const int count : {8, 20, 48, 100, 300}) {
      if (layout.solid_angle == 0) continue;
      const std::vector<Pose> views = candidate_views(config_of(layout.layout, count), target);
      const double packing = std::sqrt(2.0 / std::sqrt(3.0) * layout.solid_angle / count);
      double largest = 0.0;
      for (double elevation = layout.solid_angle > 7 ? -90 : 0; elevation <= 90; elevation += 3)
        for (double azimuth = 0; azimuth < 360; azimuth += 5) {
          const double e = elevation * pi / 180, a = azimuth * pi / 180;
          const Vector3 direction(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
          double nearest = pi;
          for (const Pose& view : views) nearest = std::min(nearest, angle(direction, bearing(view)));
          largest = std::max(largest, nearest);
        }
      EXPECT_LT(largest, packing) << layout.name << " " << count;
    }
}

TEST(CandidateViews, RingsAreOfEqualSizeAndEvenlySpaced) {
  for (const int rings : {1, 2, 3, 4, 6}) {
    CandidateViewsConfig config = config_of(ViewLayout::rings, 48);
    config.rings = rings;
    std::vector<std::pair<double, std::vector<double>>> found;  // elevation, azimuths [deg]
    for (const Pose& view : candidate_views(config, target)) {
      const Vector3 b = bearing(view);
      const double elevation = std::asin(b.z()) * 180 / pi, azimuth = std::atan2(b.y(), b.x()) * 180 / pi;
      const auto same = [&](const auto& ring) { return std::abs(ring.first - elevation) < 1e-9; };
      auto ring = std::find_if(found.begin(), found.end(), same);
      if (ring == found.end()) ring = found.insert(found.end(), {elevation, {}});
      ring->second.push_back(azimuth);
    }
    ASSERT_EQ(found.size(), std::size_t(rings));
    std::sort(found.begin(), found.end());
    for (std::size_t r = 0; r < found.size(); ++r) {
      if (rings > 1) {
        EXPECT_NEAR(found[r].first, -60.0 + 120.0 * double(r) / (rings - 1), 1e-9) << rings;
      }
      auto& azimuths = found[r].second;
      ASSERT_EQ(azimuths.size(), 48u / rings);
      std::sort(azimuths.begin(), azimuths.end());
      for (std::size_t i = 1; i < azimuths.size(); ++i)
        EXPECT_NEAR(azimuths[i] - azimuths[i - 1], 360.0 * rings / 48, 1e-9);
    }
  }
}

TEST(CandidateViews, TheSameEveryTime) {
  for (const Layout& layout : layouts) {
    const auto a = candidate_views(config_of(layout.layout, 48), target);
    const auto b = candidate_views(config_of(layout.layout, 48), target);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].matrix(), b[i].matrix());
  }
}

TEST(CandidateViews, BoundsThemselvesAreTaken) {
  const auto is_valid = [](auto change) {
    CandidateViewsConfig config;
    change(config);
    try {
      config.validate();
    } catch (const std::invalid_argument&) {
      return false;
    }
    return true;
  };
  for (const auto& [count, valid] : {std::pair(0, false), {1, true}, {10000, true}, {10001, false}}) {
    EXPECT_EQ(is_valid([=](auto& c) { c.count = count; }), valid) << count;
    EXPECT_EQ(is_valid([=](auto& c) { c.layout = ViewLayout::rings, c.count = 10000, c.rings = count; }), valid);
  }
  for (const auto& [radius, valid] : {std::pair(0.0009, false), {0.001, true}, {100.0, true}, {100.1, false}})
    EXPECT_EQ(is_valid([=](auto& c) { c.radius = radius; }), valid) << radius;
  for (const auto& [adaptive, valid] : {std::pair(0, false), {1, true}, {1000, true}, {1001, false}})
    EXPECT_EQ(is_valid([=](auto& c) { c.adaptive = adaptive; }), valid) << adaptive;
  EXPECT_TRUE(is_valid([](auto& c) { c.layout = ViewLayout::rings, c.count = c.rings; })) << "a view a ring";
  EXPECT_TRUE(is_valid([](auto& c) { c.count = 1; })) << "rings are of the layout rings alone";
}

TEST(CandidateViews, RejectsWhatMakesNoSense) {
  const auto rejects = [](auto change, const char* field) {
    CandidateViewsConfig config;
    change(config);
    try {
      candidate_views(config, target);
      ADD_FAILURE() << field << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  };
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  rejects([](auto& c) { c.count = 0; }, "count");
  rejects([](auto& c) { c.count = -3; }, "count");
  rejects([](auto& c) { c.count = std::numeric_limits<int>::max(); }, "count");
  for (const double bad : {0.0, -1.0, nan, infinity, -infinity}) rejects([&](auto& c) { c.radius = bad; }, "radius");
  for (const int bad : {0, -1, 49}) rejects([&](auto& c) { c.layout = ViewLayout::rings, c.rings = bad; }, "rings");
  rejects([](auto& c) { c.layout = ViewLayout::file; }, "file");
}

}  // namespace
}  // namespace nextview
