#pragma once
#include "ui/layers/octree_layer.hpp"
#include "ui/workbench/answer_thread.hpp"
#include "ui/workbench/layer_choice.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// Which voxels are drawn, of which map.
struct FacesQuestion {
  std::shared_ptr<const SessionSnapshot> session;
  MapChoice map = MapChoice::conventional;
  VoxelFilter filter = {};
};

struct FoundFaces {
  std::weak_ptr<const SessionSnapshot> session;  ///< whose maps are not kept for this
  MapChoice map = MapChoice::conventional;
  VoxelFilter filter = {};
  OctreeFaces faces = {};

  bool are_of(const SessionSnapshot& s, const LayerChoice& choice) const {
    return session.lock().get() == &s && map == choice.map && filter == choice.shown_voxels();
  }
};

/// Finds the faces of a new map on a thread of its own: going through millions of voxels takes longer than drawing what
/// is found, and no frame has to wait for it.
class FacesAhead {
 public:
  FacesAhead();

  void ask(FacesQuestion question) { thread_.ask(std::move(question)); }
  bool busy() const { return thread_.busy(); }
  std::shared_ptr<const FoundFaces> found() const { return thread_.answer(); }  ///< the latest; never null

 private:
  AnswerThread<FacesQuestion, FoundFaces> thread_;
};

}  // namespace nextview
