#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ui/manual/manual.hpp"
#include "ui/manual/markdown.hpp"
#include "ui/panels/manual_page.hpp"
#include "ui/panels/panel.hpp"

namespace nextview {

/// A block of a page of the manual that says what is looked for.
struct ManualHit {
  std::size_t page, block;  ///< in the pages as they are given
  std::string excerpt;      ///< of its text, from a little before the place
};

/// The page that a text is looked for in, as it is drawn.
struct ParsedPage {
  ManualPage page;
  std::vector<MarkdownBlock> blocks;
};

/// Where the pages say a text, in any case; first the pages whose headings say it, and of a page its headings.
std::vector<ManualHit> find_in_manual(const std::vector<ParsedPage>& pages, const std::string& text);

/// The manual over the window: its pages at the left, or where they say what is looked for, and the one that is read at
/// the right.
class ManualSheet {
 public:
  void draw(const PanelContext& context, const Rectangle& window);

 private:
  void follow(const std::string& topic);
  void draw_search(const PanelContext& context);
  void draw_hits(const PanelContext& context);
  void go_to_hit(const PanelContext& context, std::size_t hit);
  void draw_topics(const PanelContext& context) const;
  void draw_page(const PanelContext& context);
  void go_to_link(const PanelContext& context, const std::string& target);

  ManualPageDrawing drawing_;
  std::vector<ParsedPage> pages_;  ///< read when the manual is opened for the first time
  std::string topic_, error_;
  bool is_new_ = true;  ///< it is to be read from its begin
  std::string wanted_;  ///< what is looked for
  std::vector<ManualHit> hits_;
  std::optional<std::size_t> at_;  ///< the hit that was gone to
  bool is_at_new_ = false;         ///< it is to be scrolled to
  std::string anchor_;             ///< of the heading that is to be, too
};

}  // namespace nextview
