#pragma once
#include <memory>
#include <vector>

#include "core/evaluation/known_object.hpp"
#include "core/session/session_parts.hpp"
#include "core/source/simulated_source.hpp"

namespace nextview {

/// What sessions only read of their object, so that those of the same one share it: its mesh, the tree by which rays
/// find its triangles, and what is known of it. Each is made for the first that wants it and kept until one wants
/// another, whose it then is: no more than one object is kept. A session is the same to the byte as one of its own.
/// What is given never changes and lives as long as anybody has it; to ask for it is for one thread at a time.
class SharedObjects {
 public:
  /// As load_object(), which reads the file each time.
  ConfiguredObject load(Configuration& configuration, const std::stop_token& stop = {});

  /// The object in front of such a camera. @throws as SimulatedWorld
  std::shared_ptr<const SimulatedWorld> world(const std::shared_ptr<const PlacedMesh>& object,
                                              const DepthCameraConfig& sensor, const std::stop_token& stop = {});

  /// What is known of the object in a world, by a configuration's seed and how it evaluates. @throws as KnownObject
  std::shared_ptr<const KnownObject> known(const std::shared_ptr<const SimulatedWorld>& world,
                                           const Configuration& configuration, const VoxelGrid& region,
                                           std::vector<Pose> candidates, const std::stop_token& stop = {});

 private:
  struct Known {
    std::uint64_t seed;  ///< by which the surface is sampled
    EvaluationConfig evaluation;
    std::shared_ptr<const KnownObject> object;
  };

  ObjectFile file_;
  std::shared_ptr<const PlacedMesh> object_;  ///< of that file; null: none was read
  std::shared_ptr<const SimulatedWorld> world_;
  std::vector<Known> known_;  ///< of that world; several, as a study's seeds take turns
};

}  // namespace nextview
