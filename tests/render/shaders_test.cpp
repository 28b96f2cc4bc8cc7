#include <gmock/gmock.h>
#include <unistd.h>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>

#include <fstream>

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

TEST(Shaders, OtherErrorsOfVtkAreKept) {
  EXPECT_EQ(explain_drawing_error("ERROR: no more memory\n\n"), "drawing failed: ERROR: no more memory");
}

}  // namespace
}  // namespace nextview
