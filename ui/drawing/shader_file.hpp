#pragma once
#include <filesystem>
#include <string>

namespace nextview {

/// The text of shaders/<name>. It starts with a #line directive, so that the compiler's errors can be traced to the
/// file.
/// @throws std::runtime_error naming the file if it is missing or empty.
std::string load_shader(const std::string& name);
std::string load_shader(const std::string& name, const std::filesystem::path& folder);

/// One line for people from what VTK says when drawing fails: "shaders/voxels.glsl:12: error: …" if it is one of our
/// shaders.
std::string explain_drawing_error(const std::string& vtk_errors);

/// Whether that holds a shader compiler's error.
bool is_shader_error(const std::string& vtk_errors);

}  // namespace nextview
