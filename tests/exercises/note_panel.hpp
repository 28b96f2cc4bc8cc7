#pragma once
#include "ui/panels/panel.hpp"
#include "ui/panels/panel_table.hpp"

namespace nextview {

/// Exercise: a panel of its own. It shows a note, and how often it did.
struct NotePanel : PanelContent {
  void draw(const PanelContext& context, const Rectangle& rectangle) override {
    const Panel panel("Note", rectangle);
    heading(context.style, "Turn the part over after view 10.");
    small_text(context.style, "shown " + std::to_string(++frames) + " times");
  }

  int frames = 0;
};

inline PanelEntry note_panel() {
  return {{"note", "Note", Side::bottom, "What not to forget."}, [] { return std::make_unique<NotePanel>(); }};
}

}  // namespace nextview
