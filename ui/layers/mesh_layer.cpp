#include "ui/layers/mesh_layer.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "ui/drawing/shader_file.hpp"
#include "ui/layers/coarse_mesh.hpp"
#include "ui/layers/geometry.hpp"

namespace nextview {
namespace {

/// More triangles than a software renderer draws while the camera moves, and the cells along the longest side that
/// they are gathered in then.
constexpr vtkIdType many_triangles = 150'000;
constexpr int coarse_cells = 72;

constexpr double specular = 0.1;
constexpr int paint_stops = 17;  // of the colours in shaders/mesh_paint.glsl
constexpr int max_classes = 4;   // in shaders/mesh_classes.glsl
const Colour no_value = mix(theme::object, theme::paper, 0.25), no_value_stripes = mix(theme::object, theme::ink, 0.4);

bool has_value(const MeshPaint& paint, std::size_t vertex) {
  return paint.has_value.empty() || paint.has_value[vertex] != 0;
}

void check(const TriangleMesh& mesh, const MeshPaint& paint) {
  const std::size_t vertices = mesh.vertices.size();
  if (paint.values.size() != vertices || (!paint.has_value.empty() && paint.has_value.size() != vertices))
    throw std::invalid_argument(fmt::format("painted mesh: {} vertices, but {} values and {} marks", vertices,
                                            paint.values.size(), paint.has_value.size()));
  for (std::size_t i = 0; i < vertices; ++i)
    if (has_value(paint, i) && !std::isfinite(paint.values[i]))
      throw std::invalid_argument(fmt::format("painted mesh: the value of vertex {} is not finite", i));
  if (!(paint.low < paint.high))
    throw std::invalid_argument(fmt::format("painted mesh: no range from {} to {}", paint.low, paint.high));
}

/// The vertex attribute "paint": (place in the range from 0 to 1, 1), or (0, 0) without a value.
vtkSmartPointer<vtkFloatArray> paint_attribute(const MeshPaint& paint) {
  auto attribute = vtkSmartPointer<vtkFloatArray>::New();
  attribute->SetName("paint");
  attribute->SetNumberOfComponents(2);
  attribute->SetNumberOfTuples(vtkIdType(paint.values.size()));
  for (std::size_t i = 0; i < paint.values.size(); ++i) {
    const bool painted = has_value(paint, i);
    const double place = (paint.values[i] - paint.low) / (paint.high - paint.low);
    attribute->SetTuple2(vtkIdType(i), painted ? std::clamp(place, 0.0, 1.0) : 0.0, painted ? 1.0 : 0.0);
  }
  return attribute;
}

void set_palette(vtkUniforms& uniforms, const ColourMap& map) {
  float colours[paint_stops][3], without[2][3];
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < paint_stops; ++i) colours[i][c] = float(map.at(i / double(paint_stops - 1))[c]);
    without[0][c] = float(no_value[c]);
    without[1][c] = float(no_value_stripes[c]);
  }
  uniforms.SetUniform3fv("range_colours", paint_stops, colours);
  uniforms.SetUniform3fv("no_value_colours", 2, without);
}

void check(const TriangleMesh& mesh, const MeshClasses& classes) {
  if (classes.classes.size() != mesh.vertices.size())
    throw std::invalid_argument(
        fmt::format("painted mesh: {} vertices, but {} classes", mesh.vertices.size(), classes.classes.size()));
  if (classes.palette.empty() || classes.palette.size() > max_classes)
    throw std::invalid_argument(fmt::format("painted mesh: a palette of {} classes", classes.palette.size()));
  for (const std::uint8_t vertex_class : classes.classes)
    if (vertex_class >= classes.palette.size())
      throw std::invalid_argument(fmt::format("painted mesh: class {} is not in the palette", vertex_class));
}

/// The vertex attribute "class_weights": 1 for the vertex' class.
vtkSmartPointer<vtkFloatArray> class_attribute(const MeshClasses& classes) {
  auto attribute = vtkSmartPointer<vtkFloatArray>::New();
  attribute->SetName("class_weights");
  attribute->SetNumberOfComponents(max_classes);
  attribute->SetNumberOfTuples(vtkIdType(classes.classes.size()));
  attribute->Fill(0.0);
  for (std::size_t i = 0; i < classes.classes.size(); ++i)
    attribute->SetTypedComponent(vtkIdType(i), classes.classes[i], 1.0f);
  return attribute;
}

void set_palette(vtkUniforms& uniforms, const std::vector<MeshClass>& palette) {
  float colours[max_classes][3] = {};
  for (std::size_t i = 0; i < palette.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) colours[i][c] = float(palette[i].colour[c]);
  uniforms.SetUniform3fv("mesh_class_colours", max_classes, colours);
}

Legend legend_of(const MeshClasses& classes) {
  Legend legend{classes.title, {}, {}};
  for (std::size_t i = 0; i < classes.palette.size(); ++i) {
    if (std::find(classes.classes.begin(), classes.classes.end(), i) != classes.classes.end())
      legend.swatches.push_back({classes.palette[i].name, classes.palette[i].colour});
  }
  return legend;
}

Legend legend_of(const MeshPaint& paint) {
  Legend legend{
      paint.title, {}, Legend::Range{paint.map, paint.low, paint.high, paint.unit, paint.low_name, paint.high_name}};
  if (std::count(paint.has_value.begin(), paint.has_value.end(), 0) > 0)
    legend.swatches.push_back({paint.no_value_name, no_value, no_value_stripes});
  return legend;
}

}  // namespace

MeshLayer::MeshLayer(vtkRenderer& renderer)
    : Layer(renderer),
      full_(vtkSmartPointer<vtkOpenGLPolyDataMapper>::New()),
      coarse_(vtkSmartPointer<vtkOpenGLPolyDataMapper>::New()),
      actor_(vtkSmartPointer<vtkActor>::New()) {
  for (vtkOpenGLPolyDataMapper* mapper : {full_.Get(), coarse_.Get()}) {
    mapper->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
    add_instead(*mapper);
  }
  actor_->SetMapper(full_);
  actor_->GetProperty()->SetInterpolationToPhong();
  actor_->GetProperty()->SetAmbient(0.28);
  actor_->GetProperty()->SetDiffuse(0.85);
  actor_->GetProperty()->SetSpecularPower(24);
  add(*actor_);
}

void MeshLayer::take(vtkSmartPointer<vtkPolyData> polydata) {
  if (polydata.Get() == full_->GetInputDataObject(0, 0)) return;
  coarse_->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  full_->SetInputDataObject(polydata);
  has_coarse_ = false;
  set_coarse(wants_coarse_);
}

/// It is made when it is wanted first: pictures that nobody moves need none.
void MeshLayer::set_coarse(bool wants_coarse) {
  wants_coarse_ = wants_coarse;
  auto& polydata = *vtkPolyData::SafeDownCast(full_->GetInputDataObject(0, 0));
  const bool is_drawn = wants_coarse && polydata.GetNumberOfPolys() > many_triangles;
  if (is_drawn && !std::exchange(has_coarse_, true)) coarse_->SetInputDataObject(coarse(polydata, coarse_cells));
  actor_->SetMapper(is_drawn ? coarse_ : full_);
}

void MeshLayer::show(const TriangleMesh& mesh, MeshStyle style) {
  take(shaded_.of(mesh));
  set_style(style);
  describe(mesh.vertices.empty() ? std::vector<Vector3>{} : corners(mesh.bounding_box()), {});
}

void MeshLayer::show(const TriangleMesh& mesh, const MeshPaint& paint) {
  check(mesh, paint);
  take(shaded_.of(mesh, paint_attribute(paint)));
  paint_with("paint", "mesh_paint_vertex.glsl", "mesh_paint.glsl");
  set_palette(*actor_->GetShaderProperty()->GetFragmentCustomUniforms(), paint.map);
  const bool empty = mesh.vertices.empty();
  describe(corners(mesh.bounding_box()), empty ? std::vector<Legend>{} : std::vector<Legend>{legend_of(paint)});
}

void MeshLayer::show(const TriangleMesh& mesh, const MeshClasses& classes) {
  check(mesh, classes);
  take(shaded_.of(mesh, class_attribute(classes)));
  paint_with("class_weights", "mesh_classes_vertex.glsl", "mesh_classes.glsl");
  set_palette(*actor_->GetShaderProperty()->GetFragmentCustomUniforms(), classes.palette);
  const bool empty = mesh.vertices.empty();
  describe(corners(mesh.bounding_box()), empty ? std::vector<Legend>{} : std::vector<Legend>{legend_of(classes)});
}

void MeshLayer::paint_with(const std::string& attribute, const std::string& vertex_shader,
                           const std::string& fragment_shader) {
  set_style(MeshStyle::solid);
  for (vtkOpenGLPolyDataMapper* mapper : {full_.Get(), coarse_.Get()})
    mapper->MapDataArrayToVertexAttribute(attribute.c_str(), attribute.c_str(), vtkDataObject::FIELD_ASSOCIATION_POINTS,
                                          -1);
  actor_->GetProperty()->SetSpecular(0.0);  // a gleam would look like another value
  vtkShaderProperty& shaders = *actor_->GetShaderProperty();
  shaders.AddVertexShaderReplacement("//VTK::Normal::Dec", true, "//VTK::Normal::Dec\n" + load_shader(vertex_shader),
                                     false);
  shaders.AddVertexShaderReplacement("//VTK::Normal::Impl", true, "//VTK::Normal::Impl\n  pass_paint();\n", false);
  shaders.AddFragmentShaderReplacement("//VTK::Normal::Dec", true,
                                       "//VTK::Normal::Dec\n" + load_shader(fragment_shader), false);
  shaders.AddFragmentShaderReplacement(
      "//VTK::Color::Impl", true,
      "//VTK::Color::Impl\n  diffuseColor = 0.54 * paint_colour();\n  ambientColor = 0.54 * paint_colour();\n", false);
  on_scale();
}

void MeshLayer::on_scale() {
  actor_->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf("pixel_scale", float(scale()));
}

void MeshLayer::set_style(MeshStyle style) {
  vtkProperty& property = *actor_->GetProperty();
  vtkShaderProperty& shaders = *actor_->GetShaderProperty();
  for (vtkOpenGLPolyDataMapper* mapper : {full_.Get(), coarse_.Get()}) mapper->RemoveAllVertexAttributeMappings();
  shaders.ClearAllVertexShaderReplacements();
  shaders.ClearAllFragmentShaderReplacements();
  shaders.GetFragmentCustomUniforms()->RemoveAllUniforms();
  property.SetRepresentationToSurface();
  property.SetOpacity(1.0);
  property.SetSpecular(specular);
  set_colour(property, theme::object);
  describe({outline().begin(), outline().end()}, {});
  if (style == MeshStyle::wire) {
    property.SetRepresentationToWireframe();
    property.SetLineWidth(float(scale()));
    set_colour(property, tone(theme::soft_ink));
  } else if (style == MeshStyle::ghost) {
    property.SetOpacity(0.5);  // sends it to VTK's translucent pass; the shader decides
    set_colour(property, tone(theme::soft_ink));
    shaders.AddFragmentShaderReplacement("//VTK::Normal::Dec", true, "//VTK::Normal::Dec\n" + load_shader("ghost.glsl"),
                                         false);
    shaders.AddFragmentShaderReplacement(
        "//VTK::Light::Impl", true,
        "//VTK::Light::Impl\n  fragOutput0 = ghost(normalVCVSOutput, vertexVC.xyz, diffuseColor);\n", false);
  }
}

}  // namespace nextview
