#pragma once
#include <memory>
#include <optional>
#include <span>

#include "core/evaluation/mesh_distance.hpp"
#include "core/evaluation/missed_surface.hpp"
#include "core/session/session.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// What has been seen of the object, gathered view by view for the scene: points, how far off they are, what is missed.
/// A copy shares what is large.
class SeenSurface {
 public:
  explicit SeenSurface(const Session& session);

  /// Adds those of the scans that it does not have yet. @pre it begins with the others
  void follow(std::span<const std::shared_ptr<const Scan>> scans);
  /// Finds how far off the points of these scans are and what is missed, if there is a truth. Takes several times as
  /// long as following them. @pre they are those that it follows
  void compare(std::span<const std::shared_ptr<const Scan>> scans);
  /// How many it has.
  std::size_t scans() const { return scans_; }
  std::shared_ptr<const SeenCloud> cloud() const { return cloud_; }  ///< without distances until they are compared
  std::shared_ptr<const GroundTruth> truth() const { return truth_; }
  std::shared_ptr<const MissedPicture> missed() const;  ///< null without a truth, and until it is compared

 private:
  /// The true surface, for all copies of this.
  struct Reference {
    std::shared_ptr<const TriangleMesh> mesh;
    double d_reg;
    std::optional<MeshDistance> distance = {};  ///< once it was asked for; so is the next
    std::optional<MissedSurface> nothing_seen = {};
  };
  std::shared_ptr<const SeenCloud> cloud_ = std::make_shared<SeenCloud>();
  std::shared_ptr<const GroundTruth> truth_;  ///< null without evaluation
  std::shared_ptr<Reference> reference_;      ///< so is this
  std::optional<MissedSurface> missed_;
  std::size_t scans_ = 0, compared_ = 0;
};

}  // namespace nextview
