#include "core/session/shared_objects.hpp"

#include <algorithm>

#include "core/session/object_mesh.hpp"

namespace nextview {
namespace {

constexpr std::size_t most_of_known = std::size_t{1} << 28;  ///< that is kept [bytes]

/// What it takes, roughly: a sample with its place, normal and cell and which candidates see it; four masks of voxels.
std::size_t bytes_of_known(const KnownObject& known) {
  return known.samples().points.size() * (80 + known.candidates().size()) + known.truth().grid.voxel_count() / 2;
}

bool same_region(const VoxelGrid& a, const VoxelGrid& b) {
  return a.resolution == b.resolution && a.first == b.first && a.size == b.size;
}

}  // namespace

ConfiguredObject SharedObjects::load(Configuration& c, const std::stop_token& stop) {
  ObjectFile file = configured_object_file(c);
  if (!object_ || !(file == file_)) {
    *this = SharedObjects();  // before the next is read: there may be no room for two
    object_ = std::make_shared<const PlacedMesh>(load_object_mesh(file.file, file.options, stop));
    file_ = std::move(file);
  }
  ConfiguredObject object{file_.file, object_};
  fit_to_object(c, object);
  return object;
}

std::shared_ptr<const SimulatedWorld> SharedObjects::world(const std::shared_ptr<const PlacedMesh>& object,
                                                           const DepthCameraConfig& sensor,
                                                           const std::stop_token& stop) {
  if (world_ && world_->object == object && world_->camera.config() == sensor) return world_;
  known_.clear();
  world_.reset();
  world_ = std::make_shared<const SimulatedWorld>(object, sensor, stop);
  return world_;
}

std::shared_ptr<const KnownObject> SharedObjects::known(const std::shared_ptr<const SimulatedWorld>& world,
                                                        const Configuration& c, const VoxelGrid& region,
                                                        std::vector<Pose> candidates, const std::stop_token& stop) {
  if (world_ != world) {
    known_.clear();
    world_ = world;
  }
  const auto found = std::ranges::find_if(known_, [&](const Known& k) {
    return k.seed == c.seed && k.evaluation == c.evaluation && same_region(k.object->truth().grid, region) &&
           std::ranges::equal(k.object->candidates(), candidates,
                              [](const Pose& a, const Pose& b) { return a.matrix() == b.matrix(); });
  });
  if (found != known_.end()) return found->object;
  auto made =
      std::make_shared<const KnownObject>(world->object->surroundings(), evaluation_samples(c, world->object->mesh),
                                          std::shared_ptr<const MeshRayCaster>(world, &world->scene), world->camera,
                                          std::move(candidates), region, c.evaluation.d_reg, stop);
  // The first stay: where more seeds take turns than there is room for, who came last would be gone when it is wanted.
  std::size_t bytes = bytes_of_known(*made);
  for (const Known& k : known_) bytes += bytes_of_known(*k.object);
  if (bytes <= most_of_known) known_.push_back({c.seed, c.evaluation, made});
  return made;
}

}  // namespace nextview
