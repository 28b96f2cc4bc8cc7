#pragma once
#include "core/export/export_kind.hpp"
#include "ui/commands/command.hpp"
#include "ui/workbench/layer_choice.hpp"

namespace nextview {

/// What of a surface is written: what was seen, or also what closes it, into a file of its own.
enum class SurfacePart { seen, all };
enum class Background { opaque, transparent };

namespace command {

// One thing of the scan, where to: a file whose ending says the format (export_entries()).
extern const CommandOf<std::string> export_cloud, export_views;
extern const CommandOf<std::string, std::optional<MapChoice>> export_map;  ///< else the one that is shown
extern const CommandOf<std::string, std::optional<SurfaceSource>, std::optional<SurfacePart>> export_surface;
extern const CommandOf<std::string, std::optional<std::string>, std::optional<Background>> export_curves,
    export_picture;  ///< size, as "1920x1080"
extern const CommandOf<std::string, std::optional<int>, std::optional<std::string>, std::optional<Background>>
    export_turntable;                                                          ///< number of frames, and their size
extern const CommandOf<std::string, std::optional<std::string>> save_picture;  ///< of the window; likewise

}  // namespace command
}  // namespace nextview
