#include "core/gibbs/test_problems.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "core/setting/setting.hpp"

namespace nextview {
namespace {

constexpr double edge = 0.01;       ///< of a voxel [m]
constexpr double max_range = 0.15;  ///< of the sensor [m]

/// One ray along the corridor's axis that ended at `x` [m].
Scan along_corridor(float x) { return {{-0.05, 0.005, 0.005}, {{x, 0.005f, 0.005f}}, {}, max_range}; }

TestProblem corridor() {
  return {"corridor",
          "one surface just before the face between voxels 5 and 6; of four noisy ranges one falls behind the face",
          "OctoMap calls 5 and 6 occupied, as if the wall were two voxels thick. But every ray stops at the first "
          "surface:\n"
          "5 explains all four, so 6 keeps little more than its prior, and of what is behind nothing is known.",
          {edge, {0, 0, 0}, {10, 1, 1}},
          0.002,
          {along_corridor(0.0580f), along_corridor(0.0606f), along_corridor(0.0588f), along_corridor(0.0574f)}};
}

TestProblem contradiction() {
  TestProblem problem{
      "contradiction",
      "three rays end in voxel 4, three others pass it and end in voxel 7: an edge fills part of voxel 4",
      "Partly filled voxels (attenuation) explain all six rays: 4 and 7 are occupied, and 4 is not solid to its "
      "centre.\n"
      "With --model beam a voxel stops every ray or none: half of them must be outliers, and which is a toss-up.",
      {edge, {0, 0, 0}, {10, 1, 1}},
      0.002,
      {}};
  for (const float x : {0.044f, 0.0745f, 0.0455f, 0.0755f, 0.0463f, 0.0761f})
    problem.scans.push_back(along_corridor(x));
  return problem;
}

/// A wall from y = 12 to 18 mm with a gap from x = 8.5 to 20.5 mm, seen by two cameras in front of it, both aslant.
TestProblem slot() {
  const auto at = [](float x, float y) { return Eigen::Vector3f(x, y, 0.005f); };
  Scan left{{-0.02, -0.03, 0.005},
            {at(0.002f, 0.0125f), at(0.006f, 0.0118f), at(0.0196f, 0.0155f), at(0.026f, 0.0122f), at(0.033f, 0.0118f)},
            {},
            max_range};
  Scan right{{0.06, -0.03, 0.005},
             {at(0.036f, 0.0121f), at(0.030f, 0.0117f), at(0.024f, 0.0124f), at(0.0104f, 0.0133f)},
             {},
             max_range};
  const auto pass = [&](Scan& scan, float x) {  // crosses the front of the wall at x
    const Vector3 direction = (at(x, 0.012f).cast<double>() - scan.origin).normalized();
    scan.misses.push_back((scan.origin + max_range * direction).cast<float>());
  };
  for (const float x : {0.0095f, 0.011f, 0.0125f, 0.014f}) pass(left, x);
  for (const float x : {0.0175f, 0.0183f, 0.0190f, 0.0197f}) pass(right, x);
  return {
      "slot",
      "a wall (middle row, voxels 4 to 7) with an opening one voxel wide (5), seen aslant by two cameras",
      "Through voxel 5 eight rays pass; two that hit its sides end in it, by noise. OctoMap lets one hit of a scan\n"
      "outweigh all its misses and closes the opening; the rays taken together leave it open.",
      {edge, {0, 0, 0}, {4, 3, 1}},
      0.002,
      {left, right}};
}

/// The plane x + z = 22 mm cuts the voxels aslant; one camera looks along x, one down along z.
TestProblem grid() {
  Scan side{{-0.04, 0.01, 0.011}, {}, {}, max_range}, above{{0.011, 0.01, 0.06}, {}, {}, max_range};
  for (Scan* scan : {&side, &above})
    for (const double y : {0.004, 0.014})
      for (const double across : {0.003, 0.008, 0.013, 0.017}) {
        const Vector3 target(scan == &side ? 0.022 - across : across, y, scan == &side ? across : 0.022 - across);
        scan->hits.push_back(target.cast<float>());
      }
  return {"grid",
          "a plane that cuts 3 x 2 x 2 voxels aslant, seen from the side and from above",
          "Two rays cross voxel 7, two cross 0. OctoMap counts a scan once, be it two rays or two thousand: both stay\n"
          "unknown at 0.40, while the rays say that they are free. Behind the plane (2, 8) only the prior is left.",
          {edge, {0, 0, 0}, {3, 2, 2}},
          0.002,
          {side, above}};
}

}  // namespace

std::span<const TestProblem> test_problems() {
  static const std::vector<TestProblem> problems = {corridor(), contradiction(), slot(), grid()};
  return problems;
}

const TestProblem& test_problem(std::string_view name) {
  std::vector<std::string> names;
  for (const TestProblem& problem : test_problems()) {
    if (problem.name == name) return problem;
    names.emplace_back(problem.name);
  }
  throw std::invalid_argument(
      fmt::format("there is no test problem '{}'{}", name,
                  did_you_mean(std::string(name), names, fmt::format("; there are {}", fmt::join(names, ", ")))));
}

}  // namespace nextview
