#include "tests/benchmarks/read_out_fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace nextview {
namespace {

constexpr int features = ReadOutFeatures::count, units = ReadOutNetwork::units;
constexpr int batch = 1024, passes = 40;
constexpr float first_step = 5e-3f, decay = 1e-5f;

using Inputs = Eigen::Matrix<float, Eigen::Dynamic, features, Eigen::RowMajor>;
using Row = Eigen::Matrix<float, 1, features>;

/// All that is fitted, one after the other: linear, out, in by feature.
struct Parameters {
  static constexpr int count = features + units + features * units;
  Eigen::VectorXf all = Eigen::VectorXf::Zero(count);

  auto linear() { return all.head<features>(); }
  auto out() { return all.segment<units>(features); }
  auto in() {
    return Eigen::Map<Eigen::Matrix<float, features, units, Eigen::RowMajor>>(all.data() + features + units);
  }
};

/// All samples together, features with a mean of 0 and a deviation of 1, but for the first, which is 1.
struct TrainingSet {
  Inputs inputs;
  Eigen::VectorXf truth, weights;  ///< those have a mean of 1
  Row mean, scale;

  TrainingSet(std::span<const ReadOutSamples> cases, std::vector<float> ReadOutSamples::*truth_of,
              const std::array<bool, features>& used) {
    Eigen::Index count = 0;
    for (const ReadOutSamples& samples : cases) count += Eigen::Index(samples.features.size());
    inputs.resize(count, features), truth.resize(count), weights.resize(count);
    Eigen::Index i = 0;
    for (const ReadOutSamples& samples : cases)
      for (std::size_t k = 0; k < samples.features.size(); ++k, ++i) {
        inputs.row(i) = Eigen::Map<const Row>(samples.features[k].data());
        truth[i] = (samples.*truth_of)[k];
        weights[i] = float(samples.weight / double(samples.features.size()));
      }
    weights *= float(count) / weights.sum();
    mean = inputs.cast<double>().colwise().mean().cast<float>();
    scale = (inputs.rowwise() - mean).cwiseAbs2().cast<double>().colwise().mean().cwiseSqrt().cast<float>();
    mean[0] = 0.0f, scale[0] = 1.0f;
    scale.array() += 1e-3f;
    for (int k = 0; k < features; ++k)
      if (!used[std::size_t(k)]) inputs.col(k).setZero(), mean[k] = 0.0f;
    inputs = (inputs.rowwise() - mean).array().rowwise() / scale.array();
  }
};

/// The slope of a batch's mean log loss.
Parameters slope(Parameters& at, const TrainingSet& set, std::span<const Eigen::Index> rows) {
  const auto count = Eigen::Index(rows.size());
  Inputs x(count, features);
  Eigen::VectorXf truth(count), weights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    x.row(i) = set.inputs.row(rows[std::size_t(i)]);
    truth[i] = set.truth[rows[std::size_t(i)]], weights[i] = set.weights[rows[std::size_t(i)]];
  }
  const Eigen::ArrayXXf sums = (x * at.in()).array(), below = 1.0f + sums.abs();
  const Eigen::MatrixXf bent = sums / below;
  const Eigen::ArrayXf log_odds = (x * at.linear() + bent * at.out()).array().min(30.0f).max(-30.0f);
  const Eigen::VectorXf off = (weights.array() * (1.0f / (1.0f + (-log_odds).exp()) - truth.array())) / float(count);
  Parameters slope;
  slope.linear() = x.transpose() * off;
  slope.out() = bent.transpose() * off;
  slope.in() = x.transpose() * ((off * at.out().transpose()).array() / below.square()).matrix();
  slope.all += decay * at.all;
  return slope;
}

/// What is fitted to scaled features, for features as they are.
ReadOutNetwork as_they_are(Parameters& p, const TrainingSet& set) {
  p.linear().array() /= set.scale.transpose().array();
  p.linear()[0] -= set.mean.dot(p.linear());
  auto in = p.in();
  in.array().colwise() /= set.scale.transpose().array();
  in.row(0) -= set.mean * in;
  ReadOutNetwork network;
  std::copy_n(p.all.data(), features, network.linear.begin());
  std::copy_n(p.all.data() + features, units, network.out.begin());
  for (int k = 0; k < features; ++k)
    std::copy_n(p.all.data() + features + units * (k + 1), units, network.in[std::size_t(k)].begin());
  return network;
}

}  // namespace

ReadOutNetwork fit_read_out(std::span<const ReadOutSamples> cases, std::vector<float> ReadOutSamples::*truth,
                            const std::array<bool, ReadOutFeatures::count>& used) {
  const TrainingSet set(cases, truth, used);
  std::mt19937 random(1);
  Parameters p;
  std::normal_distribution<float> normal;
  for (float& weight : p.out()) weight = normal(random) / std::sqrt(float(units));
  for (float& weight : p.in().reshaped()) weight = normal(random) / std::sqrt(float(features));
  for (int k = 0; k < features; ++k)
    if (!used[std::size_t(k)]) p.in().row(k).setZero();
  std::vector<Eigen::Index> order(std::size_t(set.truth.size()));
  std::iota(order.begin(), order.end(), 0);
  const std::size_t steps = passes * (order.size() / batch);
  Eigen::ArrayXf first = Eigen::ArrayXf::Zero(Parameters::count), second = first;
  std::size_t step = 0;
  for (int pass = 0; pass < passes; ++pass) {
    std::shuffle(order.begin(), order.end(), random);
    for (std::size_t begin = 0; begin + batch <= order.size(); begin += batch) {
      const Eigen::ArrayXf g = slope(p, set, std::span(order).subspan(begin, batch)).all.array();
      first = 0.9f * first + 0.1f * g;
      second = 0.999f * second + 0.001f * g.square();
      const auto t = float(++step);
      const float length = first_step * 0.5f * (1.0f + std::cos(std::numbers::pi_v<float> * t / float(steps)));
      p.all.array() -=
          length * (first / (1.0f - std::pow(0.9f, t))) / ((second / (1.0f - std::pow(0.999f, t))).sqrt() + 1e-8f);
    }
  }
  return as_they_are(p, set);
}

}  // namespace nextview
