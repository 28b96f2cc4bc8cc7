#include "ui/layers/section_layer.hpp"

#include <vtkActor.h>
#include <vtkContourTriangulator.h>
#include <vtkCutter.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkStripper.h>
#include <vtkUniforms.h>

#include "ui/drawing/shader_file.hpp"
#include "ui/layers/geometry.hpp"

namespace nextview {
namespace {

/// A plane through vertices or along faces cuts nothing well: it is moved by this share of the mesh's size.
constexpr double aside = 1e-6;

/// The lines where a section cuts a mesh.
vtkSmartPointer<vtkPolyData> cut(const TriangleMesh& mesh, const Section& section) {
  const double size = mesh.bounding_box().diagonal().norm();
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(Vector3(section.origin() + aside * size * section.inward()).data());
  plane->SetNormal(section.inward().data());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(triangle_polydata(mesh));
  cutter->SetCutFunction(plane);
  cutter->GenerateCutScalarsOff();
  vtkNew<vtkStripper> joined;
  joined->SetInputConnection(cutter->GetOutputPort());
  joined->JoinContiguousSegmentsOn();
  joined->Update();
  return joined->GetOutput();
}

vtkSmartPointer<vtkPolyData> filled(vtkPolyData* lines) {
  vtkNew<vtkContourTriangulator> triangulator;
  triangulator->SetInputData(lines);
  triangulator->TriangulationErrorDisplayOff();
  triangulator->Update();
  return triangulator->GetOutput();
}

}  // namespace

SectionLayer::SectionLayer(vtkRenderer& renderer)
    : Layer(renderer),
      inside_mapper_(vtkSmartPointer<vtkOpenGLPolyDataMapper>::New()),
      inside_(vtkSmartPointer<vtkActor>::New()),
      outline_(make_lines(1.5)),
      surface_(make_lines(2.5)) {
  inside_mapper_->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  inside_->SetMapper(inside_mapper_);
  inside_->GetProperty()->LightingOff();
  set_colour(*inside_->GetProperty(), theme::cut);
  vtkShaderProperty& shaders = *inside_->GetShaderProperty();
  shaders.AddFragmentShaderReplacement("//VTK::Normal::Dec", true, "//VTK::Normal::Dec\n" + load_shader("hatch.glsl"),
                                       false);
  shaders.AddFragmentShaderReplacement(
      "//VTK::Light::Impl", true,
      "//VTK::Light::Impl\n  fragOutput0.rgb = hatched(fragOutput0.rgb, gl_FragCoord.xy);\n", false);
  on_scale();
  add(*inside_);
}

SectionLayer::Lines SectionLayer::make_lines(double width) {
  Lines lines{vtkSmartPointer<vtkPolyDataMapper>::New(), vtkSmartPointer<vtkActor>::New()};
  lines.mapper->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  lines.mapper->SetResolveCoincidentTopologyToPolygonOffset();
  lines.actor->SetMapper(lines.mapper);
  lines.actor->GetProperty()->LightingOff();
  lines.actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  add(*lines.actor);
  return lines;
}

void SectionLayer::on_scale() {
  inside_->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf("pixel_scale", float(scale()));
}

void SectionLayer::show(const Section& section, const TriangleMesh* object, const TriangleMesh* surface) {
  clear();
  Legend legend{"section", {}, {}};
  std::vector<Vector3> points;
  if (object && !object->triangles.empty()) {
    const auto lines = cut(*object, section);
    outline_.mapper->SetInputDataObject(lines);
    inside_mapper_->SetInputDataObject(filled(lines));
    set_colour(*outline_.actor->GetProperty(), tone(theme::ink));
    if (lines->GetNumberOfPoints() > 0)
      legend.swatches.push_back({"inside of the object", theme::cut, theme::soft_ink});
  }
  if (surface && !surface->triangles.empty()) {
    const auto lines = cut(*surface, section);
    surface_.mapper->SetInputDataObject(lines);
    set_colour(*surface_.actor->GetProperty(), theme::reconstructed);
    if (lines->GetNumberOfPoints() > 0) legend.swatches.push_back({"reconstructed surface", theme::reconstructed});
  }
  std::vector<Legend> legends;
  if (!legend.swatches.empty()) legends.push_back(std::move(legend));
  describe({}, std::move(legends));
}

void SectionLayer::clear() {
  for (vtkPolyDataMapper* mapper : {outline_.mapper.Get(), surface_.mapper.Get()})
    mapper->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  inside_mapper_->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  describe({}, {});
}

}  // namespace nextview
