#include "ui/layers/mesh_layer.hpp"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

#include "ui/layers/geometry.hpp"
#include "ui/shader_file.hpp"

namespace nextview {
namespace {

/// Smooth over shallow edges, sharp over steep ones.
constexpr double crease_angle = 35.0;  // [deg]

}  // namespace

MeshLayer::MeshLayer(vtkRenderer& renderer)
    : Layer(renderer),
      mapper_(vtkSmartPointer<vtkOpenGLPolyDataMapper>::New()),
      actor_(vtkSmartPointer<vtkActor>::New()) {
  mapper_->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->SetInterpolationToPhong();
  actor_->GetProperty()->SetAmbient(0.28);
  actor_->GetProperty()->SetDiffuse(0.85);
  actor_->GetProperty()->SetSpecular(0.1);
  actor_->GetProperty()->SetSpecularPower(24);
  add(*actor_);
}

void MeshLayer::show(const TriangleMesh& mesh, MeshStyle style) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(triangle_polydata(mesh));
  normals->SetFeatureAngle(crease_angle);
  normals->ConsistencyOff();
  normals->Update();
  mapper_->SetInputDataObject(normals->GetOutput());
  set_style(style);
  describe(corners(mesh.bounding_box()), {});
}

void MeshLayer::set_style(MeshStyle style) {
  vtkProperty& property = *actor_->GetProperty();
  vtkShaderProperty& shaders = *actor_->GetShaderProperty();
  shaders.ClearAllFragmentShaderReplacements();
  property.SetRepresentationToSurface();
  property.SetOpacity(1.0);
  set_colour(property, theme::object);
  if (style == MeshStyle::wire) {
    property.SetRepresentationToWireframe();
    property.SetLineWidth(1.0f);
    set_colour(property, theme::soft_ink);
  } else if (style == MeshStyle::ghost) {
    property.SetOpacity(0.5);  // sends it to VTK's translucent pass; the shader decides
    set_colour(property, theme::soft_ink);
    shaders.AddFragmentShaderReplacement("//VTK::Normal::Dec", true, "//VTK::Normal::Dec\n" + load_shader("ghost.glsl"),
                                         false);
    shaders.AddFragmentShaderReplacement(
        "//VTK::Light::Impl", true,
        "//VTK::Light::Impl\n  fragOutput0 = ghost(normalVCVSOutput, vertexVC.xyz, diffuseColor);\n", false);
  }
}

}  // namespace nextview
