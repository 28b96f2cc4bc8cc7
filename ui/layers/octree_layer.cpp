#include "ui/layers/octree_layer.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vtkActor.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ui/drawing/shader_file.hpp"
#include "ui/layers/voxel_polydata.hpp"

namespace nextview {
namespace {

constexpr float no_value = -1.0f;  // instead of a colour, for shaders/voxels_vertex.glsl
constexpr std::size_t faces_per_task = 4096;

/// 8 bits a channel in one float, which holds 24 bits exactly.
float packed(const Colour& colour) {
  float result = 0.0f;
  for (const double channel : colour) result = 256.0f * result + float(std::lround(channel * 255));
  return result;
}

/// `darkness`: of the innermost nooks, 0 none.
void set_uniforms(vtkUniforms& uniforms, double scale, double darkness) {
  float without[2][3];
  for (int c = 0; c < 3; ++c) {
    without[0][c] = float(valueless_voxel[c]);
    without[1][c] = float(valueless_voxel_stripes[c]);
  }
  uniforms.SetUniform3fv("valueless_colours", 2, without);
  uniforms.SetUniformf("pixel_scale", float(scale));
  uniforms.SetUniformf("nook_darkness", float(darkness));
}

}  // namespace

OctreeLayer::OctreeLayer(vtkRenderer& renderer) : Layer(renderer), solid_(make_part(0.45)), free_(make_part(0.0)) {
  solid_.actor->GetProperty()->BackfaceCullingOn();
  free_.actor->GetProperty()->SetOpacity(0.16);
}

OctreeLayer::Part OctreeLayer::make_part(double nook_darkness) {
  Part part{vtkSmartPointer<vtkOpenGLPolyDataMapper>::New(), vtkSmartPointer<vtkActor>::New(), nook_darkness, {}, {}};
  part.mapper->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  for (const char* name : {"voxel_corner", "voxel_colour"})
    part.mapper->MapDataArrayToVertexAttribute(name, name, vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  part.actor->SetMapper(part.mapper);
  vtkShaderProperty& shaders = *part.actor->GetShaderProperty();
  shaders.AddVertexShaderReplacement("//VTK::Normal::Dec", true,
                                     "//VTK::Normal::Dec\n" + load_shader("voxels_vertex.glsl"), false);
  shaders.AddVertexShaderReplacement("//VTK::Normal::Impl", true,
                                     "//VTK::Normal::Impl\n  pass_voxel((MCVCMatrix * vertexMC).xyz);\n", false);
  shaders.AddFragmentShaderReplacement("//VTK::Normal::Dec", true, "//VTK::Normal::Dec\n" + load_shader("voxels.glsl"),
                                       false);
  // VTK's light needs no normal any more: shaders/voxels_vertex.glsl lights the faces.
  shaders.AddFragmentShaderReplacement("//VTK::Normal::Impl", true, "", false);
  shaders.AddFragmentShaderReplacement("//VTK::Light::Impl", true, "fragOutput0 = vec4(voxel_shade(), opacity);\n",
                                       false);
  // VTK moves faces back a little, for the sake of edges on them, and discards clear pixels. There are neither, and
  // without both the depth is known before shading: hidden faces cost next to nothing.
  shaders.AddFragmentShaderReplacement("//VTK::Depth::Impl", true, "", false);
  shaders.AddFragmentShaderReplacement("discard;", true, "", true);
  set_uniforms(*shaders.GetFragmentCustomUniforms(), scale(), nook_darkness);
  add(*part.actor);
  return part;
}

void OctreeLayer::on_scale() {
  for (Part* part : {&solid_, &free_})
    set_uniforms(*part->actor->GetShaderProperty()->GetFragmentCustomUniforms(), scale(), part->nook_darkness);
}

void OctreeLayer::show_part(Part& part, const VoxelGrid& grid, std::span<const Voxel> voxels,
                            const VoxelFilter& filter) {
  part.faces = exposed_faces(grid, voxels, filter);
  part.voxels.clear();
  for (const VoxelFace& face : part.faces) part.voxels.push_back(voxels[face.voxel]);
  part.mapper->SetInputDataObject(voxel_polydata(grid, part.faces));
}

void OctreeLayer::show(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter,
                       VoxelColouring colouring, std::span<const float> values) {
  if (!values.empty() && values.size() != grid.voxel_count())
    throw std::invalid_argument("values: their number is not that of the voxels");
  VoxelFilter solid = filter, free = filter;
  solid.free = false;
  free.occupied = free.unknown = free.uncertain = false;
  free.free = filter.free && !filter.uncertain;
  show_part(solid_, grid, voxels, solid);
  show_part(free_, grid, voxels, free);
  Eigen::AlignedBox3d box;
  for (const Part* part : {&solid_, &free_}) {
    for (const VoxelFace& face : part->faces) box.extend(grid.centre(face.voxel));
  }
  if (!box.isEmpty()) {
    box.min().array() -= 0.5 * grid.resolution;
    box.max().array() += 0.5 * grid.resolution;
  }
  filter_ = filter;
  voxel_count_ = grid.voxel_count();
  describe(corners(box), {});
  set_colouring(colouring, values);
}

bool OctreeLayer::colour_part(Part& part, const VoxelPalette& palette, std::span<const float> values) {
  vtkNew<vtkFloatArray> colours;
  colours->SetName("voxel_colour");
  colours->SetNumberOfTuples(vtkIdType(part.faces.size()) * 4);
  std::atomic<bool> complete = true;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, part.faces.size(), faces_per_task), [&](const auto& range) {
    float* out = colours->GetPointer(vtkIdType(range.begin()) * 4);
    for (std::size_t f = range.begin(); f < range.end(); ++f, out += 4) {
      const float value = values.empty() ? std::numeric_limits<float>::quiet_NaN() : values[part.faces[f].voxel];
      const auto colour = palette.colour(part.voxels[f], value);
      if (!colour) complete = false;
      std::fill_n(out, 4, colour ? packed(*colour) : no_value);
    }
  });
  auto* polydata = vtkPolyData::SafeDownCast(part.mapper->GetInputDataObject(0, 0));
  polydata->GetPointData()->AddArray(colours);
  return complete;
}

void OctreeLayer::set_colouring(VoxelColouring colouring, std::span<const float> values) {
  if (!values.empty() && values.size() != voxel_count_)
    throw std::invalid_argument("values: their number is not that of the voxels");
  const VoxelPalette palette(colouring);
  const bool solid = colour_part(solid_, palette, values), free = colour_part(free_, palette, values);
  const std::vector<Vector3> points(outline().begin(), outline().end());
  std::vector<Legend> legends;
  if (!points.empty()) legends.push_back(palette.legend(filter_, !solid || !free));
  describe(points, std::move(legends));
}

}  // namespace nextview
