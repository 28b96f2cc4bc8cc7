#include "ui/layers/layer.hpp"

#include <vtkActor.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkProp.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace nextview {

Layer::Layer(vtkRenderer& renderer) : renderer_(&renderer) {}

Layer::~Layer() {
  for (auto& prop : props_) renderer_->RemoveViewProp(prop);
}

void Layer::set_visible(bool visible) {
  visible_ = visible;
  for (auto& prop : props_) prop->SetVisibility(visible);
}

void Layer::set_scale(double scale) {
  const auto scaled = [&](float size) { return static_cast<float>(size / scale_ * scale); };  // there and back the same
  for (auto& prop : props_) {
    auto* actor = vtkActor::SafeDownCast(prop);
    if (!actor) continue;
    actor->GetProperty()->SetLineWidth(scaled(actor->GetProperty()->GetLineWidth()));
    actor->GetProperty()->SetPointSize(scaled(actor->GetProperty()->GetPointSize()));
  }
  scale_ = scale;
  on_scale();
}

void Layer::set_section(const std::optional<Section>& section) {
  const auto cut = [&](vtkMapper& mapper) {
    mapper.RemoveAllClippingPlanes();
    if (!section) return;
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(section->origin().data());
    plane->SetNormal(section->inward().data());
    mapper.AddClippingPlane(plane);
  };
  for (auto& prop : props_)
    if (auto* actor = vtkActor::SafeDownCast(prop); actor && actor->GetMapper()) cut(*actor->GetMapper());
  for (auto& mapper : instead_) cut(*mapper);
}

void Layer::add(vtkProp& prop) {
  prop.SetVisibility(visible_);
  props_.emplace_back(&prop);
  renderer_->AddViewProp(&prop);
}

void Layer::add_instead(vtkMapper& mapper) { instead_.emplace_back(&mapper); }

void Layer::describe(std::vector<Vector3> outline, std::vector<Legend> legends, std::vector<Label> labels) {
  outline_ = std::move(outline);
  legends_ = std::move(legends);
  labels_ = std::move(labels);
}

void set_colour(vtkProperty& property, const Colour& colour) { property.SetColor(colour[0], colour[1], colour[2]); }

std::vector<Vector3> corners(const Eigen::AlignedBox3d& box) {
  std::vector<Vector3> result;
  if (box.isEmpty()) return result;
  for (int i = 0; i < 8; ++i) result.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  return result;
}

}  // namespace nextview
