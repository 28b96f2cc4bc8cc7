#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "core/config/configuration.hpp"
#include "core/export/export_kind.hpp"
#include "core/session/camera_bookmarks.hpp"
#include "core/session/planning_config.hpp"
#include "core/session/untitled_sessions.hpp"

namespace nextview {

struct GibbsMap;

/// What is asked of the session worker.
namespace request {

/// Starts over with another configuration.
struct Load {
  Configuration configuration;
};
/// Starts over with another object, or, if the file is TOML, with its settings.
struct OpenFile {
  std::filesystem::path file;
};
/// Offers to go on with a session that nobody closed.
struct OfferSession {
  EarlierSession session;
};
/// Starts over with a live scanner.
struct Connect {
  std::string command;                              ///< the program that drives it, with its arguments
  bool confirm = true;                              ///< each move of a real robot
  std::optional<Configuration> configuration = {};  ///< none: that of now
};
/// Leaves the scanner, and goes back to what was scanned before it.
struct Disconnect {};
/// Reaches a lost scanner again; the scan goes on.
struct Reconnect {};
/// Changes when the scan is done, and keeps it.
struct SetTermination {
  TerminationConfig termination;
};
/// Changes when the scan is done, or what ranks which views, by one setting, and keeps the scan. All others are as they
/// are by then: of several that are changed while a view is taken none is lost.
struct ChangeSetting {
  std::string key, text;
};
/// Starts over with the same configuration.
struct Reset {};
struct Step {
  bool with_last = false;  ///< undone together with the change of the limits before it
};
/// Steps until the scan is finished or paused.
struct Play {};
/// The step that runs is still finished.
struct Pause {};
/// Makes a candidate the next view instead of the proposal.
struct TakeView {
  std::size_t candidate;
};
/// Makes a custom view the next.
struct TakeCustomView {
  Pose T_world_camera;
};
/// Goes back to before the last step or start; the scan is repeated up to there.
struct Undo {};
struct Redo {};
/// Goes to where a branch had so many views, or to its end.
struct GoTo {
  std::string branch;  ///< empty: the current one
  std::optional<std::size_t> views = {};
};
/// What is taken from here on is on another branch.
struct BeginBranch {
  std::string name;  ///< empty: the next that is free
};
struct RenameBranch {
  std::string name, to;
};
/// Its views stay in the session's folder.
struct RemoveBranch {
  std::string name;
};
/// Shows the end of another branch beside this one, or, view for view, where it had as many as this one has.
struct Compare {
  std::string branch;  ///< empty: no more
  bool view_for_view = false;
};
/// Keeps a place to look at the scene from, with the session.
struct KeepCamera {
  CameraBookmark camera;
};
struct RemoveCamera {
  std::string name;
};
/// Samples the Gibbs map of all views so far until it is stationary.
struct Refine {
  int chains = 2;
  int sweeps = 400;  ///< at most, of each chain
};
/// Writes what `nextview scan` writes.
struct Export {
  std::filesystem::path folder;
};
/// Writes one thing of the scan that needs no drawing.
struct ExportOne {
  ExportKind kind;
  std::filesystem::path file;
  SurfaceExport surface = {};
  /// The Gibbs map that is written, or whose surface is; null: the conventional map.
  std::shared_ptr<const GibbsMap> gibbs = {};
};
/// Forgets the curves of earlier runs.
struct ForgetRuns {};

}  // namespace request

using SessionRequest =
    std::variant<request::Load, request::OpenFile, request::OfferSession, request::Connect, request::Disconnect,
                 request::Reconnect, request::SetTermination, request::ChangeSetting, request::Reset, request::Step,
                 request::Play, request::Pause, request::TakeView, request::TakeCustomView, request::Undo,
                 request::Redo, request::GoTo, request::BeginBranch, request::RenameBranch, request::RemoveBranch,
                 request::Compare, request::KeepCamera, request::RemoveCamera, request::Refine, request::Export,
                 request::ExportOne, request::ForgetRuns>;

}  // namespace nextview
