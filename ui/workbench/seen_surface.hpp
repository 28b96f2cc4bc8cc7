#pragma once
#include <memory>
#include <optional>

#include "core/evaluation/mesh_distance.hpp"
#include "core/evaluation/missed_surface.hpp"
#include "core/session/session.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// What has been seen of the object, gathered view by view for the scene: points, how far off they are, what is missed.
/// A value: a copy shares what is large.
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
  std::shared_ptr<const GroundTruth> truth_;     ///< null without evaluation
  std::shared_ptr<const MeshDistance> surface_;  ///< so is this
  std::optional<MissedSurface> missed_;          ///< nothing without evaluation
  std::size_t scans_ = 0;
};

}  // namespace nextview
