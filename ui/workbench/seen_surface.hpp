#pragma once
#include <memory>

#include "core/evaluation/mesh_distance.hpp"
#include "core/evaluation/missed_surface.hpp"
#include "core/session/session.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// What has been seen of the object, gathered view by view for the scene: points, how far off they are, what is missed.
class SeenSurface {
 public:
  explicit SeenSurface(const Session& session);

  /// Adds the scans of the session that it does not have yet.
  void follow(const Session& session);
  std::shared_ptr<const SeenCloud> cloud() const { return cloud_; }
  std::shared_ptr<const GroundTruth> truth() const { return truth_; }
  std::shared_ptr<const MissedPicture> missed() const;

 private:
  std::shared_ptr<const SeenCloud> cloud_ = std::make_shared<SeenCloud>();
  std::shared_ptr<const GroundTruth> truth_;  ///< null without evaluation
  std::unique_ptr<MeshDistance> surface_;     ///< so are these
  std::unique_ptr<MissedSurface> missed_;
  std::size_t scans_ = 0;
};

}  // namespace nextview
