// A gain of someone else's, beside the default one. Usage: gain MESH
#include <cstdio>
#include <exception>

#include "core/session/session.hpp"
using namespace nextview;

struct UnmeasuredVoxels : Policy {  // that the rays of a view pass
  std::string unit() const override { return "voxels"; }
  Valuation values(const PlanningState& state, std::span<const std::size_t> available, std::stop_token) const override {
    std::vector<double> values;
    std::vector<RayVoxel> passed;
    for (const std::size_t candidate : available) {
      const Pose& T_world_camera = state.candidates[candidate].T_world_camera;
      double unmeasured = 0.0;
      for (const Vector3& direction : state.bundle.directions) {
        state.caster.cast(T_world_camera.translation(), T_world_camera.linear() * direction, passed);
        for (const RayVoxel& voxel : passed) unmeasured += !voxel.measured;
      }
      values.push_back(unmeasured);
    }
    return values;
  }
};

void scan(const Configuration& configuration, std::unique_ptr<Planner> planner, const char* name) {
  Session session(configuration, {.planner = std::move(planner)});
  while (session.finished().empty()) session.step();
  std::printf("%s: %.1f %% of what the candidates can see covered by %zu views\n", name,
              100.0 * session.records().back().coverage_visible, session.records().size());
}

int main(int, char** argv) try {
  Configuration configuration{.object = {.file = argv[1]}};
  configuration.termination.views = 6;
  scan(configuration, std::make_unique<OneStepPlanner>(std::make_unique<UnmeasuredVoxels>()), "mine");
  scan(configuration, nullptr, "the default");
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
