#include "ui/drawing/shader_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "core/file/installation.hpp"

namespace nextview {
namespace {

/// GLSL knows no file names, and Mesa loses track of source numbers. So each file has a block of line numbers of its
/// own.
constexpr std::array shaders{"voxels_vertex.glsl",     "voxels.glsl",     "ghost.glsl",
                             "mesh_paint_vertex.glsl", "mesh_paint.glsl", "mesh_classes_vertex.glsl",
                             "mesh_classes.glsl",      "hatch.glsl"};
constexpr int lines_per_file = 10000;

/// Mesa's form: "source:line(column): error: …".
bool find_shader_error(const std::string& text, std::smatch& line_and_message) {
  return std::regex_search(text, line_and_message, std::regex(R"(\d+:(\d{1,6})\(\d+\): (error: [^\n]*))"));
}

}  // namespace

std::string load_shader(const std::string& name) { return load_shader(name, shared_folder("shaders")); }

std::string load_shader(const std::string& name, const std::filesystem::path& folder) {
  const auto known = std::find(shaders.begin(), shaders.end(), name);
  if (known == shaders.end()) throw std::runtime_error(fmt::format("shaders/{}: not listed in shader_file.cpp", name));
  const auto file = folder / name;
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (text.empty())
    throw std::runtime_error(fmt::format("{}: the shader is missing or empty; restore it", file.string()));
  // Up to GLSL 1.5, the line after "#line n" is line n + 1.
  return fmt::format("#line {}\n{}", lines_per_file * (1 + known - shaders.begin()), text);
}

bool is_shader_error(const std::string& vtk_errors) {
  std::smatch unused;
  return find_shader_error(vtk_errors, unused);
}

std::string explain_drawing_error(const std::string& vtk_errors) {
  std::smatch found;
  if (find_shader_error(vtk_errors, found)) {
    const int line = std::stoi(found[1]), file = line / lines_per_file - 1;
    if (file >= 0 && file < int(shaders.size())) {
      return fmt::format("shaders/{}:{}: {}", shaders[file], line % lines_per_file, found[2].str());
    }
    return "a shader of VTK's with our additions does not compile: " + found[2].str();
  }
  return "drawing failed: " + vtk_errors.substr(0, vtk_errors.find("\n\n"));
}

}  // namespace nextview
