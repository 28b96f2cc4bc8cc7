#include "tests/render/render_test.hpp"

#include <cstdlib>
#include <filesystem>

#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

const std::filesystem::path screenshots = NEXTVIEW_SCREENSHOTS;
const std::filesystem::path failures = NEXTVIEW_RENDER_FAILURES;

void leave_pictures(const std::string& name, const Image* expected, const Image& actual, const Image& difference) {
  std::filesystem::create_directories(failures);
  if (expected) write_png(*expected, failures / (name + ".expected.png"));
  write_png(actual, failures / (name + ".actual.png"));
  if (!difference.rgba.empty()) write_png(difference, failures / (name + ".difference.png"));
}

}  // namespace

void expect_screenshot(const std::string& name, const Image& actual, const PictureBound& bound) {
  const auto file = screenshots / (name + ".png");
  if (std::getenv("NEXTVIEW_UPDATE_SCREENSHOTS")) {
    // A picture that differs by rounding alone stays as it is, so that renewing changes no files without need.
    if (!std::filesystem::exists(file) || read_png(file) != actual) write_png(actual, file);
    return;
  }
  if (!std::filesystem::exists(file)) {
    leave_pictures(name, nullptr, actual, {});
    ADD_FAILURE() << file.string() << " is missing. What was drawn: " << (failures / (name + ".actual.png")).string()
                  << ". If it is right, run tests/update-screenshots " << name;
    return;
  }
  const Image expected = read_png(file);
  const PictureDifference difference = compare(expected, actual);
  if (difference.within(bound)) return;
  leave_pictures(name, &expected, actual, difference.picture);
  ADD_FAILURE() << name << ": " << difference.summary() << " (allowed: " << 100 * bound.changed_share << " %, "
                << bound.largest_difference << "). Expected, actual and difference: " << (failures / name).string()
                << ".*.png. If the change is meant, run tests/update-screenshots " << name;
}

Image draw_scene(int width, int height, const std::function<void(Scene&)>& fill) {
  OffscreenTarget target(width, height);
  Scene scene;
  scene.attach(target);
  fill(scene);
  target.render();
  Image image = target.read_back();
  EXPECT_EQ(target.gl_error(), 0u) << "OpenGL reported an error";
  return image;
}

}  // namespace nextview
