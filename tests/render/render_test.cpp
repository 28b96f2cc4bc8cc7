#include "tests/render/render_test.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <utility>

#include "tests/render/animation_pictures.hpp"
#include "tests/render/failures_page.hpp"
#include "ui/render_target/animation.hpp"
#include "ui/render_target/offscreen_target.hpp"

namespace nextview {
namespace {

const std::filesystem::path screenshots = NEXTVIEW_SCREENSHOTS;
const FailuresPage failures(NEXTVIEW_RENDER_FAILURES);

bool renews() { return std::getenv("NEXTVIEW_UPDATE_SCREENSHOTS") != nullptr; }

/// Of the last picture, for the next one of its size: in a context of its own all shaders would be compiled anew. It is
/// not given up at the end, when what it hangs on may be gone before it.
std::unique_ptr<OffscreenTarget>& kept_target() {
  static auto* const kept = new std::unique_ptr<OffscreenTarget>;
  return *kept;
}

void miss(const std::string& name, const Image& actual) {
  failures.add(name, nullptr, actual, {}, "it is missing");
  ADD_FAILURE() << (screenshots / (name + ".png")).string()
                << " is missing. What was drawn: " << failures.file().string()
                << ". If it is right, run tests/update-screenshots " << name;
}

/// Returns whether they are alike. `shown`: the name of this picture on the page of failures.
bool expect_alike(const std::string& name, const std::string& shown, const Image& expected, const Image& actual,
                  const PictureBound& bound) {
  const PictureDifference difference = compare(expected, actual);
  if (difference.within(bound)) {
    failures.remove(shown);
    return true;
  }
  const std::string reason =
      fmt::format("{} (allowed: {} %, {})", difference.summary(), 100 * bound.changed_share, bound.largest_difference);
  failures.add(shown, &expected, actual, difference.picture, reason);
  ADD_FAILURE() << shown << ": " << reason << ". Stored, drawn and difference: " << failures.file().string()
                << ". If the change is meant, run tests/update-screenshots " << name;
  return false;
}

}  // namespace

void expect_screenshot(const std::string& name, const Image& actual, const PictureBound& bound) {
  const auto file = screenshots / (name + ".png");
  if (renews()) {
    // A picture that differs by rounding alone stays as it is, so that renewing changes no files without need.
    if (!std::filesystem::exists(file) || read_png(file) != actual) write_png(actual, file);
    return;
  }
  if (!std::filesystem::exists(file)) return miss(name, actual);
  expect_alike(name, name, read_png(file), actual, bound);
}

void expect_animation(const std::string& name, const std::vector<Image>& actual, int pictures_per_second) {
  const auto file = screenshots / (name + ".png");
  const bool there = std::filesystem::exists(file);
  const std::vector<Image> stored = there ? animation_pictures(file) : std::vector<Image>();
  if (renews()) {
    Animation animation(pictures_per_second);
    for (const Image& picture : actual) animation.add(picture);
    if (stored != actual) animation.write(file);
    return;
  }
  ASSERT_FALSE(actual.empty());
  if (!there) return miss(name, actual.front());
  ASSERT_EQ(stored.size(), actual.size()) << "pictures of " << file.string();
  for (std::size_t i = 0; i < stored.size(); ++i)
    if (!expect_alike(name, fmt::format("{}_{}", name, i + 1), stored[i], actual[i], {})) return;
}

/// Not kept where drawing fails: nobody knows what is left in it.
Image draw_scene(int width, int height, const std::function<void(Scene&)>& fill) {
  std::unique_ptr<OffscreenTarget> target = std::move(kept_target());
  if (target && (target->width() != width || target->height() != height)) target.reset();
  if (!target) target = std::make_unique<OffscreenTarget>(width, height);
  Image image = draw_scene(*target, fill);
  kept_target() = std::move(target);
  return image;
}

Image draw_scene(RenderTarget& target, const std::function<void(Scene&)>& fill) {
  Scene scene;
  scene.attach(target);
  fill(scene);
  target.render();
  Image image = target.read_back();
  EXPECT_EQ(target.gl_error(), 0u) << "OpenGL reported an error";
  return image;
}

}  // namespace nextview
