#pragma once
#include <filesystem>
#include <string_view>

#include "core/surface/surface.hpp"

namespace nextview {

/// Writes a binary STL in millimetres, which is what CAD programs and slicers take STL for. Triangles without area are
/// left out. `remark`, of at most 40 bytes, goes into the header.
/// @throws std::invalid_argument if no triangle has an area, a coordinate is not finite (in millimetres) or an index is
///         out of range; std::runtime_error naming the file and the reason if it cannot be written.
void write_stl(const TriangleMesh& mesh, const std::filesystem::path& file, std::string_view remark = {});

/// Writes a binary little-endian PLY in metres with the surface's uncertainty [m] and whether it was seen as properties
/// of the vertices, coloured by uncertainty: from 0, dark blue, to what 95 % of the seen vertices do not exceed,
/// yellow; grey where not seen. Comments in the file say so, with the range, and how much was
/// seen.
/// @throws std::invalid_argument if the surface has no triangles, a coordinate is not finite, an index is out of range,
///         or there is not for every vertex an uncertainty (finite, at least 0) and a mark whether it was seen;
///         std::runtime_error naming the file and the reason if it cannot be written.
void write_ply(const Surface& surface, const std::filesystem::path& file);

}  // namespace nextview
