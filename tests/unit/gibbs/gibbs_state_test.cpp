#include "core/gibbs/gibbs_state.hpp"

#include <gtest/gtest.h>

#include "core/progress/stopped.hpp"
#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

Configuration gibbs_scan() {
  Configuration c = small_scan();
  c.planner.gain = "gibbs";
  c.termination.views = 3;
  return c;
}

/// Two views of the box, not refined yet.
GibbsState two_views() {
  const Configuration c = gibbs_scan();
  Session session(small_scan());
  session.step();
  session.step();
  GibbsState refinement(session.map().grid(), posterior_sampler_config(c), c.map.model);
  for (const auto& scan : session.scans()) refinement.add(*scan);
  return refinement;
}

void expect_consistent(const GibbsState& refinement) {
  const GibbsPosterior& posterior = refinement.posterior();
  ASSERT_EQ(posterior.occupied.size(), refinement.voxels().size());
  for (std::size_t v = 0; v < posterior.occupied.size(); ++v) {
    ASSERT_EQ(refinement.voxels()[v].probability, posterior.touch[v]);
    ASSERT_EQ(refinement.voxels()[v].measured, posterior.informed[v] != 0);
    ASSERT_TRUE(posterior.occupied[v] >= 0.0f && posterior.occupied[v] <= 1.0f);
  }
  ASSERT_EQ(posterior.states.size(), std::size_t(refinement.config().chains));
  for (const auto& state : posterior.states) ASSERT_EQ(state.size(), posterior.occupied.size());
  const SamplerDiagnostics& d = posterior.diagnostics;
  for (const auto& trace : d.log_posterior) EXPECT_EQ(trace.size(), std::size_t(d.sweeps));
  EXPECT_GE(d.sweeps - d.burn_in, 4);
  EXPECT_GT(d.informed_voxels, 1000u);
}

TEST(GibbsState, AStopAtAnyMomentLeavesThePosteriorSoFar) {
  const GibbsState fresh = two_views();
  int moments = 0;
  {
    GibbsState whole = fresh;
    whole.refine({}, 24, [&](double, std::string_view, const SamplerDiagnostics&) { ++moments; }, {});
    expect_consistent(whole);
    EXPECT_EQ(whole.posterior().diagnostics.sweeps, 24);
  }
  ASSERT_GE(moments, 6);
  int last_sweeps = 0;
  for (int moment = 0; moment < moments; ++moment) {
    GibbsState refinement = fresh;
    std::stop_source stop;
    int calls = 0;
    const auto stop_there = [&](double, std::string_view, const SamplerDiagnostics&) {
      if (calls++ == moment) stop.request_stop();
    };
    if (moment == 0) {  // while the rays are listed: there is nothing yet
      EXPECT_THROW(refinement.refine({}, 24, stop_there, stop.get_token()), Stopped);
      refinement.refine({}, 24, {}, {});
      GibbsState whole = fresh;
      whole.refine({}, 24, {}, {});
      EXPECT_EQ(refinement.posterior().occupied, whole.posterior().occupied) << "it is as if it had never been asked";
      continue;
    }
    refinement.refine({}, 24, stop_there, stop.get_token());
    expect_consistent(refinement);
    const SamplerDiagnostics& d = refinement.posterior().diagnostics;
    EXPECT_NE(d.warning.find("stopped"), std::string::npos) << d.warning;
    EXPECT_GE(d.sweeps, last_sweeps);
    last_sweeps = d.sweeps;
    refinement.refine({}, 8, {}, {});  // and on it goes
    expect_consistent(refinement);
    EXPECT_EQ(refinement.posterior().diagnostics.sweeps, 8);
  }
}

TEST(GibbsState, ACopySharesWhatIsLargeAndGoesItsOwnWay) {
  GibbsState refinement = two_views();
  refinement.refine({}, 8, {}, {});
  GibbsState copy = refinement;
  EXPECT_EQ(&copy.posterior(), &refinement.posterior());
  EXPECT_EQ(&copy.measurements(), &refinement.measurements());
  EXPECT_EQ(copy.voxels().bytes_beside(refinement.voxels()), 0u);
  EXPECT_EQ(copy.bytes(&refinement), 0u);
  EXPECT_GT(copy.bytes(), 0u);
  const auto posterior = refinement.shared_posterior();
  const auto occupied = posterior->occupied;
  copy.refine({}, 8, {}, {});
  EXPECT_EQ(refinement.shared_posterior(), posterior);
  EXPECT_EQ(posterior->occupied, occupied);
  EXPECT_NE(copy.posterior().occupied, occupied);
  refinement.refine({}, 8, {}, {});
  EXPECT_EQ(refinement.posterior().occupied, copy.posterior().occupied);
  EXPECT_EQ(posterior->occupied, occupied) << "who holds it keeps it as it was";
}

// The lists of rays are handed on from one refinement to the next: whoever comes second makes them anew.
TEST(GibbsState, WhoseTurnItIsChangesNothing) {
  const Configuration c = gibbs_scan();
  Session session(small_scan());
  for (int view = 0; view < 3; ++view) session.step();
  GibbsState first(session.map().grid(), posterior_sampler_config(c), c.map.model);
  first.add(*session.scans()[0]);
  first.refine({}, 8, {}, {});
  GibbsState second = first, third = first;
  GibbsState alone(session.map().grid(), posterior_sampler_config(c), c.map.model);
  for (const int view : {0, 2}) {
    alone.add(*session.scans()[std::size_t(view)]);
    alone.refine({}, 8, {}, {});
    alone.forget_lists();
  }
  for (GibbsState* state : {&first, &second}) {
    state->add(*session.scans()[1]);
    state->refine({}, 8, {}, {});
    state->add(*session.scans()[2]);
    state->refine({}, 8, {}, {});
    expect_consistent(*state);
  }
  EXPECT_EQ(first.posterior().touch, second.posterior().touch);
  EXPECT_EQ(first.posterior().states, second.posterior().states);
  third.add(*session.scans()[2]);
  third.refine({}, 8, {}, {});
  EXPECT_EQ(third.posterior().touch, alone.posterior().touch) << "the lists that are kept are of other views";
  EXPECT_EQ(third.posterior().states, alone.posterior().states);
  // Refined again without another view: of all voxels, with other numbers.
  const auto observed = first.posterior().diagnostics.observed_voxels;
  first.refine({}, 8, {}, {});
  EXPECT_GT(first.posterior().diagnostics.observed_voxels, observed);
  EXPECT_NE(first.posterior().touch, second.posterior().touch);
}

TEST(GibbsState, ListsAreKeptForTheNextViewAndCounted) {
  GibbsState refinement = two_views();
  refinement.refine({}, 8, {}, {});
  const std::size_t with = refinement.bytes(), lists = refinement.posterior().diagnostics.list_bytes;
  const GibbsState copy = refinement;
  EXPECT_EQ(copy.bytes(&refinement), 0u) << "they are one for all copies";
  copy.forget_lists();
  EXPECT_EQ(refinement.bytes(), with - lists);
  refinement.refine({}, 0, {}, {});
  EXPECT_LT(refinement.bytes(), with) << "after a refinement until it is stationary none need follow";
}

TEST(GibbsState, RaysFromNowhereAreRefused) {
  GibbsState refinement = two_views();
  const auto before = refinement.shared_measurements();
  Scan far;
  far.max_range = 1.5;
  far.origin = {1e9, 0.0, 0.0};
  far.hits = {{0.0f, 0.0f, 1.0f}};
  EXPECT_THROW(refinement.add(far), std::invalid_argument);
  EXPECT_EQ(refinement.shared_measurements(), before);
}

TEST(GibbsState, AScanWithoutAMaximumRangeIsRefusedAndSaysWhy) {
  GibbsState refinement = two_views();
  GibbsState empty(refinement.posterior().grid, refinement.config(), {});
  Scan endless;
  endless.hits = {{0.0f, 0.0f, 1.0f}};
  try {
    empty.add(endless);
    ADD_FAILURE() << "it has no maximum range";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("Scan::max_range"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(empty.shared_measurements()->origins.empty());
  EXPECT_NO_THROW(refinement.add(endless)) << "all views have the maximum range of the first";
}

TEST(GibbsState, TellsWhatItWasMadeOf) {
  const GibbsState refinement = two_views();
  EXPECT_EQ(refinement.measurements().origins.size(), 2u);
  EXPECT_EQ(refinement.measurements().max_range, gibbs_scan().sensor.max_range);
  std::uint64_t weight = 0;
  for (const RangeMeasurement& ray : refinement.measurements().rays) weight += ray.weight;
  EXPECT_GT(weight, 2 * refinement.measurements().rays.size()) << "they are merged";
  Session session(gibbs_scan());
  session.step();
  const std::size_t in_region = session.records()[0].refinement->diagnostics.merged_rays;
  EXPECT_GE(session.refinement()->measurements().rays.size(), in_region);
  EXPECT_GT(in_region, 100u);
  EXPECT_EQ(session.refinement()->config().model.sigma, posterior_sampler_config(gibbs_scan()).model.sigma);
}

TEST(GibbsState, KeepsTracesIfTold) {
  GibbsState plain = two_views(), traced = plain;
  plain.refine({}, 12, {}, {});
  traced.keep_traces(true);
  traced.refine({}, 12, {}, {});
  EXPECT_EQ(plain.posterior().occupied, traced.posterior().occupied);
  EXPECT_TRUE(plain.posterior().traces.voxels.empty());
  const SamplerDiagnostics& d = traced.posterior().diagnostics;
  EXPECT_EQ(traced.posterior().traces.levels.at(0).size(), std::size_t(d.sweeps - d.burn_in));
  Configuration c = gibbs_scan();
  c.gibbs.sampler.keep_traces = true;
  EXPECT_EQ(to_toml(c), to_toml(gibbs_scan())) << "no setting of files";
  Session session(c);
  session.step();
  EXPECT_FALSE(session.refinement()->posterior().traces.voxels.empty());
}

}  // namespace
}  // namespace nextview
