#pragma once
#include <memory>
#include <optional>
#include <stop_token>

#include "core/export/reconstruction.hpp"
#include "ui/workbench/layer_choice.hpp"
#include "ui/workbench/session_snapshot.hpp"

namespace nextview {

/// Which surface is asked for.
struct SurfaceQuestion {
  std::shared_ptr<const SessionSnapshot> session;
  SurfaceSource source = SurfaceSource::cloud;
  MapChoice map = MapChoice::conventional;  ///< that it is of, if it is a map's

  /// The other one's answer holds for this, too.
  bool same_as(const SurfaceQuestion& other) const;
};

/// The surface that the views so far make.
struct FoundSurface {
  SurfaceQuestion of;  ///< without a session: there is none yet
  ScanSurface found;
};

/// Of the surface that is being made.
struct SurfaceJob {
  double fraction = 0.0;               ///< 0 to 1
  std::optional<double> seconds_left;  ///< as it has gone so far; whole seconds

  bool operator==(const SurfaceJob&) const = default;
};

/// Null if stopped.
std::shared_ptr<const FoundSurface> find_surface(const SurfaceQuestion& question, const Progress& progress,
                                                 const std::stop_token& stop);

}  // namespace nextview
