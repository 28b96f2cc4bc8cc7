#include <gmock/gmock.h>
#include <unistd.h>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>

#include <fstream>

#include "core/file/installation.hpp"
#include "tests/render/samples.hpp"
#include "ui/drawing/shader_file.hpp"
#include "ui/layers/geometry.hpp"
#include "ui/render_target/offscreen_target.hpp"
#include "ui/scene/scene.hpp"

namespace nextview {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Shaders, AMissingFileIsNamed) {
  try {
    load_shader("voxels.glsl", "/nowhere");
    FAIL() << "loaded from nowhere";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/voxels.glsl"));
  }
}

TEST(Shaders, AnErrorIsTracedToItsFileAndLine) {
  const auto folder = std::filesystem::temp_directory_path() / ("nextview-shaders-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "ghost.glsl") << "// A comment.\nfloat wrong() {\n  return colour_that_is_not_declared;\n}\n";
  const std::string shader = load_shader("ghost.glsl", folder);
  std::filesystem::remove_all(folder);

  OffscreenTarget target(64, 64);
  Scene scene;
  scene.attach(target);
  vtkNew<vtkOpenGLPolyDataMapper> mapper;
  mapper->SetInputDataObject(triangle_polydata(samples::torus()));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Normal::Dec", true, "//VTK::Normal::Dec\n" + shader,
                                                           false);
  scene.renderer().AddActor(actor);
  try {
    target.render();
    FAIL() << "compiled";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), StartsWith("shaders/ghost.glsl:3: error:"));
    EXPECT_THAT(error.what(), HasSubstr("colour_that_is_not_declared"));
  }
}

/// As Mesa says it, of a line of a shader's text, counted from what the text says of its first one.
std::string error_in(const std::string& shader, int line) {
  const int before = std::stoi(shader.substr(std::string("#line ").size()));
  return "ERROR: In a.cxx\n0:" + std::to_string(before + line) + "(3): error: `x' undeclared\n0:1(1): error: more\n";
}

TEST(Shaders, EachFilesLinesAreItsOwn) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shared_folder("shaders"))) {
    const std::string name = entry.path().filename();
    const std::string shader = load_shader(name);
    EXPECT_THAT(shader, StartsWith("#line "));
    for (const int line : {1, 7, 9999}) {
      const std::string error = error_in(shader, line);
      EXPECT_TRUE(is_shader_error(error));
      EXPECT_EQ(explain_drawing_error(error),
                "shaders/" + name + ":" + std::to_string(line) + ": error: `x' undeclared");
    }
    ++files;
  }
  EXPECT_GT(files, 5u);
  EXPECT_THROW(load_shader("of_somebody_else.glsl"), std::runtime_error);
}

TEST(Shaders, ALineOfNoFileIsOfVtksOwnShader) {
  for (const char* line : {"12", "999999"}) {
    const std::string error = std::string("0:") + line + "(3): error: `x' undeclared\n";
    EXPECT_TRUE(is_shader_error(error));
    EXPECT_EQ(explain_drawing_error(error),
              "a shader of VTK's with our additions does not compile: error: `x' undeclared");
  }
  EXPECT_FALSE(is_shader_error("0:12(3): warning: `x' is not used"));
}

TEST(Shaders, OtherErrorsOfVtkAreKept) {
  EXPECT_EQ(explain_drawing_error("ERROR: no more memory\n\n"), "drawing failed: ERROR: no more memory");
}

}  // namespace
}  // namespace nextview
