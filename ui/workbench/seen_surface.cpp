#include "ui/workbench/seen_surface.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "ui/workbench/viewed_normals.hpp"

namespace nextview {
namespace {

/// Points kept of a view, at most: more do not show, and a software renderer feels each.
constexpr std::size_t points_per_view = 8'000;

}  // namespace

SeenSurface::SeenSurface(const Session& session) {
  const KnownObject* object = session.known_object();
  if (!object) return;
  truth_ = {session.setup().truth, &object->truth()};
  surface_ = std::make_shared<const MeshDistance>(*session.mesh());
  missed_.emplace(*session.mesh(), session.configuration().evaluation.d_reg);
}

void SeenSurface::follow(const Session& session) {
  if (scans_ == session.scans().size()) return;
  auto cloud = std::make_shared<SeenCloud>(*cloud_);
  for (; scans_ < session.scans().size(); ++scans_) {
    const PointCloud& hits = session.scans()[scans_]->hits;
    if (missed_) missed_->add(hits);
    const std::size_t stride = hits.size() / points_per_view + 1;
    for (std::size_t i = 0; i < hits.size(); i += stride) cloud->points.push_back(hits[i]);
    std::ranges::copy(viewed_normals(*session.scans()[scans_], stride), std::back_inserter(cloud->normals));
    cloud->views.resize(cloud->points.size(), static_cast<std::uint16_t>(scans_));
  }
  const std::size_t known = cloud->distances.size();
  if (surface_) {
    cloud->distances.resize(cloud->points.size());
    tbb::parallel_for(known, cloud->points.size(),
                      [&](std::size_t i) { cloud->distances[i] = static_cast<float>((*surface_)(cloud->points[i])); });
  }
  cloud_ = std::move(cloud);
}

std::shared_ptr<const MissedPicture> SeenSurface::missed() const {
  if (!missed_) return nullptr;
  return std::make_shared<MissedPicture>(
      MissedPicture{missed_->mesh(), {missed_->observed().begin(), missed_->observed().end()}});
}

}  // namespace nextview
