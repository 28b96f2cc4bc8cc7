#pragma once
#include <string>
#include <vector>

#include "ui/manual/manual.hpp"
#include "ui/manual/markdown.hpp"
#include "ui/panels/panel.hpp"

namespace nextview {

/// The manual over the window: its pages at the left, the one that is read at the right.
class ManualSheet {
 public:
  void draw(const PanelContext& context, const Rectangle& window);

 private:
  void follow(const std::string& topic);
  void draw_topics(const PanelContext& context) const;
  void draw_page(const PanelContext& context);

  std::vector<ManualPage> pages_;  ///< read when the manual is opened for the first time
  std::string topic_, error_;
  std::vector<MarkdownBlock> blocks_;  ///< of the page of this topic
  bool is_new_ = true;                 ///< it is to be read from its begin
};

}  // namespace nextview
