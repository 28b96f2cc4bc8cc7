#pragma once
#include <imgui.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "ui/render_target/image.hpp"

namespace nextview {

class RenderTarget;

/// Pictures in panels, by name: given to the graphics card when they change. Without a target (panels that are drawn
/// without pixels, in tests) there are none.
class PanelPictures {
 public:
  explicit PanelPictures(RenderTarget* target = nullptr) : target_(target) {}
  ~PanelPictures();
  PanelPictures(const PanelPictures&) = delete;
  PanelPictures& operator=(const PanelPictures&) = delete;

  /// Makes all anew when they are asked for again.
  void forget();
  /// `make` is called if the picture of this name was of another `version`. Null without a target.
  ImTextureID get(const std::string& name, std::uint64_t version, const std::function<Image()>& make);
  /// How often a picture was new or changed.
  std::size_t uploads() const { return uploads_; }

 private:
  struct Picture {
    unsigned int texture = 0;
    std::uint64_t version = 0;  ///< 0: none yet
  };
  void upload(unsigned int texture, const Image& image) const;

  RenderTarget* target_;
  std::map<std::string, Picture> pictures_;
  std::size_t uploads_ = 0;
};

}  // namespace nextview
