#include "core/session/shared_objects.hpp"

#include <gtest/gtest.h>

#include "tests/unit/session/small_scan.hpp"

namespace nextview {
namespace {

/// Made with those objects.
std::unique_ptr<Session> session_of(const Configuration& c, SharedObjects& objects) {
  SessionParts parts;
  parts.objects = &objects;
  return std::make_unique<Session>(c, std::move(parts));
}

bool same_object(const Session& a, const Session& b) { return a.mesh() == b.mesh(); }
bool same_truth(const Session& a, const Session& b) { return a.known_object() == b.known_object(); }

TEST(SharedObjects, AreTheSameForTheSameObjectCameraAndCandidates) {
  SharedObjects objects;
  Configuration other_planner = small_scan(), other_seed = small_scan(), other_views = small_scan();
  other_planner.planner.gain = "random";
  other_planner.termination.views = 2;
  other_seed.seed = 2;
  other_views.views.count = 9;
  const auto one = session_of(small_scan(), objects), two = session_of(other_planner, objects);
  const auto seed = session_of(other_seed, objects), views = session_of(other_views, objects);
  const auto again = session_of(small_scan(), objects), seed_again = session_of(other_seed, objects);
  for (const Session* s : {two.get(), seed.get(), views.get(), again.get()}) EXPECT_TRUE(same_object(*one, *s));
  EXPECT_TRUE(same_truth(*one, *two));
  EXPECT_FALSE(same_truth(*one, *seed)) << "its samples are others";
  EXPECT_FALSE(same_truth(*one, *views));
  EXPECT_TRUE(same_truth(*one, *again)) << "seeds take turns";
  EXPECT_TRUE(same_truth(*seed, *seed_again));
}

TEST(SharedObjects, AreOthersForAnotherCameraMapEvaluationOrPlace) {
  SharedObjects objects;
  Configuration camera = small_scan(), map = small_scan(), evaluation = small_scan(), place = small_scan();
  camera.sensor.range_noise = 0.003;
  map.map.resolution = 0.05;
  evaluation.evaluation.d_reg = 0.03;
  place.object.longest_side = 0.3;
  for (const Configuration& other : {camera, map, evaluation, place}) {
    const auto one = session_of(small_scan(), objects), two = session_of(other, objects);
    EXPECT_FALSE(same_truth(*one, *two));
    EXPECT_EQ(same_object(*one, *two), other.object.longest_side == 0.0);
    EXPECT_EQ(two->camera().width, 80);
    EXPECT_EQ(two->known_object()->truth().grid.resolution, other.map.resolution);
  }
}

TEST(SharedObjects, ChangeNoByte) {
  SharedObjects objects;
  for (const std::uint64_t seed : {1, 2, 1}) {
    for (const char* gain : {"oracle", "new-surface"}) {
      Configuration c = small_scan();
      c.seed = seed;
      c.planner.gain = gain;
      c.evaluation.any_pose = true;
      c.evaluation.surface_samples = 300;
      const auto sharing = session_of(c, objects);
      Session alone(c);
      finish(*sharing);
      finish(alone);
      EXPECT_TRUE(same_scan(*sharing, alone)) << gain << ' ' << seed;
      EXPECT_EQ(sharing->records().back().coverage_any_pose, alone.records().back().coverage_any_pose);
    }
  }
}

TEST(SharedObjects, KeepNoObjectButThePresentOne) {
  SharedObjects objects;
  std::weak_ptr<const TriangleMesh> box = session_of(small_scan(), objects)->mesh();
  EXPECT_FALSE(box.expired()) << "for the next session";
  Configuration sphere = small_scan();
  sphere.object.file = "sphere";
  session_of(sphere, objects);
  EXPECT_TRUE(box.expired());
}

TEST(SharedObjects, KeepNothingOfAnObjectThatCannotBeRead) {
  SharedObjects objects;
  session_of(small_scan(), objects);
  Configuration broken = small_scan();
  broken.object.file = "nowhere.ply";
  EXPECT_THROW(session_of(broken, objects), std::runtime_error);
  const auto after = session_of(small_scan(), objects);
  EXPECT_EQ(after->object_file().filename(), "box.ply");
}

}  // namespace
}  // namespace nextview
