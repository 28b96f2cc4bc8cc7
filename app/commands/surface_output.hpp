#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "core/session/scan_surfaces.hpp"

namespace nextview {

/// Writes the surfaces and, with `pictures`, a picture of each, and prints a line each. `name` of the object.
void write_and_print_surfaces(std::span<const ScanSurface> surfaces, const std::string& name, std::size_t views,
                              const std::filesystem::path& out, bool pictures);

/// What it leaves in the folder, for the list of files.
inline constexpr const char* surface_files =
    "  surface_*.ply, surface_*.stl, surface_*.png, surfaces.json   the surfaces: PLY in metres, STL in millimetres\n";

}  // namespace nextview
