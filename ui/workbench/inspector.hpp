#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "core/gain/map_rays.hpp"
#include "ui/workbench/inspection.hpp"

namespace nextview {

/// Looks things up in snapshots. Not safe to use from two threads at once.
class Inspector {
 public:
  Inspection inspect(std::shared_ptr<const SessionSnapshot> session, const Selection& selection);

 private:
  ViewInspection inspect_view(const SessionSnapshot& session, const Selection& selection);
  VoxelInspection inspect_voxel(const SessionSnapshot& session, std::uint32_t voxel) const;
  const RayCaster& caster(const SessionSnapshot& session);
  void explain(const SessionSnapshot& session, ViewInspection& view);

  std::uint64_t count_ = 0;
  std::optional<MapRays> rays_;
  std::unique_ptr<ReferenceMap> reference_;                   ///< reference semantics only
  std::vector<std::shared_ptr<const Scan>> reference_scans_;  ///< that it holds
  std::uint64_t reference_session_ = 0;
};

}  // namespace nextview
