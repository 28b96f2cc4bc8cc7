#include "ui/layers/cloud_layer.hpp"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ui/layers/geometry.hpp"

namespace nextview {
namespace {

constexpr int steps = 512;  // along a colour map: more than the eye tells apart
/// More than a software renderer draws at once beside the rest, and of how many one is drawn then.
constexpr std::size_t many_points = 15'000;
constexpr int every = 3;
const Colour no_truth = mix(theme::object, theme::ink, 0.1);

void check(const CloudPicture& picture) {
  const auto fits = [&](std::size_t count, CloudColouring needs, const char* what) {
    if (count == picture.points.size() || (count == 0 && picture.colouring != needs)) return;
    throw std::invalid_argument(fmt::format("cloud: {} points, but {} {}", picture.points.size(), count, what));
  };
  if (!picture.normals.empty() && picture.normals.size() != picture.points.size())
    throw std::invalid_argument(
        fmt::format("cloud: {} points, but {} normals", picture.points.size(), picture.normals.size()));
  fits(picture.views.size(), CloudColouring::by_view, "views");
  fits(picture.distances.size(), CloudColouring::by_distance, "distances");
  if (picture.heights && !(picture.heights->first < picture.heights->second))
    throw std::invalid_argument("cloud: the heights' range is empty");
  if (!(picture.farthest > 0)) throw std::invalid_argument("cloud: the farthest distance must be over 0");
}

/// What a point is coloured by, in the unit of the legend.
double value_of(const CloudPicture& picture, std::size_t point) {
  switch (picture.colouring) {
    case CloudColouring::by_view:
      return picture.views[point] + 1.0;  // people count views from 1
    case CloudColouring::by_height:
      return picture.points[point].z();
    case CloudColouring::by_distance:
      return picture.distances[point] * 1000.0;
    case CloudColouring::single:
      break;
  }
  return 0.0;
}

Legend legend_of(const CloudPicture& picture) {
  double low = value_of(picture, 0), high = low;
  bool truthless = false;
  for (std::size_t i = 0; i < picture.points.size(); ++i) {
    const double value = value_of(picture, i);
    truthless |= std::isnan(value);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  switch (picture.colouring) {
    case CloudColouring::by_view:
      return {"measured in view", {}, Legend::Range{ColourMap::order(), 1.0, high, "", "first", "last"}};
    case CloudColouring::by_height: {
      const auto [from, to] = picture.heights.value_or(ValueRange{low, high});
      const Legend::Range range{ColourMap::height(),        from, to, "m", low < from ? "and less" : "",
                                high > to ? "and more" : ""};
      return {"height of a point", {}, range, picture.heights.has_value()};
    }
    case CloudColouring::by_distance: {
      Legend legend{"distance to the truth",
                    {},
                    Legend::Range{ColourMap::distance(), 0.0, picture.farthest * 1000.0, "mm", "", "and more"}};
      if (truthless) legend.swatches.push_back({"no truth", no_truth});
      return legend;
    }
    case CloudColouring::single:
      break;
  }
  return {"", {{"measured points", theme::cloud}}, {}};
}

vtkSmartPointer<vtkUnsignedCharArray> colours_of(const CloudPicture& picture, const Legend::Range& range) {
  std::vector<std::array<unsigned char, 3>> along_map;
  const auto bytes = [](const Colour& colour) {
    std::array<unsigned char, 3> result;
    for (int c = 0; c < 3; ++c) result[c] = static_cast<unsigned char>(std::lround(colour[c] * 255));
    return result;
  };
  for (int i = 0; i < steps; ++i) along_map.push_back(bytes(range.map.at(i / double(steps - 1))));
  auto colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(vtkIdType(picture.points.size()));
  unsigned char* out = colours->GetPointer(0);
  for (std::size_t i = 0; i < picture.points.size(); ++i, out += 3) {
    const double value = value_of(picture, i);
    const double width = range.high - range.low, place = width > 0 ? (value - range.low) / width : 1.0;
    const auto colour = std::isnan(value)
                            ? bytes(no_truth)
                            : along_map[std::size_t(std::lround(std::clamp(place, 0.0, 1.0) * (steps - 1)))];
    std::copy(colour.begin(), colour.end(), out);
  }
  return colours;
}

/// With their colours, and their normals if there are any.
vtkSmartPointer<vtkPolyData> polydata_of(const CloudPicture& picture, const std::optional<Legend::Range>& range) {
  const auto polydata = point_polydata(picture.points);
  if (range) polydata->GetPointData()->SetScalars(colours_of(picture, *range));
  if (!picture.normals.empty()) polydata->GetPointData()->SetNormals(float_vectors(picture.normals));
  return polydata;
}

template <class Value>
std::vector<Value> thinned(std::span<const Value> values) {
  std::vector<Value> result;
  for (std::size_t i = 0; i < values.size(); i += every) result.push_back(values[i]);
  return result;
}

}  // namespace

CloudLayer::CloudLayer(vtkRenderer& renderer)
    : Layer(renderer),
      full_(vtkSmartPointer<vtkPolyDataMapper>::New()),
      thin_(vtkSmartPointer<vtkPolyDataMapper>::New()),
      actor_(vtkSmartPointer<vtkActor>::New()) {
  for (vtkPolyDataMapper* mapper : {full_.Get(), thin_.Get()}) {
    mapper->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
    add_instead(*mapper);
  }
  actor_->SetMapper(full_);
  actor_->GetProperty()->SetRenderPointsAsSpheres(true);
  actor_->GetProperty()->SetAmbient(0.5);
  actor_->GetProperty()->SetDiffuse(0.7);
  set_colour(*actor_->GetProperty(), theme::cloud);
  add(*actor_);
}

void CloudLayer::set_coarse(bool coarse) {
  if (coarse == coarse_) return;
  coarse_ = coarse;
  show_points();
}

void CloudLayer::show_points() {
  const bool thin = coarse_ && has_thin_;
  actor_->SetMapper(thin ? thin_ : full_);
  actor_->GetProperty()->SetRenderPointsAsSpheres(!coarse_ && !has_normals_);
  actor_->GetProperty()->SetPointSize(float(point_size_ * scale() * (thin ? std::sqrt(every) : 1.0)));
}

void CloudLayer::show(const PointCloud& cloud, double point_size) {
  CloudPicture picture;
  picture.points = cloud;
  picture.point_size = point_size;
  show(picture);
}

void CloudLayer::show_thin(const CloudPicture& picture, const std::optional<Legend::Range>& range) {
  has_thin_ = picture.points.size() > many_points;
  if (!has_thin_) return thin_->SetInputDataObject(vtkSmartPointer<vtkPolyData>::New());
  const auto points = thinned(picture.points), normals = thinned(picture.normals);
  const auto views = thinned(picture.views);
  const auto distances = thinned(picture.distances);
  CloudPicture few = picture;
  few.points = points, few.normals = normals, few.views = views, few.distances = distances;
  thin_->SetInputDataObject(polydata_of(few, range));
}

void CloudLayer::show(const CloudPicture& picture) {
  check(picture);
  std::vector<Legend> legends;
  if (!picture.points.empty()) legends.push_back(legend_of(picture));
  const auto range = legends.empty() ? std::nullopt : legends[0].range;
  full_->SetInputDataObject(polydata_of(picture, range));
  show_thin(picture, range);
  has_normals_ = !picture.normals.empty();
  point_size_ = picture.point_size;
  show_points();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& point : picture.points) box.extend(point.cast<double>());
  describe(corners(box), std::move(legends));
}

}  // namespace nextview
