#include <algorithm>
#include <cmath>

#include "ui/commands/command_list.hpp"

namespace nextview {
namespace {

using Names = std::vector<std::string>;

const Names object_styles = {"solid", "wire", "ghost"};
const Names cloud_colourings = {"single", "view", "height", "distance"};
const Names maps = {"conventional", "gibbs"};
const Names voxel_colourings = {"class", "probability", "entropy", "difference", "error"};
const Names axes = {"none", "x", "y", "z"};

/// A layer that is switched on and off.
Command toggle(const char* layer, const char* text, char key_name, bool LayerChoice::*shown) {
  return {std::string("toggle-") + layer,
          "Scene",
          std::string("Show ") + text,
          std::string("Shows or hides ") + text + ".",
          {},
          {{key(key_name)}},
          [shown](CommandTarget& t, const Arguments&) { t.window.layers.*shown = !(t.window.layers.*shown); },
          {},
          [shown](const WindowState& w) { return w.layers.*shown; }};
}

Command toggle_voxels(const char* which, const char* help, bool VoxelFilter::*shown) {
  return {
      std::string("toggle-") + which,
      "Scene",
      std::string("Voxels: ") + which,
      help,
      {},
      {},
      [shown](CommandTarget& t, const Arguments&) { t.window.layers.voxels.*shown = !(t.window.layers.voxels.*shown); },
      {},
      [shown](const WindowState& w) { return w.layers.voxels.*shown; }};
}

template <class Enum>
Command choose(const char* name, const char* text, const char* help, const char* argument, const Names& names,
               Enum LayerChoice::*member) {
  return {name,
          "Scene",
          std::string("Show ") + text,
          help,
          {choice(argument, help, names)},
          {},
          [&names, member](CommandTarget& t, const Arguments& a) {
            t.window.layers.*member = static_cast<Enum>(index_of(names, a.text(0)));
          }};
}

/// Across an axis, in the middle of the region of interest at first, a tenth of it thick.
void slice_axis(CommandTarget& t, const Arguments& a) {
  auto& slice = t.window.layers.voxels.slice;
  const int axis = static_cast<int>(index_of(axes, a.text(0))) - 1;
  if (axis < 0) return slice.reset();
  const double low = t.session.grid.lower()[axis], high = t.session.grid.upper()[axis];
  const double middle = (low + high) / 2, half = std::max((high - low) / 64, t.session.grid.resolution);
  slice = Slice{axis, middle - half, middle + half};
}

void slice_at(CommandTarget& t, const Arguments& a) {
  Slice& slice = *t.window.layers.voxels.slice;
  const double half = 0.5 * (a.count() > 1 ? a.number(1) : slice.high - slice.low);
  slice.low = a.number(0) - half;
  slice.high = a.number(0) + half;
}

std::vector<Command> voxel_commands() {
  const auto number = [](const char* name, const char* help, double low, double high) {
    return Argument{name, Argument::Kind::number, help, low, high};
  };
  return {
      choose("voxel-map", "Voxels of which map…", "Which map the voxels are of: conventional or Gibbs.", "map", maps,
             &LayerChoice::map),
      choose("voxel-colour", "Colour the voxels…", "What the voxels' colours say.", "by", voxel_colourings,
             &LayerChoice::colouring),
      toggle_voxels("occupied", "Shows or hides voxels of class occupied.", &VoxelFilter::occupied),
      toggle_voxels("unknown", "Shows or hides measured voxels that are neither occupied nor free.",
                    &VoxelFilter::unknown),
      toggle_voxels("free", "Shows or hides voxels of class free.", &VoxelFilter::free),
      toggle_voxels("uncertain", "Shows, instead of classes, the voxels of high entropy.", &VoxelFilter::uncertain),
      {"threshold",
       "Scene",
       "Unknown voxels from…",
       "Unknown voxels below this probability stay hidden.",
       {number("probability", "from 0 to 1", 0, 1)},
       {},
       [](CommandTarget& t, const Arguments& a) { t.window.layers.voxels.unknown_from = a.number(0); }},
      {"uncertain-from",
       "Scene",
       "Uncertain voxels from…",
       "The entropy from which a voxel counts as uncertain.",
       {number("entropy", "[nats], up to ln 2 = 0.693", 0, 0.6931)},
       {},
       [](CommandTarget& t, const Arguments& a) { t.window.layers.voxels.entropy_from = a.number(0); }},
      {"slice-axis",
       "Scene",
       "Slice across…",
       "Shows only a slice of the voxels, across an axis; none shows all.",
       {choice("axis", "x, y, z or none", axes)},
       {},
       slice_axis,
       needs_session},
      {"slice-at",
       "Scene",
       "Move the slice…",
       "Moves the slice along its axis.",
       {number("position", "of its middle [m]", -100, 100),
        {"thickness", Argument::Kind::number, "[m]", 1e-6, 100, {}, true}},
       {},
       slice_at,
       [](const CommandState& t) { return t.window.layers.voxels.slice ? "" : "choose an axis first (slice-axis)"; }},
  };
}

std::vector<Command> camera_commands() {
  return {
      {"frame",
       "Scene",
       "Frame all",
       "Frames all that is shown.",
       {},
       {{key('F')}},
       [](CommandTarget& t, const Arguments&) { t.window.camera_motions.push_back(camera_motion::Frame{}); }},
      {"look-from",
       "Scene",
       "Look from…",
       "Frames all that is shown, seen from this direction.",
       {{"azimuth", Argument::Kind::number, "from x towards y [deg]", -360, 360},
        {"elevation", Argument::Kind::number, "above the horizon [deg]", -89, 89}},
       {},
       [](CommandTarget& t, const Arguments& a) {
         t.window.camera_motions.push_back(camera_motion::LookFrom{a.number(0), a.number(1)});
       }},
      {"zoom",
       "Scene",
       "Nearer or farther…",
       "Moves the scene's camera nearer; negative steps move it away.",
       {{"steps", Argument::Kind::number, "of an eighth of the distance", -100, 100}},
       {},
       [](CommandTarget& t, const Arguments& a) {
         t.window.camera_motions.push_back(camera_motion::Zoom{a.number(0)});
       },
       {},
       {},
       true},
  };
}

}  // namespace

Argument choice(std::string name, std::string help, Names names) {
  return {std::move(name),
          Argument::Kind::choice,
          std::move(help),
          0,
          0,
          [names = std::move(names)](const SessionSnapshot&) { return names; }};
}

std::size_t index_of(const Names& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::vector<Command> scene_commands() {
  std::vector<Command> list = camera_commands();
  list.push_back(toggle("object", "the object", '1', &LayerChoice::object));
  list.push_back(toggle("cloud", "the point cloud", '2', &LayerChoice::cloud));
  list.push_back(toggle("octree", "the octree", '3', &LayerChoice::octree));
  list.push_back(toggle("views", "the candidate views and the path", '4', &LayerChoice::views));
  list.push_back(toggle("rays", "the rays of the view that is looked at", '5', &LayerChoice::rays));
  list.push_back(toggle("region", "the region of interest", '6', &LayerChoice::region));
  list.push_back(toggle("missed", "the missed surface, painted on the object", '7', &LayerChoice::missed));
  list.push_back(choose("object-style", "Draw the object…", "How the object is drawn.", "style", object_styles,
                        &LayerChoice::object_style));
  list.push_back(choose("cloud-colour", "Colour the points…", "What the points' colours say.", "by", cloud_colourings,
                        &LayerChoice::cloud_colouring));
  for (Command& command : voxel_commands()) list.push_back(std::move(command));
  list.push_back(
      {"lock-ranges",
       "Scene",
       "Lock the colour ranges",
       "Keeps the range of each colour legend from step to step.",
       {},
       {{key('L')}},
       [](CommandTarget& t, const Arguments&) { t.window.layers.ranges_locked = !t.window.layers.ranges_locked; },
       {},
       [](const WindowState& w) { return w.layers.ranges_locked; }});
  return list;
}

}  // namespace nextview
