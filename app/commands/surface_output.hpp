#pragma once
#include <span>
#include <string>

#include "core/export/scan_surfaces.hpp"
#include "core/results/output_folder.hpp"

namespace nextview {

/// Writes the surfaces and, with `pictures`, a picture of each, and prints a line each. `name` of the object. Returns
/// what it left in the folder, as lines for the list of files.
std::string write_and_print_surfaces(std::span<const ScanSurface> surfaces, const std::string& name, std::size_t views,
                                     OutputFolder& out, bool pictures);

}  // namespace nextview
