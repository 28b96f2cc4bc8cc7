#pragma once
#include <span>
#include <string>

#include "core/export/scan_surfaces.hpp"
#include "core/results/output_folder.hpp"

namespace nextview {

class RenderTarget;

/// Writes the surfaces and, where there is a target to draw in, a picture of each, as large as that; and prints a line
/// each. `name` of the object. Returns what it left in the folder, as lines for the list of files.
std::string write_and_print_surfaces(std::span<const ScanSurface> surfaces, const std::string& name, std::size_t views,
                                     OutputFolder& out, RenderTarget* target);

}  // namespace nextview
