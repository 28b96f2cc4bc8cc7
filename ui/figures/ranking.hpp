#pragma once
#include <vtkContextItem.h>

#include <optional>
#include <string>
#include <vector>

namespace nextview {

/// The best candidate views, best first; equals in the candidates' order. Bars show the scores.
struct RankingContent {
  std::string title;
  std::string score_name, unit;
  std::vector<double> scores;         ///< one per candidate
  std::vector<double> utilities;      ///< one per candidate, and then the order is theirs; or none
  std::vector<std::size_t> taken;     ///< candidates that no longer take part
  std::optional<std::size_t> chosen;  ///< stands out; shown even if others are better
  std::string note;                   ///< one line beneath, for example why a ranking says nothing
};

/// The candidates in the order of the ranking, without those taken.
std::vector<std::size_t> ranked(const RankingContent& content);

/// Draws a ranking into a rectangle of the picture [px].
class RankingItem : public vtkContextItem {
 public:
  static RankingItem* New();
  vtkTypeMacro(RankingItem, vtkContextItem)

      bool Paint(vtkContext2D* context) override;

  RankingContent content;
  double x = 0, y = 0, width = 0, height = 0;

 private:
  std::pair<double, double> score_range(const std::vector<std::size_t>& candidates) const;
};

}  // namespace nextview
