// A program of someone else's: a scan with a robot, a source and a planner of its own. Usage: parts MESH
#include <cstdio>
#include <exception>

#include "core/config/object_lengths.hpp"
#include "core/session/session.hpp"
using namespace nextview;

struct Turntable : FreeFlyingCamera {  // reaches what is not below the table
  using FreeFlyingCamera::FreeFlyingCamera;
  std::vector<Reach> reach(const Pose& from, std::span<const View> views) override {
    std::vector<Reach> result = FreeFlyingCamera::reach(from, views);
    for (std::size_t v = 0; v < views.size(); ++v)
      if (views[v].T_world_camera.translation().z() < 0.0) result[v].unreachable = "it is below the table";
    return result;
  }
};
struct Scanner : SimulatedSource {
  using SimulatedSource::SimulatedSource;
  Result<Capture> capture(const View& view, std::uint32_t step, std::stop_token stop) override {
    return SimulatedSource::capture(view, step, stop);  // one could talk to a device here
  }
};
struct NearestFirst : Planner {
  Plan plan(const PlanningSetup&, const Knowledge&, std::span<const View>, std::vector<Candidate> all,
            std::stop_token) const override {
    for (Candidate& candidate : all) candidate.gain = 10.0 - candidate.cost;
    const Ranking ranking = rank(all, {1.0, 0.0});
    return {all, ranking};
  }
};

int main(int, char** argv) try {
  Configuration configuration{.object = {.file = argv[1]}};
  const auto object = std::make_shared<PlacedMesh>(load_placed_mesh(argv[1], {configuration.object.longest_side}));
  fit_lengths(configuration, object->mesh.bounding_box().sizes().maxCoeff());  // voxels, ranges, noise, …
  const auto world = std::make_shared<SimulatedWorld>(object, configuration.sensor);
  const Pose start = look_at({configuration.views.radius, 0.0, 0.0}, {0.0, 0.0, 0.0});
  Session session(configuration, {std::make_unique<Scanner>(world, 1), std::make_unique<Turntable>(start),
                                  std::make_unique<NearestFirst>()});
  for (int step = 0; step < 2; ++step) session.step();
  std::printf("%zu views, %.2f of the surface covered\n", session.records().size(), session.records().back().coverage);
} catch (const std::exception& error) {  // each says the file and the reason
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
