#include "ui/scene/scene.hpp"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>

#include <cmath>
#include <numbers>

#include "ui/drawing/painter.hpp"
#include "ui/scene/scene_overlay.hpp"
#include "ui/scene/scene_renderer.hpp"

namespace nextview {
namespace {

/// Lights that travel with the camera: a key from the upper left, a weaker fill from the right, a little from the
/// front.
void add_lights(vtkRenderer& renderer) {
  struct Placement {
    Vector3 position;  ///< x right, y up, z from the scene to the camera
    double intensity;
  };
  for (const auto& [position, intensity] :
       {Placement{{-0.8, 1.5, 1.3}, 0.62}, Placement{{1.6, 0.3, 0.9}, 0.30}, Placement{{0.0, 0.0, 1.0}, 0.26}}) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(position.x(), position.y(), position.z());
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(intensity);
    renderer.AddLight(light);
  }
}

/// Before each picture: the lights go with the camera, but shaders hear of it only if the lights themselves change.
/// Else a picture would depend on those before it.
void renew_lights(vtkObject* renderer, unsigned long, void*, void*) {
  vtkLightCollection& lights = *static_cast<vtkRenderer*>(renderer)->GetLights();
  lights.InitTraversal();
  while (vtkLight* light = lights.GetNextItem()) light->Modified();
}

constexpr double widest_in_window = 236.0;  // "measured but unknown, p ≥ 0.5", which comes with the first view [px]

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace

struct Scene::Overlay {
  vtkNew<SceneOverlay> item;
  vtkNew<vtkContextActor> actor;
};

Scene::Scene()
    : renderer_(vtkSmartPointer<SceneRenderer>::New()),
      mesh_(std::make_unique<MeshLayer>(*renderer_)),
      cloud_(std::make_unique<CloudLayer>(*renderer_)),
      octree_(std::make_unique<OctreeLayer>(*renderer_)),
      views_(std::make_unique<ViewsLayer>(*renderer_)),
      rays_(std::make_unique<RaysLayer>(*renderer_)),
      region_(std::make_unique<RegionLayer>(*renderer_)),
      fit_(std::make_unique<FitLayer>(*renderer_)),
      missed_(std::make_unique<MeshLayer>(*renderer_)),
      surface_(std::make_unique<MeshLayer>(*renderer_)),
      section_(std::make_unique<SectionLayer>(*renderer_)),
      overlay_(std::make_unique<Overlay>()) {
  renderer_->GradientBackgroundOn();
  set_dark(false);
  renderer_->AutomaticLightCreationOff();
  renderer_->GetActiveCamera()->SetViewAngle(vertical_angle);
  add_lights(*renderer_);
  vtkNew<vtkCallbackCommand> before_each_picture;
  before_each_picture->SetCallback(renew_lights);
  renderer_->AddObserver(vtkCommand::StartEvent, before_each_picture);
  overlay_->item->renderer = renderer_;
  overlay_->actor->GetScene()->AddItem(overlay_->item);
  overlay_->actor->GetScene()->SetRenderer(renderer_);
  renderer_->AddActor(overlay_->actor);
}

Scene::~Scene() {
  overlay_->actor->GetScene()->SetRenderer(nullptr);
  if (vtkRenderWindow* window = renderer_->GetRenderWindow()) window->RemoveRenderer(renderer_);
}

vtkRenderer& Scene::renderer() { return *renderer_; }

void Scene::attach(RenderTarget& target, const Viewport& viewport) {
  renderer_->SetViewport(viewport.left, viewport.bottom, viewport.right, viewport.top);
  target.window().AddRenderer(renderer_);
  software_ = target.draws_in_software();
}

std::array<Layer*, 10> Scene::layers() const {
  return {views_.get(), rays_.get(),   octree_.get(), cloud_.get(), surface_.get(),
          mesh_.get(),  missed_.get(), region_.get(), fit_.get(),   section_.get()};
}

void Scene::cut(const std::optional<Section>& section) {
  for (MeshLayer* layer : {mesh_.get(), missed_.get(), surface_.get()}) layer->set_section(section);
  cloud_->set_section(section);
}

void Scene::set_dark(bool dark) {
  renderer_->SetBackground((dark ? on_dark(theme::ground) : theme::ground).data());
  renderer_->SetBackground2((dark ? on_dark(theme::sky) : theme::sky).data());
  overlay_->item->dark = dark;
  for (Layer* layer : layers()) layer->set_dark(dark);
}

void Scene::set_orthographic(bool orthographic, const Vector3& point) {
  vtkCamera& camera = *renderer_->GetActiveCamera();
  const Vector3 position(camera.GetPosition()), forward(camera.GetDirectionOfProjection());
  const double slope = std::tan(radians(camera.GetViewAngle()) / 2), depth = forward.dot(point - position);
  if (orthographic == bool(camera.GetParallelProjection()) || depth <= 0) return;
  camera.SetParallelProjection(orthographic);
  // Before all there is, else what lies behind the camera would be cut off; back again as far as the picture says.
  Eigen::AlignedBox3d box;
  for (const Vector3& corner : outline()) box.extend(corner);
  const double away = orthographic ? std::max(depth, box.diagonal().norm()) : camera.GetParallelScale() / slope;
  if (orthographic) camera.SetParallelScale(depth * slope);
  const Vector3 moved = position + (depth - away) * forward, focus = moved + away * forward;
  camera.SetPosition(moved.data());
  camera.SetFocalPoint(focus.data());
  renderer_->ResetCameraClippingRange();
}

void Scene::set_caption(const std::string& caption) { overlay_->item->caption = caption; }

void Scene::set_axes(bool axes, bool scale_bar) {
  overlay_->item->axes = axes;
  overlay_->item->scale_bar = scale_bar;
}

void Scene::set_scale(double scale) {
  if (scale == overlay_->item->scale) return;
  overlay_->item->scale = scale;
  scale_layers();
}

/// Of a coarse picture's pixels lines and points take half as many.
void Scene::scale_layers() {
  const bool coarse = quality_ >= DrawingQuality::coarse && software_;
  const bool moving = quality_ == DrawingQuality::moving, still = quality_ == DrawingQuality::still;
  renderer_->set_coarse(coarse);
  // Where nothing moves it is seen that voxels change their size.
  octree_->set_coarse(software_ && (moving || (!still && octree_->face_count() > 120'000)));
  for (Layer* layer : layers()) layer->set_scale(overlay_->item->scale * (coarse ? 0.5 : 1.0));
}

void Scene::set_quality(DrawingQuality quality) {
  vtkRenderWindow* window = renderer_->GetRenderWindow();
  if (!window || quality == quality_) return;
  quality_ = quality;
  window->SetMultiSamples(quality == DrawingQuality::still ? RenderTarget::smooth_samples : 0);
  scale_layers();
}

void Scene::set_backed(bool backed) { overlay_->item->backed = backed; }
Eigen::Vector2d Scene::legends_reach() const { return overlay_->item->legends_reach(); }

/// Of legends in a window: smaller in a narrow scene, which they would cover; 0: they would even so.
double Scene::legend_size() const {
  constexpr double small = 0.8;
  const double width = renderer_->GetSize()[0] / overlay_->item->scale;
  if (!overlay_->item->backed || width >= 2 * (usual_legend_width + 36)) return 1.0;
  return width >= 1.25 * small * (widest_in_window + 36) ? small : 0.0;
}

void Scene::annotate() {
  overlay_->item->legends.clear();
  overlay_->item->labels.clear();
  const double size = legend_size();
  const bool legends = legends_ && size > 0;
  if (legends) overlay_->item->legend_size = size;
  for (const Layer* layer : layers()) {
    if (!layer->visible()) continue;
    overlay_->item->labels.insert(overlay_->item->labels.end(), layer->labels().begin(), layer->labels().end());
    if (legends)
      overlay_->item->legends.insert(overlay_->item->legends.end(), layer->legends().begin(), layer->legends().end());
  }
  if (overlay_->item->backed) drop_legends_without_room();
}

/// In a low window: those of candidates first, of voxels last; in a narrow one beneath them is the object.
void Scene::drop_legends_without_room() {
  constexpr double foot = 56.0;  // [px] for axes and scale bar
  const double height = renderer_->GetSize()[1] / overlay_->item->scale;
  const double room = overlay_->item->legend_size < 1 ? 0.4 * height : height - foot;
  std::vector<Legend>& legends = overlay_->item->legends;
  while (!legends.empty() && overlay_->item->legends_height() > room) legends.erase(legends.begin());
}

std::vector<Vector3> Scene::outline() const {
  std::vector<Vector3> points;
  for (const Layer* layer : layers()) {
    if (layer->visible()) points.insert(points.end(), layer->outline().begin(), layer->outline().end());
  }
  if (points.empty()) points = corners({Vector3::Constant(-0.5), Vector3::Constant(0.5)});
  return points;
}

void Scene::frame(const ViewDirection& direction) { frame(outline(), direction); }

/// The nearest camera of this orientation that shows all points clear of the legends.
Vector3 Scene::camera_position(const Eigen::Matrix3d& R_world_camera, std::span<const Vector3> points) const {
  const SceneOverlay& overlay = *overlay_->item;
  const double width = std::max(renderer_->GetSize()[0], 1) / overlay.scale;  // [px] of the design, as the margins
  const double height = std::max(renderer_->GetSize()[1], 1) / overlay.scale;
  const double aspect = width / height, angle = radians(vertical_angle);
  const Eigen::Vector2d axes = overlay.axes_size().cwiseQuotient(Eigen::Vector2d(width, height));
  const auto framed = [&](FrameMargins margins) {
    const Vector3 position = frame_points(R_world_camera, angle, aspect, margins, points);
    const bool clear =
        !overlay.backed || !overlay.axes || clears_corner(R_world_camera, position, angle, aspect, axes, points, true);
    if (clear || margins.bottom >= axes.y()) return position;
    margins.bottom = std::min(axes.y(), 0.45);
    return frame_points(R_world_camera, angle, aspect, margins, points);
  };
  const auto share = [](double margin, double whole) { return std::min(margin / whole, 0.25); };  // some is left
  const double foot = tight_ ? 20.0 : 44.0;  // [px] for axes and scale bar
  const FrameMargins centred{share(20, width), share(20, width),
                             std::min(std::max(foot, covered_below_) / height, 0.45),
                             share(overlay.caption.empty() ? 24 : 46, height)};
  Vector3 middle = framed(centred);
  const bool to_come = legends_to_come_ && legends_ && legend_size() > 0;
  if (overlay.legends.empty() && !to_come) return middle;
  FrameMargins beside = centred, beneath = centred;
  const double legends_width = overlay.backed ? legend_size() * widest_in_window : usual_legend_width;
  beside.right = std::min((legends_width + 36) / width, 0.5);
  const bool usual = legend_size() == 1;  // in a narrow scene the part has room before legends have
  const double legends_height = std::max(overlay.legends_height(), to_come && usual ? 260.0 : 0.0);
  beneath.top = std::clamp(legends_height / height, centred.top, usual ? 0.5 : 0.3);
  if (clears_corner(R_world_camera, middle, angle, aspect, {1 - beside.right, 1 - beneath.top}, points)) return middle;
  const Vector3 left = framed(beside), lower = framed(beneath), forward = R_world_camera.col(2);
  return forward.dot(left) > forward.dot(lower) ? left : lower;
}

Scene::Stand Scene::stand() const {
  Stand stand{vtkSmartPointer<vtkCamera>::New(), overlay_->item->scale_reference};
  stand.camera->DeepCopy(renderer_->GetActiveCamera());
  return stand;
}

void Scene::restore(const Stand& stand) {
  renderer_->GetActiveCamera()->DeepCopy(stand.camera);
  renderer_->GetActiveCamera()->Modified();  // which a copy is not by itself
  overlay_->item->scale_reference = stand.scale_reference;
  renderer_->ResetCameraClippingRange();
}

void Scene::turn(const Stand& start, const Vector3& centre, double degrees) {
  restore(start);
  vtkCamera& camera = *renderer_->GetActiveCamera();
  const Eigen::AngleAxisd turn(radians(degrees), Vector3::UnitZ());
  const auto turned = [&](const double* point) { return Vector3(centre + turn * (Vector3(point) - centre)); };
  const Vector3 position = turned(camera.GetPosition()), focus = turned(camera.GetFocalPoint());
  const Vector3 up = turn * Vector3(camera.GetViewUp());
  camera.SetPosition(position.data());
  camera.SetFocalPoint(focus.data());
  camera.SetViewUp(up.data());
  renderer_->ResetCameraClippingRange();
}

void Scene::frame(std::span<const Vector3> points, const ViewDirection& direction) {
  annotate();
  const double azimuth = radians(direction.azimuth), elevation = radians(direction.elevation);
  const Vector3 towards_camera(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                               std::sin(elevation));
  const Eigen::Matrix3d R_world_camera = look_at(towards_camera, Vector3::Zero()).linear();
  const Vector3 position = camera_position(R_world_camera, points);
  Eigen::AlignedBox3d box;
  for (const Vector3& point : points) box.extend(point);
  const Vector3 focus = position - towards_camera * towards_camera.dot(position - box.center());
  const Vector3 up = -R_world_camera.col(1);
  vtkCamera& camera = *renderer_->GetActiveCamera();
  camera.SetPosition(position.data());
  camera.SetFocalPoint(focus.data());
  camera.SetViewUp(up.data());
  camera.SetViewAngle(vertical_angle);
  camera.SetParallelScale(towards_camera.dot(position - box.center()) * std::tan(radians(vertical_angle) / 2));
  renderer_->ResetCameraClippingRange();
  overlay_->item->scale_reference = box.center();
}

}  // namespace nextview
