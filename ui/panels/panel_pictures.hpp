#pragma once
#include <imgui.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "ui/surface/image.hpp"

namespace nextview {

class RenderSurface;

/// Pictures in panels, by name: given to the graphics card when they change. Without a surface (panels that are drawn
/// without pixels, in tests) there are none.
class PanelPictures {
 public:
  explicit PanelPictures(RenderSurface* surface = nullptr) : surface_(surface) {}
  ~PanelPictures();
  PanelPictures(const PanelPictures&) = delete;
  PanelPictures& operator=(const PanelPictures&) = delete;

  /// `make` is called if the picture of this name was of another `version`. Null without a surface.
  ImTextureID get(const std::string& name, std::uint64_t version, const std::function<Image()>& make);
  /// How often a picture was new or changed.
  std::size_t uploads() const { return uploads_; }

 private:
  struct Picture {
    unsigned int texture = 0;
    std::uint64_t version = 0;  ///< 0: none yet
  };
  void upload(unsigned int texture, const Image& image) const;

  RenderSurface* surface_;
  std::map<std::string, Picture> pictures_;
  std::size_t uploads_ = 0;
};

}  // namespace nextview
