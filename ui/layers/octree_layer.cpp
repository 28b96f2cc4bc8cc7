#include "ui/layers/octree_layer.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include "ui/shader_file.hpp"

namespace nextview {
namespace {

/// Stops of the probability colours in shaders/voxels.glsl.
constexpr int probability_stops = 9;

/// One quad a face. The vertex attribute "voxel" is (position in the face: u, v; probability; class).
vtkSmartPointer<vtkPolyData> face_polydata(const VoxelGrid& grid, std::span<const Voxel> voxels,
                                           std::span<const VoxelFace> faces) {
  const auto vertices = vtkIdType(faces.size()) * 4;
  vtkNew<vtkFloatArray> positions, normals, attributes;
  for (auto* array : {positions.Get(), normals.Get(), attributes.Get()}) {
    array->SetNumberOfComponents(array == attributes.Get() ? 4 : 3);
    array->SetNumberOfTuples(vertices);
  }
  attributes->SetName("voxel");
  vtkNew<vtkCellArray> quads;
  quads->AllocateEstimate(vtkIdType(faces.size()), 4);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto corner_points = face_corners(grid, faces[f]);
    const Vector3 normal = face_normal(faces[f]);
    const Voxel& voxel = voxels[faces[f].voxel];
    const auto first = vtkIdType(f) * 4;
    for (int corner = 0; corner < 4; ++corner) {
      positions->SetTuple(first + corner, corner_points[corner].data());
      normals->SetTuple(first + corner, normal.data());
      attributes->SetTuple4(first + corner, corner == 1 || corner == 2, corner >= 2, voxel.probability,
                            static_cast<double>(voxel.voxel_class));
    }
    quads->InsertNextCell({first, first + 1, first + 2, first + 3});
  }
  vtkNew<vtkPoints> points;
  points->SetData(positions);
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(quads);
  result->GetPointData()->SetNormals(normals);
  result->GetPointData()->AddArray(attributes);
  return result;
}

void set_palette(vtkUniforms& uniforms) {
  float classes[3][3], probabilities[probability_stops][3];
  const std::array class_colours{theme::unknown, theme::free, theme::occupied};  // in the order of VoxelClass
  const ColourMap map = ColourMap::probability();
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < 3; ++i) classes[i][c] = float(class_colours[i][c]);
    for (int i = 0; i < probability_stops; ++i) {
      probabilities[i][c] = float(map.at(i / double(probability_stops - 1))[c]);
    }
  }
  uniforms.SetUniform3fv("class_colours", 3, classes);
  uniforms.SetUniform3fv("probability_colours", probability_stops, probabilities);
}

std::vector<Legend> legends_of(const VoxelFilter& filter, VoxelColouring colouring) {
  if (colouring == VoxelColouring::by_probability) {
    return {{"occupancy probability", {}, Legend::Range{ColourMap::probability(), 0.0, 1.0, ""}}};
  }
  Legend legend{"voxels", {}, {}};
  if (filter.occupied) legend.swatches.push_back({"occupied", theme::occupied});
  if (filter.unknown) {
    const std::string bound = filter.unknown_from > 0 ? fmt::format(", p ≥ {:g}", filter.unknown_from) : "";
    legend.swatches.push_back({"measured, unknown" + bound, theme::unknown});
  }
  if (filter.free) legend.swatches.push_back({"free", theme::free});
  return {legend};
}

}  // namespace

OctreeLayer::OctreeLayer(vtkRenderer& renderer) : Layer(renderer), solid_(make_part()), free_(make_part()) {
  free_.actor->GetProperty()->SetOpacity(0.16);
  set_colouring(VoxelColouring::by_class);
}

OctreeLayer::Part OctreeLayer::make_part() {
  Part part{vtkSmartPointer<vtkOpenGLPolyDataMapper>::New(), vtkSmartPointer<vtkActor>::New()};
  part.mapper->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  part.mapper->MapDataArrayToVertexAttribute("voxel", "voxel", vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  part.actor->SetMapper(part.mapper);
  vtkShaderProperty& shaders = *part.actor->GetShaderProperty();
  shaders.AddVertexShaderReplacement("//VTK::Normal::Dec", true,
                                     "//VTK::Normal::Dec\n" + load_shader("voxels_vertex.glsl"), false);
  shaders.AddVertexShaderReplacement("//VTK::Normal::Impl", true, "//VTK::Normal::Impl\n  pass_voxel();\n", false);
  shaders.AddFragmentShaderReplacement("//VTK::Normal::Dec", true, "//VTK::Normal::Dec\n" + load_shader("voxels.glsl"),
                                       false);
  shaders.AddFragmentShaderReplacement(
      "//VTK::Color::Impl", true,
      "//VTK::Color::Impl\n  diffuseColor = 0.75 * voxel_colour();\n  ambientColor = 0.4 * voxel_colour();\n", false);
  set_palette(*shaders.GetFragmentCustomUniforms());
  add(*part.actor);
  return part;
}

void OctreeLayer::show(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter,
                       VoxelColouring colouring) {
  const auto solid = exposed_faces(grid, voxels, {filter.occupied, filter.unknown, false, filter.unknown_from});
  const auto free = exposed_faces(grid, voxels, {false, false, filter.free});
  solid_.mapper->SetInputDataObject(face_polydata(grid, voxels, solid));
  free_.mapper->SetInputDataObject(face_polydata(grid, voxels, free));
  Eigen::AlignedBox3d box;
  for (const auto& faces : {solid, free}) {
    for (const VoxelFace& face : faces) box.extend(grid.centre(face.voxel));
  }
  if (!box.isEmpty()) {
    box.min().array() -= 0.5 * grid.resolution;
    box.max().array() += 0.5 * grid.resolution;
  }
  filter_ = filter;
  describe(corners(box), {});
  set_colouring(colouring);
}

void OctreeLayer::set_colouring(VoxelColouring colouring) {
  for (Part* part : {&solid_, &free_}) {
    part->actor->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformi(
        "by_probability", colouring == VoxelColouring::by_probability);
  }
  const std::vector<Vector3> points(outline().begin(), outline().end());
  describe(points, points.empty() ? std::vector<Legend>{} : legends_of(filter_, colouring));
}

}  // namespace nextview
