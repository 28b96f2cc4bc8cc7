// Which of the sampler's chains a voxel's conditional and traces are of.
#include "tests/unit/workbench/inspected_scan.hpp"

namespace nextview {
namespace {

TEST(InspectedChain, TheConditionalIsGivenTheLastMapOfTheFirst) {
  InspectedScan scan(scan_by("occlusion-aware"));
  scan.step();
  scan.step();
  scan.runner.refine(2, 8, job_control());
  const GibbsMap& gibbs = *scan.now().gibbs;
  std::size_t tell_chains_apart = 0;
  for (std::uint32_t v = 0; v < gibbs.voxels->size(); v += 7) {
    const auto of_chain = [&](std::size_t chain) {
      return full_conditional(scan.now().grid, *gibbs.measurements, gibbs.config.model, gibbs.config.prior,
                              gibbs.posterior->states[chain], v)
          .probability;
    };
    const auto first = of_chain(0);
    EXPECT_EQ(scan.look(only_voxel(v)).voxel->conditional.value().probability, first) << v;
    tell_chains_apart += of_chain(1) != first;
  }
  EXPECT_GT(tell_chains_apart, 0u) << "the scan tells nothing of this";
}

}  // namespace
}  // namespace nextview
