#include "tests/benchmarks/posterior_fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/calibration/sensor_model_calibration.hpp"
#include "core/gibbs/posterior_sampler.hpp"
#include "tests/benchmarks/evidence_posterior.hpp"
#include "tests/benchmarks/read_out_fit.hpp"

namespace nextview {
namespace {

/// What the read-out sees of a case.
struct Evidence {
  GibbsPosterior posterior;
  ReadOutRays rays;
};

GibbsPosterior posterior_of(const EvidenceCase& c) {
  return sample_posterior(c.grid, measurements_of(c.scans), sampler_of(c), octomap_of(c));
}

/// Those near the surface, which scores are of, and a few of all others that were looked at, so that a voxel in the
/// open is right too. No more than tell something of a case.
std::array<ReadOutSamples, 2> samples_of(const EvidenceCase& c, const Evidence& evidence) {
  constexpr std::uint32_t one_of = 256;
  constexpr std::size_t most = 12'000;
  constexpr double weight_elsewhere = 0.1;
  const ReadOutFeatures features(evidence.posterior, evidence.rays);
  const std::vector<std::uint8_t> scored = scored_voxels(c);
  const GroundTruth& truth = c.truth.voxels;
  const std::vector<float> inside = centres_inside(c);
  const std::size_t every = 1 + std::size_t(std::ranges::count(scored, 1)) / most;
  std::array<ReadOutSamples, 2> samples;
  samples[1].weight = weight_elsewhere;
  std::size_t number = 0;
  for (std::uint32_t v = 0; v < scored.size(); ++v) {
    if (!evidence.posterior.informed[v] || !c.truth.visited[v] || truth.hidden(v)) continue;
    if (scored[v] ? number++ % every != 0 : v % one_of != 0) continue;
    ReadOutSamples& to = samples[scored[v] ? 0 : 1];
    to.features.push_back(features.of(v));
    to.touch.push_back(truth.touch[v]);
    to.centre.push_back(inside[v]);
  }
  return samples;
}

/// What the conventional map's terms are fitted to, for one sensor.
struct TermHistories {
  UpdateHistories touch, centre, posterior;

  void add(const EvidenceCase& c, const GibbsPosterior& gibbs) {
    const std::vector<std::uint8_t> mask = scored_voxels(c);
    const auto add = [&](UpdateHistories& histories, const auto& target) {
      const std::vector<float> targets(target.begin(), target.end());
      histories.add(c.grid, c.scans, targets, mask);
    };
    add(touch, c.truth.voxels.touch.bytes());
    add(centre, c.truth.voxels.centre.bytes());
    add(posterior, gibbs.touch);
  }
};

void print_terms(const char* name, const UpdateHistories& histories) {
  const InverseSensorModel m = calibrate(histories.without_ranges(), {}).model;
  fmt::print("  {}: hit {:.4f} miss {:.4f} clamps {:.4f} {:.4f}\n", name, m.hit, m.miss, m.clamp_min, m.clamp_max);
}

/// As C++ has it.
std::string text_of(const ReadOutNetwork& network) {
  std::vector<std::string> in;
  for (const ReadOutNetwork::OfUnits& of_feature : network.in)
    in.push_back(fmt::format("{{{:.5g}}}", fmt::join(of_feature, ", ")));
  return fmt::format("{{{{{:.5g}}},\n{{{:.5g}}},\n{{{{{}}}}}}}", fmt::join(network.linear, ", "),
                     fmt::join(network.out, ", "), fmt::join(in, ",\n"));
}

/// Of what it was fitted to, near the surface; the mean over the cases.
double log_loss(const ReadOutNetwork& network, const std::vector<ReadOutSamples>& cases,
                std::vector<float> ReadOutSamples::*truth) {
  double sum = 0.0, weights = 0.0;
  for (const ReadOutSamples& samples : cases) {
    if (samples.weight < 1.0) continue;
    double loss = 0.0;
    for (std::size_t i = 0; i < samples.features.size(); ++i) {
      const double p = probability(network.log_odds(samples.features[i]));
      const double occupied = (samples.*truth)[i];
      loss -= occupied * std::log(std::max(1e-9, p)) + (1.0 - occupied) * std::log(std::max(1e-9, 1.0 - p));
    }
    sum += loss / double(samples.features.size()), weights += 1.0;
  }
  return sum / weights;
}

void print_weights(const char* name, const std::vector<ReadOutSamples>& cases, bool rays_alone) {
  std::array<bool, ReadOutFeatures::count> used;
  for (std::size_t k = 0; k < used.size(); ++k) used[k] = !rays_alone || k == 0 || k >= ReadOutFeatures::first_of_rays;
  ReadOutNetwork touch, centre;
  tbb::parallel_invoke([&] { touch = fit_read_out(cases, &ReadOutSamples::touch, used); },
                       [&] { centre = fit_read_out(cases, &ReadOutSamples::centre, used); });
  fmt::print("// log loss: touch {:.4f}, centre {:.4f}\n", log_loss(touch, cases, &ReadOutSamples::touch),
             log_loss(centre, cases, &ReadOutSamples::centre));
  fmt::print("const ReadOutWeights {}\n{{{},\n{}}};\n", name, text_of(touch), text_of(centre));
}

/// Calls `visit` with the made-up parts as a sensor sees them.
template <class Visit>
void for_each_case(const EvidenceSensor& sensor, std::span<const int> numbers_of_views, Visit visit) {
  for (const FittingPart& part : fitting_parts())
    for (const int views : numbers_of_views) {
      visit(evidence_case(part.object, part.pose, sensor, views));
      fmt::print(stderr, "{}, {}, {} views\n", part.object, sensor.name, views);
    }
}

}  // namespace

void fit_terms(std::span<const int> numbers_of_views) {
  for (const EvidenceSensor& sensor : fitting_sensors) {
    if (!sensor.compared) continue;
    TermHistories terms;
    for_each_case(sensor, numbers_of_views, [&](const EvidenceCase& c) { terms.add(c, posterior_of(c)); });
    fmt::print("{}\n", sensor.name);
    print_terms("touch", terms.touch);
    print_terms("centre", terms.centre);
    print_terms("posterior", terms.posterior);
    std::fflush(stdout);
  }
}

void fit_read_outs(std::span<const int> numbers_of_views) {
  std::vector<ReadOutSamples> cases;
  for (const EvidenceSensor& sensor : fitting_sensors)
    for_each_case(sensor, numbers_of_views, [&](const EvidenceCase& c) {
      for (ReadOutSamples& samples : samples_of(c, {posterior_of(c), rays_of(c)})) cases.push_back(std::move(samples));
    });
  print_weights("read_out", cases, false);
  print_weights("read_out_of_rays_alone", cases, true);
}

}  // namespace nextview
