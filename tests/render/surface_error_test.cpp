#include "core/evaluation/surface_error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "tests/render/render_test.hpp"
#include "ui/figures/surface_error_figure.hpp"
#include "ui/figures/uncertainty_spread.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

constexpr std::uint32_t around = 128, across = 56;

double turn(std::uint32_t step, std::uint32_t steps) { return 2 * std::numbers::pi * step / steps; }

/// A torus that stands on its edge, 0.5 m wide; `off(u, v)` [m]: how far it lies outside, u around it, v across it.
TriangleMesh torus(const std::function<double(double, double)>& off) {
  constexpr double ring = 0.17, tube = 0.08;  // radii [m]
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = turn(i, around), v = turn(j, across), thick = tube + off(u, v), r = ring + thick * std::cos(v);
      mesh.vertices.push_back(Vector3(r * std::cos(u), thick * std::sin(v), r * std::sin(u)).cast<float>());
      const auto at = [](std::uint32_t a, std::uint32_t b) { return a % around * across + b % across; };
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  return mesh;
}

TriangleMesh true_torus() {
  return torus([](double, double) { return 0.0; });
}

constexpr double lean = 0.0003;  // [m]

/// How far the scan lies off: outwards by a little on the whole, with waves, a bump and two dents [m].
double scan_error(double u, double v) {
  const auto hill = [&](double middle_u, double middle_v, double width) {
    const double du = 2.0 * std::remainder(u - middle_u, 2 * std::numbers::pi);
    const double dv = std::remainder(v - middle_v, 2 * std::numbers::pi);
    return std::exp(-(du * du + dv * dv) / (2 * width * width));
  };
  return lean + 0.0006 * std::sin(7 * u + 2 * v) * std::sin(3 * v) + 0.0045 * hill(0.6, -1.2, 0.5) -
         0.0042 * hill(2.3, -1.5, 0.6) - 0.003 * hill(1.2, 1.4, 0.5);
}

/// The torus as a scan might leave it. What lies low has not been seen; there its uncertainty means nothing.
Surface scanned_torus() {
  Surface surface;
  surface.mesh = torus(scan_error);
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = turn(i, around), v = turn(j, across), z = surface.mesh.vertices[surface.seen.size()].z();
      const double above = z + 0.13 - 0.02 * std::sin(5 * v);  // the border of what has been seen [m]
      surface.seen.push_back(above > 0.0);
      surface.uncertainty.push_back(
          float(above > 0.0 ? 0.0005 + 0.4 * std::abs(scan_error(u, v)) + 0.002 * std::exp(-40 * above) : 0.02));
    }
  // Two openings: one in what has not been seen, one in what has.
  std::erase_if(surface.mesh.triangles, [&](const std::array<std::uint32_t, 3>& t) {
    const Eigen::Vector3f& p = surface.mesh.vertices[t[0]];
    return p.z() < -0.242f || (p - Eigen::Vector3f(0.208f, -0.057f, -0.088f)).norm() < 0.012f;
  });
  return surface;
}

SurfaceError surface_error_of(const Surface& surface) {
  const TriangleMesh truth = true_torus();
  const SurfaceSamples samples = sample_surface(truth, 20'000, 1);
  std::vector<std::uint8_t> visible;
  for (const Eigen::Vector3f& p : samples.points) visible.push_back(p.z() > -0.2f);
  return surface_error(surface, SignedDistance(truth), samples, visible, {.samples = 20'000}).value();
}

SurfacePicture picture_of(const Surface& surface) {
  SurfacePicture picture;
  picture.title = "Scanned surface · torus, 0.5 m";
  picture.remark = "made up for this picture";
  picture.surface = &surface;
  return picture;
}

TEST(SurfaceErrorFigure, RefusesWhatDoesNotBelongTogether) {
  const Surface surface = scanned_torus();
  SurfaceError error;
  error.at_vertices.assign(surface.mesh.vertices.size() - 1, 0.0f);
  OffscreenTarget target(160, 100);
  EXPECT_THROW(draw_surface_error_figure(target, picture_of(surface), error), std::invalid_argument);
  EXPECT_THROW(draw_surface_figure(target, {}), std::invalid_argument);
  Surface without_marks = surface;
  without_marks.seen.clear();
  EXPECT_THROW(draw_surface_figure(target, picture_of(without_marks)), std::invalid_argument);
}

/// Two squares of edge 1 m in the plane z = 0, side by side along x, each of two triangles.
Surface two_squares() {
  Surface surface;
  for (const float x : {0.0f, 1.0f, 2.0f})
    for (const float y : {0.0f, 1.0f}) surface.mesh.vertices.push_back({x, y, 0.0f});
  surface.mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}};
  surface.seen.assign(6, 1);
  return surface;
}

TEST(SurfaceErrorFigure, DrawsASurfaceThatNobodySaw) {
  Surface surface = two_squares();
  surface.uncertainty.assign(6, 0.01f);
  surface.seen.assign(6, 0);
  OffscreenTarget target(1200, 800);
  EXPECT_EQ(draw_surface_figure(target, picture_of(surface)).width, 1200);
  EXPECT_EQ(target.height(), 800) << "it is not as it was given";
}

TEST(UncertaintySpread, IsTakenByArea) {
  Surface surface = two_squares();
  surface.uncertainty = {0.001f, 0.001f, 0.001f, 0.001f, 0.0055f, 0.001f};  // means 1, 1, 2.5 and 1 mm
  const UncertaintySpread spread = uncertainty_spread(surface);
  EXPECT_DOUBLE_EQ(spread.area_seen, 2.0);
  EXPECT_EQ(spread.area_unseen, 0.0);
  EXPECT_NEAR(spread.median, 0.001, 1e-8);
  EXPECT_NEAR(spread.percentile_95, 0.0025, 1e-8);
  EXPECT_DOUBLE_EQ(spread.end, 0.003);
  double sum = 0.0;
  for (const double share : spread.shares) sum += share;
  EXPECT_NEAR(sum, 1.0, 1e-9);
  EXPECT_NEAR(spread.shares[16], 0.75, 1e-9);  // bins of 0.06 mm
  EXPECT_NEAR(spread.shares[41], 0.25, 1e-9);

  surface.seen[4] = 0;
  EXPECT_DOUBLE_EQ(uncertainty_spread(surface).area_unseen, 0.5);
  EXPECT_NEAR(uncertainty_spread(surface).percentile_95, 0.001, 1e-8);
  surface.seen.assign(6, 0);
  EXPECT_EQ(uncertainty_spread(surface).area_seen, 0.0);
  EXPECT_EQ(uncertainty_spread(surface).median, 0.0);
}

TEST(MeshPaint, LeavesNothingOnTheMeshThatIsShownNext) {
  const Surface surface = two_squares();
  const std::vector<float> values = {0, 1, 2, 3, 4, 5};
  const auto plain = [&](Scene& scene) {
    scene.mesh().show(surface.mesh);
    scene.frame({-50, 60});
  };
  const auto painted_before = [&](Scene& scene) {
    scene.mesh().show(surface.mesh, {values, surface.seen, ColourMap::score(), 0.0, 5.0, "number", "mm"});
    plain(scene);
  };
  OffscreenTarget target(320, 240);
  const Image never_painted = draw_scene(target, plain);
  EXPECT_EQ(draw_scene(target, painted_before), never_painted);
}

TEST(MeshPaint, WhereThereIsNoValueTheNumberDoesNotMatter) {
  const Surface surface = two_squares();
  const std::vector<std::uint8_t> left = {1, 1, 1, 1, 0, 0};
  OffscreenTarget target(320, 240);
  const auto picture = [&](float right) {
    const std::vector<float> values = {0, 1, 2, 3, right, right};
    return draw_scene(target, [&](Scene& scene) {
      scene.mesh().show(surface.mesh, {values, left, ColourMap::score(), 0.0, 5.0, "number", "mm"});
      scene.frame({-50, 60});
    });
  };
  const Image zero = picture(0.0f);
  EXPECT_EQ(picture(4.0f), zero);
  EXPECT_EQ(picture(std::numeric_limits<float>::quiet_NaN()), zero);
}

TEST(MeshPaint, InterpolatesNumbersNotColours) {
  // From -1 to +1 over one long triangle pair: colours mixed between the ends would never pass the map's light grey.
  const Surface surface = two_squares();
  const std::vector<float> values = {-1, -1, 0, 0, 1, 1}, ends = {-1, -1, 1, 1, 1, 1};
  OffscreenTarget target(480, 320);
  for (const auto& numbers : {values, ends}) {
    const Image image = draw_scene(target, [&](Scene& scene) {
      scene.mesh().show(surface.mesh, {numbers, {}, ColourMap::deviation(), -1.0, 1.0, "distance", "m"});
      scene.set_axes(false, false);
      scene.set_legends(false);
      scene.frame({-90, 89});
    });
    int grey = 0, blue = 0, red = 0;
    for (int x = 60; x < 420; ++x) {
      const std::uint8_t* pixel = &image.rgba[(std::size_t(160) * 480 + x) * 4];
      grey += std::abs(pixel[0] - pixel[2]) < 25 && pixel[1] > 200;
      blue += pixel[2] > pixel[0] + 80;
      red += pixel[0] > pixel[2] + 80;
    }
    EXPECT_GT(blue, 5);
    EXPECT_GT(red, 5);
    EXPECT_GT(grey, 5);
  }
}

TEST(MeshPaint, IsRefusedIfItDoesNotFit) {
  const Surface surface = two_squares();
  const std::vector<float> values(6, 1.0f), few(5, 1.0f);
  const std::vector<float> broken = {1, 1, 1, 1, 1, std::numeric_limits<float>::infinity()};
  draw_scene(64, 64, [&](Scene& scene) {
    const auto refused = [&](const MeshPaint& paint) {
      EXPECT_THROW(scene.mesh().show(surface.mesh, paint), std::invalid_argument);
    };
    refused({few, {}, ColourMap::score(), 0.0, 1.0, "", ""});
    refused({values, std::span(surface.seen).first(5), ColourMap::score(), 0.0, 1.0, "", ""});
    refused({broken, surface.seen, ColourMap::score(), 0.0, 1.0, "", ""});
    refused({values, {}, ColourMap::score(), 1.0, 1.0, "", ""});
    refused({values, {}, ColourMap::score(), 0.0, double(NAN), "", ""});
  });
}

TEST(ColourMaps, DeviationIsPalestOnTheSurfaceAndAsDarkOnBothSides) {
  const ColourMap map = ColourMap::deviation();
  for (int i = 0; i < 10; ++i) {
    const double t = 0.05 * i;
    EXPECT_LT(lightness(map.at(t)), lightness(map.at(t + 0.05)));
    EXPECT_NEAR(lightness(map.at(t)), lightness(map.at(1.0 - t)), 0.02);
  }
  const auto [red, green, blue] = map.at(0.5);
  EXPECT_NEAR(red, green, 0.01);
  EXPECT_NEAR(blue, green, 0.01);
}

RENDER_TEST(mesh_painted, 960, 600, {
  const Surface surface = scanned_torus();
  const SurfaceError error = surface_error_of(surface);
  std::vector<float> values;
  for (const float metres : error.at_vertices) values.push_back(1e3f * metres);
  scene.mesh().show(surface.mesh, {values, surface.seen, ColourMap::deviation(), -5.0, 5.0, "signed distance", "mm",
                                   "inside", "outside"});
  scene.frame();
})

}  // namespace
}  // namespace nextview
