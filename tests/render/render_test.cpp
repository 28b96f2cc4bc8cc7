#include "tests/render/render_test.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "tests/render/failures_page.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

const std::filesystem::path screenshots = NEXTVIEW_SCREENSHOTS;
const FailuresPage failures(NEXTVIEW_RENDER_FAILURES);

}  // namespace

void expect_screenshot(const std::string& name, const Image& actual, const PictureBound& bound) {
  const auto file = screenshots / (name + ".png");
  if (std::getenv("NEXTVIEW_UPDATE_SCREENSHOTS")) {
    // A picture that differs by rounding alone stays as it is, so that renewing changes no files without need.
    if (!std::filesystem::exists(file) || read_png(file) != actual) write_png(actual, file);
    return;
  }
  if (!std::filesystem::exists(file)) {
    failures.add(name, nullptr, actual, {}, "it is missing");
    ADD_FAILURE() << file.string() << " is missing. What was drawn: " << failures.file().string()
                  << ". If it is right, run tests/update-screenshots " << name;
    return;
  }
  const Image expected = read_png(file);
  const PictureDifference difference = compare(expected, actual);
  if (difference.within(bound)) return failures.remove(name);
  const std::string reason =
      fmt::format("{} (allowed: {} %, {})", difference.summary(), 100 * bound.changed_share, bound.largest_difference);
  failures.add(name, &expected, actual, difference.picture, reason);
  ADD_FAILURE() << name << ": " << reason << ". Stored, drawn and difference: " << failures.file().string()
                << ". If the change is meant, run tests/update-screenshots " << name;
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
