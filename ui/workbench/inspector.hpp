#pragma once
#include <memory>

#include "ui/workbench/inspection.hpp"

namespace nextview {

/// Looks things up in snapshots. Not safe to use from two threads at once.
class Inspector {
 public:
  Inspection inspect(std::shared_ptr<const SessionSnapshot> session, const Selection& selection);

 private:
  ViewInspection inspect_view(const SessionSnapshot& session, const Selection& selection) const;
  VoxelInspection inspect_voxel(const SessionSnapshot& session, std::uint32_t voxel) const;
  void explain(const SessionSnapshot& session, ViewInspection& view) const;

  std::uint64_t count_ = 0;
};

}  // namespace nextview
