#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/render/picture_comparison.hpp"
#include "ui/render_target/render_target.hpp"
#include "ui/scene/scene.hpp"

namespace nextview {

/// Expects `actual` to be screenshots/<name>.png within the bound. Otherwise leaves the stored, the drawn and the
/// difference picture in <build>/render-failures/index.html. With NEXTVIEW_UPDATE_SCREENSHOTS set
/// (tests/update-screenshots), renews the picture.
void expect_screenshot(const std::string& name, const Image& actual, const PictureBound& bound = {});

/// The same of screenshots/<name>.png with motion: picture by picture.
void expect_animation(const std::string& name, const std::vector<Image>& actual, int pictures_per_second);

/// Draws a scene into an image of this size [px]. Expects that OpenGL reports no error.
Image draw_scene(int width, int height, const std::function<void(Scene&)>& fill);

/// The same on a target that there is: of pictures that are compared with each other, the shaders are compiled once.
Image draw_scene(RenderTarget& target, const std::function<void(Scene&)>& fill);

}  // namespace nextview

/// Declares a render test: fill a `Scene& scene` and frame it; the picture must be screenshots/<name>.png.
///   RENDER_TEST(mesh_solid, 960, 600, { scene.mesh().show(part()); scene.frame(); })
#define RENDER_TEST(name, width, height, ...) RENDER_TEST_WITHIN({}, name, width, height, __VA_ARGS__)

/// The same with a looser bound: PictureBound(share of changed pixels, largest difference, reason).
#define RENDER_TEST_WITHIN(bound, name, width, height, ...)                               \
  TEST(Render, name) {                                                                    \
    const auto fill = [](nextview::Scene & scene) __VA_ARGS__;                            \
    nextview::expect_screenshot(#name, nextview::draw_scene(width, height, fill), bound); \
  }
