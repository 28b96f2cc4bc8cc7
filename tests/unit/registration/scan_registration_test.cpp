#include "core/registration/scan_registration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/evaluation/accuracy.hpp"
#include "core/progress/stopped.hpp"
#include "core/registration/alignment.hpp"
#include "tests/unit/registration/simulated_scans.hpp"

namespace nextview {
namespace {

constexpr double noise = 0.002, resolution = 0.01, degrees = std::numbers::pi / 180.0;

RegistrationLimits limits_of(RegistrationConfig::Mode mode, double range_noise = noise) {
  RegistrationConfig config;
  config.mode = mode;
  return registration_limits(config, range_noise, resolution);
}
const RegistrationLimits check = limits_of(RegistrationConfig::Mode::check);

/// Mean distance of all points to the truth, once the cloud as a whole lies on it [m].
double aligned_accuracy(const Scans& scans, const TriangleMesh& mesh) {
  PointCloud cloud = all_hits(scans);
  const Alignment alignment = align(cloud, mesh);
  for (Eigen::Vector3f& p : cloud) p = (alignment.T_surface_cloud * p.cast<double>()).cast<float>();
  return accuracy(cloud, MeshDistance(mesh)).mean;
}

Scans corrected(const Scans& scans, const RegistrationLimits& limits) {
  Scans result{scans.front()};
  for (std::size_t k = 1; k < scans.size(); ++k) {
    const ScanRegistration found = register_scan(*scans[k], result, limits);
    EXPECT_TRUE(found.reliable) << k << ": " << found.why_not;
    result.push_back(std::make_shared<const Scan>(moved(*scans[k], found.T_corrected_believed)));
  }
  return result;
}

Vector3 middle(const Scan& scan) {
  Vector3 sum = Vector3::Zero();
  for (const Eigen::Vector3f& p : scan.hits) sum += p.cast<double>();
  return sum / double(scan.hits.size());
}

/// A scan turned about its middle and shifted [m, rad].
Scan displaced(const Scan& scan, const Vector3& shift, double angle = 0.0, const Vector3& axis = Vector3::UnitZ()) {
  const Vector3 at = middle(scan);
  return moved(
      scan, Eigen::Translation3d(at + shift) * Eigen::AngleAxisd(angle, axis.normalized()) * Eigen::Translation3d(-at));
}

/// Each scan but the first is wrong by 5 mm and 1 degree, in some direction.
Scans all_displaced(const Scans& scans, std::uint64_t seed) {
  Scans result{scans.front()};
  for (std::uint32_t k = 1; k < scans.size(); ++k) {
    const Pose error = pose_error({1.0, 1.0}, seed, k + 1);
    const Vector3 direction = error.translation().normalized();
    const Vector3 axis = Eigen::AngleAxisd(error.linear()).axis();
    result.push_back(std::make_shared<const Scan>(displaced(*scans[k], 0.005 * direction, 1.0 * degrees, axis)));
  }
  return result;
}

class Accuracies : public testing::TestWithParam<std::tuple<std::string, double>> {};

TEST_P(Accuracies, AreThoseOfGoodPosesAgain) {
  const auto& [name, range_noise] = GetParam();
  const auto object = object_named(name);
  const auto limits = limits_of(RegistrationConfig::Mode::correct, range_noise);
  const Scans good = scans_of(object, views_around(12), range_noise);
  const double without_errors = aligned_accuracy(good, object->mesh);
  const Scans wrong = all_displaced(good, 1);
  const double before = aligned_accuracy(wrong, object->mesh);
  const double after = aligned_accuracy(corrected(wrong, limits), object->mesh);
  fmt::print("{}, noise {} mm: unperturbed {:.3f} mm, perturbed {:.3f} mm, corrected {:.3f} mm ({:+.1f} %)\n", name,
             1e3 * range_noise, 1e3 * without_errors, 1e3 * before, 1e3 * after, 1e2 * (after / without_errors - 1.0));
  EXPECT_GT(before, 1.5 * without_errors);
  EXPECT_LT(after, 1.2 * without_errors);
}
INSTANTIATE_TEST_SUITE_P(Objects, Accuracies,
                         testing::Combine(testing::Values("slotted_housing", "slotted_plate", "sphere"),
                                          testing::Values(0.001, 0.002)));

TEST(MergedPoints, PointsFarOffAreToldApart) {
  MergedPoints merged(1e-4);  // 1e10 cubes and more from the world's origin
  const std::vector<OrientedPoint> points = {{Vector3(1e6, 0, 0), Vector3::UnitZ(), 1.0},
                                             {Vector3(2e6, 0, 0), Vector3::UnitZ(), 1.0}};
  merged.add(points);
  EXPECT_EQ(merged.points().size(), 2u);
}

TEST(RegisterScan, ATargetThatIsBroughtAlongIsTheSame) {
  const auto object = object_named("sphere");
  const Scans scans = scans_of(object, views_around(4), noise, {0.002, 0.2}, 2);
  RegistrationTarget along;
  for (const std::size_t before : {1, 3, 2}) {  // and back again
    const auto so_far = std::span(scans).first(before);
    const ScanRegistration alone = register_scan(*scans[before], so_far, check);
    const ScanRegistration found = register_scan(*scans[before], so_far, check, along);
    EXPECT_EQ(found.T_corrected_believed.matrix(), alone.T_corrected_believed.matrix()) << before;
    EXPECT_EQ(found.overlap, alone.overlap) << before;
    EXPECT_EQ(along.of(so_far, check.spacing, {}).size(), RegistrationTarget().of(so_far, check.spacing, {}).size());
  }
}

TEST(RegisterScan, CorrectsARobotThatErrs) {  // by 9 mm and, about the camera, by 16 mm at the object
  const auto object = object_named("slotted_housing");
  const double without_errors = aligned_accuracy(scans_of(object, views_around(12), noise), object->mesh);
  const Scans wrong = scans_of(object, views_around(12), noise, {0.005, 1.0}, 2);
  const double after = aligned_accuracy(corrected(wrong, limits_of(RegistrationConfig::Mode::correct)), object->mesh);
  EXPECT_LT(after, 1.2 * without_errors);
}

/// Root mean square distance of a scan's points to those of the same pixels without errors [m].
double displacement(const Scan& scan, const Scan& exact) {
  double squares = 0.0;
  for (std::size_t i = 0; i < scan.hits.size(); ++i) squares += (scan.hits[i] - exact.hits[i]).squaredNorm();
  return std::sqrt(squares / double(scan.hits.size()));
}

TEST(RegisterScan, WhatTheShapeLeavesOpenStaysNearWhereItIsBelieved) {
  // Of the plate's two faces, a quarter turn apart, only the rims meet.
  const Scans exact = scans_of(object_named("slotted_plate"), views_around(4), 0.0);
  const RegistrationLimits limits = limits_of(RegistrationConfig::Mode::correct);
  RegistrationLimits anywhere = limits;
  anywhere.expected = {1e3, 1e6};
  double worst = 0.0, worst_anywhere = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 shift = 0.01 * Vector3::Unit((axis + 1) % 3);
    const Scan off = displaced(*exact[1], shift, 1.5 * degrees, Vector3::Unit(axis));
    const auto left = [&](const RegistrationLimits& with) {
      const ScanRegistration found = register_scan(off, std::span(exact).first(1), with);
      return displacement(moved(off, found.T_corrected_believed), *exact[1]);
    };
    worst = std::max(worst, left(limits));
    worst_anywhere = std::max(worst_anywhere, left(anywhere));
  }
  fmt::print("of 10 mm and 1.5 deg, {:.1f} mm are left; without a prior {:.1f} mm\n", 1e3 * worst,
             1e3 * worst_anywhere);
  EXPECT_LT(worst, 0.6 * worst_anywhere);
}

TEST(RegisterScan, RaisesNoFalseAlarmAndFindsTheScanThatIsOff) {
  for (const std::string name : {"slotted_housing", "slotted_plate"}) {
    Scans scans = scans_of(object_named(name), views_around(20), noise);
    double shift = 0.0, rotation = 0.0;
    for (std::size_t k = 1; k < scans.size(); ++k) {
      const ScanRegistration found = register_scan(*scans[k], std::span(scans).first(k), check);
      EXPECT_TRUE(found.reliable) << found.why_not;
      EXPECT_EQ(beyond_limits(found, check), "") << name << " " << k;
      shift = std::max(shift, found.shift);
      rotation = std::max(rotation, found.rotation);
    }
    fmt::print("{}: good scans seem off by up to {:.2f} mm and {:.3f} deg\n", name, 1e3 * shift, rotation / degrees);
    for (const Vector3& direction : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}) {
      const Scan off = displaced(*scans[7], 0.008 * direction);
      const ScanRegistration found = register_scan(off, std::span(scans).first(7), check);
      EXPECT_NEAR(found.shift, 0.008, 0.002) << name << " " << direction.transpose();
      EXPECT_NE(beyond_limits(found, check), "");
      EXPECT_LT(found.residual_after, found.residual_before);
    }
  }
}

TEST(RegisterScan, APlaneGivesNoSidewaysCorrection) {
  auto wall = std::make_shared<PlacedMesh>();
  wall->mesh.vertices = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
  wall->mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const double range_noise : {0.0, 0.001, 0.002}) {
    const Scans scans = scans_of(wall, views_around(2), range_noise);
    const Scan off = displaced(*scans[1], {0.006, -0.004, 0.005});
    const ScanRegistration found = register_scan(off, std::span(scans).first(1), check);
    EXPECT_EQ(found.constrained, 3);
    const Vector3 change = found.T_corrected_believed * middle(off) - middle(off);
    EXPECT_NEAR(change.z(), -0.005, 0.0003) << "towards the plane";
    EXPECT_LT(change.head<2>().norm(), 0.0003) << "along it";
  }
}

TEST(RegisterScan, CorrectsNothingWhereScansDoNotMeet) {
  const Scans scans = scans_of(object_named("slotted_housing"), views_around(2), noise);
  const Scan elsewhere = displaced(*scans[1], {1.0, 0.0, 0.0});
  const ScanRegistration found = register_scan(elsewhere, std::span(scans).first(1), check);
  EXPECT_FALSE(found.reliable);
  EXPECT_EQ(found.why_not, "0 % of the scan's points lie on what was scanned before; 12 % are needed");
  EXPECT_EQ(found.T_corrected_believed.matrix(), Pose::Identity().matrix());
  EXPECT_FALSE(register_scan(*scans[1], {}, check).reliable) << "nothing before";
  EXPECT_FALSE(register_scan(Scan(), std::span(scans).first(1), check).reliable) << "no points";
}

TEST(RegisterScan, TellsTheSidesOfAThinWallApart) {
  auto sheet = std::make_shared<PlacedMesh>();
  sheet->mesh.vertices = {{0, -0.2f, -0.2f}, {0, 0.2f, -0.2f}, {0, 0.2f, 0.2f}, {0, -0.2f, 0.2f}};
  sheet->mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Scans scans = scans_of(sheet, views_around(2), 0.001);
  const ScanRegistration found = register_scan(*scans[1], std::span(scans).first(1), check);
  EXPECT_LT(found.overlap, 0.05) << "its back is not its front";
}

TEST(RegisterScan, IsTheSameForTheSameInputAndCanBeStopped) {
  const Scans scans = scans_of(object_named("slotted_housing"), views_around(6), noise);
  const auto before = std::span(scans).first(1);
  const ScanRegistration a = register_scan(*scans[1], before, check), b = register_scan(*scans[1], before, check);
  EXPECT_EQ(a.T_corrected_believed.matrix(), b.T_corrected_believed.matrix());
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(register_scan(*scans[1], before, check, stop.get_token()), Stopped);
}

TEST(RegistrationLimits, FollowFromTheNoiseUnlessSet) {
  EXPECT_NEAR(check.max_shift, 0.004, 1e-12);
  EXPECT_NEAR(check.spacing, 0.005, 1e-12);
  EXPECT_GT(limits_of(RegistrationConfig::Mode::correct).max_shift, check.max_shift);
  RegistrationConfig config;
  config.max_shift = 0.02;
  config.max_rotation = 3.0;
  EXPECT_EQ(registration_limits(config, noise, resolution).max_shift, 0.02);
  EXPECT_EQ(registration_limits(config, noise, resolution).max_rotation, 3.0);
  EXPECT_EQ(registration_limits(config, noise, resolution, {0.1, 9.0}).max_shift, 0.02) << "what is asked for counts";
  config.min_overlap = 0.0;
  EXPECT_THROW(config.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace nextview
