#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/view/pose.hpp"
#include "ui/layers/styles.hpp"
#include "ui/layers/voxel_filter.hpp"
#include "ui/window/candidate_order.hpp"

namespace nextview {

enum class MapChoice { conventional, gibbs };

/// What of a session the scene shows, and how.
struct LayerChoice {
  bool object = true, cloud = true, octree = true, views = true, rays = true, region = true, missed = false;
  MeshStyle object_style = MeshStyle::ghost;
  CloudColouring cloud_colouring = CloudColouring::single;
  MapChoice map = MapChoice::conventional;
  VoxelColouring colouring = VoxelColouring::by_class;
  VoxelFilter voxels;
  bool ranges_locked = false;  ///< colour ranges stay as they were when this was switched on
};

/// The view that the view panel shows and that rays are drawn of.
struct LookedAt {
  enum class Kind { next, candidate, taken, own };
  Kind kind = Kind::next;
  std::size_t index = 0;  ///< of the candidate, or of the step, from 0

  bool operator==(const LookedAt&) const = default;
  bool is(Kind k, std::size_t i) const { return kind == k && index == i; }
};

/// What a person has picked.
struct Selection {
  LookedAt view;
  std::optional<std::uint32_t> voxel;
  std::optional<std::size_t> ray;  ///< of the view that is looked at
  std::optional<Pose> own_view;    ///< T_world_camera of a view of one's own, before it is taken

  std::optional<std::size_t> candidate() const {
    return view.kind == LookedAt::Kind::candidate ? std::optional(view.index) : std::nullopt;
  }
  bool operator==(const Selection& other) const {
    const bool same_own_view = own_view ? other.own_view && own_view->isApprox(*other.own_view) : !other.own_view;
    return view == other.view && voxel == other.voxel && ray == other.ray && same_own_view;
  }
};

/// Panels; those of a side share its place, one in front.
enum class PanelName { session, layers, candidates, view, inspector, gibbs, curves, log, count };
enum class Side { left, right, bottom };
constexpr Side side_of(PanelName panel) {
  return panel <= PanelName::layers ? Side::left : panel <= PanelName::gibbs ? Side::right : Side::bottom;
}

/// As commands name them, in the order of PanelName.
std::span<const std::string> panel_names();

enum class CurveKind { entropy, coverage, divergence, gain, time };

/// What the scene's camera is to do.
namespace camera_motion {
struct Frame {};
struct LookFrom {
  double azimuth, elevation;  ///< [deg]
};
struct LookThrough {
  Pose T_world_camera;
};
struct Zoom {
  double steps;
};
}  // namespace camera_motion
using CameraMotion =
    std::variant<camera_motion::Frame, camera_motion::LookFrom, camera_motion::LookThrough, camera_motion::Zoom>;

/// Everything that is the window's own and not the session's; only commands change it.
struct WindowState {
  LayerChoice layers;
  Selection selection;
  std::array<PanelName, 3> front = {PanelName::session, PanelName::candidates, PanelName::curves};  ///< by Side
  Side open = Side::right;  ///< the side whose panels were asked for last: it is shown where there is room for one
  std::array<CurveKind, 2> curves = {CurveKind::entropy, CurveKind::coverage};  ///< left and right plot
  CandidateColumn sort_column = CandidateColumn::utility;
  bool sort_ascending = false;
  bool palette_open = false, shortcuts_open = false;
  std::string palette_text;  ///< what the palette starts with
  bool quit = false;

  Pose scene_camera = Pose::Identity();      ///< where the scene is looked at from; kept by the scene
  std::vector<CameraMotion> camera_motions;  ///< to be made
  std::optional<std::string> picture_file;   ///< the window's picture is to be written here
  std::vector<std::string> script;           ///< the commands so far, a line each

  PanelName in_front(Side side) const { return front[static_cast<std::size_t>(side)]; }
  void bring_to_front(PanelName panel) {
    open = side_of(panel);
    front[static_cast<std::size_t>(open)] = panel;
  }
};

}  // namespace nextview
