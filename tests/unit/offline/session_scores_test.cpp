// Candidate views of a session, scored by several gains.
#include "core/offline/session_scores.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

TEST(SessionScores, AreThoseOfEachGainAlone) {
  Session session(small_scan());
  for (int i = 0; i < 2; ++i) session.step();
  const ScanState before = session.state();
  const std::vector<std::string> all = {"new-surface-gibbs", "new-surface", "gibbs", "area-factor"};
  const SceneScores scores = score_session(session, all);
  EXPECT_TRUE(same_candidates(session.records().back().candidates, before.records.back()->candidates));
  for (std::size_t g = 0; g < all.size(); ++g) {
    const SceneScores alone = score_session(session, {&all[g], 1});
    for (std::size_t v = 0; v < scores.views.size(); ++v) {
      const double gain = scores.views[v].gains[g], of_alone = alone.views[v].gains[0];
      EXPECT_TRUE(gain == of_alone || (std::isnan(gain) && std::isnan(of_alone))) << all[g] << " of view " << v;
    }
  }
}

}  // namespace
}  // namespace nextview
