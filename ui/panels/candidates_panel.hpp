#pragma once
#include <optional>

#include "ui/panels/panel.hpp"
#include "ui/window/candidate_order.hpp"

namespace nextview {

/// The candidates that a person points at or has clicked, in the table or in the scene.
struct CandidateFocus {
  std::optional<std::size_t> hovered, selected;
};

/// The ranking: what each candidate view is worth, which one is next and why. A person can take another one.
class CandidatesPanel {
 public:
  void draw(PanelContext& context, const Rectangle& rectangle, CandidateFocus& focus);

 private:
  void draw_table(PanelContext& context, CandidateFocus& focus, float height);

  CandidateColumn column_ = CandidateColumn::utility;
  bool ascending_ = false;
};

}  // namespace nextview
