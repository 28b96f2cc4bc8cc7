#include <cmath>

#include "core/gibbs/read_out.hpp"
#include "core/random/counter_random.hpp"
#include "tests/unit/map/instruction_sets.hpp"

namespace nextview {
namespace {

/// By the definition, feature by feature and unit by unit.
float answer_plainly(const ReadOutNetwork& network, const ReadOutFeatures::Vector& features) {
  float answer = 0.0f;
  for (std::size_t k = 0; k < features.size(); ++k) answer += features[k] * network.linear[k];
  for (std::size_t unit = 0; unit < ReadOutNetwork::units; ++unit) {
    float sum = 0.0f;
    for (std::size_t k = 0; k < features.size(); ++k) sum += features[k] * network.in[k][unit];
    answer += network.out[unit] * sum / (1.0f + std::abs(sum));
  }
  return answer;
}

class ReadOutNetworkOn : public OnInstructionSet {};

TEST_P(ReadOutNetworkOn, AnswersAsItIsDefinedToTheLastBit) {
  const CounterRandom draws(1, 0, 0);
  for (std::size_t problem = 0; problem < 200; ++problem) {
    ReadOutFeatures::Vector features;
    for (std::size_t k = 0; k < features.size(); ++k) {
      const auto u = draws.uniform(problem * features.size() + k);
      features[k] = u[0] < 0.4 ? 0.0f : static_cast<float>(8.0 * u[1] - 4.0);
    }
    for (const ReadOutNetwork* network : {&fitted_read_out().touch, &fitted_read_out().centre})
      ASSERT_EQ(network->log_odds(features), answer_plainly(*network, features)) << problem;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReadOutNetworkOn, instruction_sets(), instruction_set_name);

}  // namespace
}  // namespace nextview
