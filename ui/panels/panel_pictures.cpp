#include "ui/panels/panel_pictures.hpp"

#include <cstdint>

#include "ui/render_target/gl_constants.hpp"
#include "ui/render_target/render_target.hpp"

namespace nextview {
namespace {

constexpr unsigned int gl_texture_2d = 0x0DE1, gl_min_filter = 0x2801, gl_mag_filter = 0x2800, gl_wrap_s = 0x2802,
                       gl_wrap_t = 0x2803;
constexpr int gl_clamp_to_edge = 0x812F;

template <class Function>
Function gl(const RenderTarget& target, const char* name) {
  return reinterpret_cast<Function>(target.gl_function(name));
}

}  // namespace

PanelPictures::~PanelPictures() { forget(); }

void PanelPictures::forget() {
  if (!target_) return;
  target_->make_current();
  for (const auto& [name, picture] : pictures_)
    gl<void (*)(int, const unsigned int*)>(*target_, "glDeleteTextures")(1, &picture.texture);
  pictures_.clear();
}

void PanelPictures::upload(unsigned int texture, const Image& image) const {
  gl<void (*)(unsigned int, unsigned int)>(*target_, "glBindTexture")(gl_texture_2d, texture);
  const auto set = gl<void (*)(unsigned int, unsigned int, int)>(*target_, "glTexParameteri");
  set(gl_texture_2d, gl_mag_filter, int(gl_nearest));  // each cell of it can be told
  set(gl_texture_2d, gl_min_filter, int(gl_linear));
  for (const unsigned int wrap : {gl_wrap_s, gl_wrap_t}) set(gl_texture_2d, wrap, gl_clamp_to_edge);
  gl<void (*)(unsigned int, int, int, int, int, int, unsigned int, unsigned int, const void*)>(
      *target_, "glTexImage2D")(gl_texture_2d, 0, gl_rgba, image.width, image.height, 0, gl_rgba, gl_unsigned_byte,
                                image.rgba.data());
  gl<void (*)(unsigned int, unsigned int)>(*target_, "glBindTexture")(gl_texture_2d, 0);
}

ImTextureID PanelPictures::get(const std::string& name, std::uint64_t version, const std::function<Image()>& make) {
  if (!target_) return nullptr;
  Picture& picture = pictures_[name];
  if (picture.texture == 0) gl<void (*)(int, unsigned int*)>(*target_, "glGenTextures")(1, &picture.texture);
  if (picture.version != version) {
    upload(picture.texture, make());
    picture.version = version;
    ++uploads_;
  }
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture.texture));
}

}  // namespace nextview
