#include "ui/layers/octree_layer.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
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
#include "ui/layers/coarse_voxels.hpp"
#include "ui/layers/side_actor.hpp"
#include "ui/layers/voxel_polydata.hpp"

namespace nextview {
namespace {

constexpr float no_colour = -1.0f;  // instead of a colour, for shaders/voxels_vertex.glsl
constexpr int sides = 6;            // of a voxel
/// More than a software renderer draws while the camera moves.
constexpr std::size_t many_faces = 40'000;

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

OctreeLayer::OctreeLayer(vtkRenderer& renderer) : Layer(renderer), parts_(make_parts()), coarse_(make_parts()) {
  set_coarse(false);
}

std::size_t OctreeLayer::face_count() const {
  std::size_t count = 0;
  for (const Part& part : parts_) count += part.cells.size();
  return count;
}

void OctreeLayer::set_coarse(bool coarse) {
  wants_coarse_ = coarse;
  const bool drawn = coarse && has_coarse_;
  for (const Part& part : parts_) part.actor->set_drawn(!drawn);
  for (const Part& part : coarse_) part.actor->set_drawn(drawn);
}

OctreeLayer::Parts OctreeLayer::make_parts() {
  Parts parts;
  for (int side = 0; side < sides; ++side) {
    parts.push_back(make_part(0.45));
    parts.back().actor->set_side(side);
    parts.back().actor->GetProperty()->BackfaceCullingOn();
  }
  parts.push_back(make_part(0.0));
  parts.back().actor->GetProperty()->SetOpacity(0.16);
  return parts;
}

OctreeLayer::Part OctreeLayer::make_part(double nook_darkness) {
  Part part{vtkSmartPointer<vtkOpenGLPolyDataMapper>::New(), vtkSmartPointer<SideActor>::New(), nook_darkness, {}, {}};
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
  for (const Parts* parts : {&parts_, &coarse_})
    for (const Part& part : *parts)
      set_uniforms(*part.actor->GetShaderProperty()->GetFragmentCustomUniforms(), scale(), part.nook_darkness);
}

void OctreeLayer::show_parts(Parts& parts, const VoxelGrid& grid, std::span<const VoxelFace> solid,
                             std::span<const VoxelFace> free, std::span<const std::uint32_t> cells,
                             std::span<const Voxel> voxels) {
  std::array<std::vector<VoxelFace>, sides + 1> faces;
  for (Part& part : parts) part.cells.clear();
  const auto take = [&](std::size_t part, const VoxelFace& face, std::uint32_t cell) {
    faces[part].push_back(face);
    parts[part].cells.push_back(cell);
  };
  for (std::size_t i = 0; i < solid.size(); ++i) take(solid[i].side, solid[i], cells[i]);
  for (std::size_t i = 0; i < free.size(); ++i) take(sides, free[i], cells[solid.size() + i]);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].voxels.clear();
    for (const std::uint32_t cell : parts[i].cells) parts[i].voxels.push_back(voxels[cell]);
    parts[i].mapper->SetInputDataObject(voxel_polydata(grid, faces[i]));
  }
}

/// With larger voxels, the more the fewer of them: they need not be sharp while they move.
void OctreeLayer::show_coarse(const VoxelGrid& grid, std::span<const VoxelFace> solid, std::span<const VoxelFace> free,
                              std::span<const Voxel> voxels) {
  const std::size_t count = solid.size() + free.size();
  has_coarse_ = count > many_faces;
  set_coarse(wants_coarse_);
  if (!has_coarse_) return show_parts(coarse_, grid, {}, {}, {}, voxels);
  const int halvings = count > 16 * many_faces ? 2 : 1;
  const CoarseVoxels coarse_solid = coarse_voxels(grid, solid, halvings);
  const CoarseVoxels coarse_free = coarse_voxels(grid, free, halvings);
  std::vector<std::uint32_t> cells;
  for (const std::size_t i : coarse_solid.stand_for) cells.push_back(solid[i].voxel);
  for (const std::size_t i : coarse_free.stand_for) cells.push_back(free[i].voxel);
  show_parts(coarse_, coarse_solid.grid, coarse_solid.faces, coarse_free.faces, cells, voxels);
}

OctreeFaces octree_faces(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter) {
  VoxelFilter solid_filter = filter, free_filter = filter;
  solid_filter.free = false;
  free_filter.occupied = free_filter.unknown = free_filter.uncertain = false;
  free_filter.free = filter.free && !filter.uncertain;
  return {exposed_faces(grid, voxels, solid_filter), exposed_faces(grid, voxels, free_filter)};
}

void OctreeLayer::show(const VoxelGrid& grid, std::span<const Voxel> voxels, const VoxelFilter& filter,
                       VoxelColouring colouring, std::span<const float> values) {
  show(octree_faces(grid, voxels, filter), grid, voxels, filter, colouring, values);
}

void OctreeLayer::show(const OctreeFaces& found, const VoxelGrid& grid, std::span<const Voxel> voxels,
                       const VoxelFilter& filter, VoxelColouring colouring, std::span<const float> values) {
  if (!values.empty() && values.size() != grid.voxel_count())
    throw std::invalid_argument("values: their number is not that of the voxels");
  const auto& [solid, free] = found;
  std::vector<std::uint32_t> cells;
  Eigen::AlignedBox3d box;
  for (const auto* faces : {&solid, &free})
    for (const VoxelFace& face : *faces) {
      cells.push_back(face.voxel);
      box.extend(grid.centre(face.voxel));
    }
  show_parts(parts_, grid, solid, free, cells, voxels);
  show_coarse(grid, solid, free, voxels);
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
  colours->SetNumberOfTuples(vtkIdType(part.cells.size()) * 4);
  std::atomic<bool> complete = true;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, part.cells.size(), faces_per_task), [&](const auto& range) {
    float* out = colours->GetPointer(vtkIdType(range.begin()) * 4);
    for (std::size_t f = range.begin(); f < range.end(); ++f, out += 4) {
      const float value = values.empty() ? std::numeric_limits<float>::quiet_NaN() : values[part.cells[f]];
      const auto colour = palette.colour(part.voxels[f], value);
      if (!colour) complete = false;
      std::fill_n(out, 4, colour ? packed(*colour) : no_colour);
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
  bool complete = true;
  for (Part& part : parts_) complete &= colour_part(part, palette, values);
  for (Part& part : coarse_) colour_part(part, palette, values);
  const std::vector<Vector3> points(outline().begin(), outline().end());
  std::vector<Legend> legends;
  if (!points.empty()) legends.push_back(palette.legend(filter_, !complete));
  describe(points, std::move(legends));
}

}  // namespace nextview
