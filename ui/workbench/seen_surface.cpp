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
  reference_ = std::make_shared<Reference>(Reference{session.mesh(), session.configuration().evaluation.d_reg});
}

void SeenSurface::follow(std::span<const std::shared_ptr<const Scan>> scans) {
  if (scans_ == scans.size()) return;
  const auto stride = [&](std::size_t scan) { return scans[scan]->hits.size() / points_per_view + 1; };
  std::vector<std::vector<Eigen::Vector3f>> normals(scans.size());
  tbb::parallel_for(scans_, scans.size(),
                    [&](std::size_t scan) { normals[scan] = viewed_normals(*scans[scan], stride(scan)); });
  auto cloud = std::make_shared<SeenCloud>(*cloud_);
  for (std::size_t scan = scans_; scan < scans.size(); ++scan) {
    const PointCloud& hits = scans[scan]->hits;
    for (std::size_t i = 0; i < hits.size(); i += stride(scan)) cloud->points.push_back(hits[i]);
    std::ranges::copy(normals[scan], std::back_inserter(cloud->normals));
    cloud->views.resize(cloud->points.size(), static_cast<std::uint16_t>(scan));
  }
  cloud_ = std::move(cloud);
  scans_ = scans.size();
}

void SeenSurface::compare(std::span<const std::shared_ptr<const Scan>> scans) {
  if (!reference_) return;
  Reference& reference = *reference_;
  if (!reference.distance) reference.distance.emplace(*reference.mesh);
  if (!reference.nothing_seen) reference.nothing_seen.emplace(*reference.mesh, reference.d_reg);
  if (!missed_) missed_ = reference.nothing_seen;
  if (compared_ == scans_) return;
  PointCloud hits;
  for (const auto& scan : scans.first(scans_).subspan(compared_))
    hits.insert(hits.end(), scan->hits.begin(), scan->hits.end());
  missed_->add(hits);
  auto cloud = std::make_shared<SeenCloud>(*cloud_);
  const std::size_t known = cloud->distances.size();
  cloud->distances.resize(cloud->points.size());
  tbb::parallel_for(known, cloud->points.size(), [&](std::size_t i) {
    cloud->distances[i] = static_cast<float>((*reference.distance)(cloud->points[i]));
  });
  cloud_ = std::move(cloud);
  compared_ = scans_;  // last: where memory runs out before, all of it is done again
}

std::shared_ptr<const MissedPicture> SeenSurface::missed() const {
  if (!missed_) return nullptr;
  return std::make_shared<MissedPicture>(
      MissedPicture{missed_->mesh(), {missed_->observed().begin(), missed_->observed().end()}});
}

}  // namespace nextview
