#pragma once
#include <map>
#include <string>

#include "ui/manual/markdown.hpp"
#include "ui/panels/panel.hpp"

namespace nextview {

/// The parts of a page of the manual, as they are read: with links to click and, where the program has them, pictures.
class ManualPageDrawing {
 public:
  /// `id`: no two parts of a page have the same. Returns the target of the link that was clicked, or "".
  std::string draw(const PanelContext& context, const MarkdownBlock& block, int id);

 private:
  std::string draw_content(const Style& style, const MarkdownBlock& block, int id);
  bool draw_picture(const PanelContext& context, const std::string& picture);

  std::map<std::string, ImVec2> sizes_;  ///< of pictures [px]; of none that is not there, or no picture: 0
};

}  // namespace nextview
