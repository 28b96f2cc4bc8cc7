#include "ui/window/faces_ahead.hpp"

#include <tbb/task_arena.h>

#include "ui/workbench/chosen_voxels.hpp"

namespace nextview {
namespace {

std::shared_ptr<const FoundFaces> find_faces(const FacesQuestion& question) {
  auto found = std::make_shared<FoundFaces>(FoundFaces{question.session, question.map, question.filter});
  const SessionSnapshot& s = *question.session;
  // Who waits for its own loops must not help the session with its long ones.
  tbb::this_task_arena::isolate(
      [&] { found->faces = octree_faces(s.grid, chosen_voxels(s, question.map), question.filter); });
  return found;
}

}  // namespace

FacesAhead::FacesAhead()
    : thread_([](const FacesQuestion& question, const std::stop_token&) { return find_faces(question); }, {}) {}

}  // namespace nextview
