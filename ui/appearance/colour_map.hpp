#pragma once
#include <span>

#include "ui/appearance/theme.hpp"

namespace nextview {

/// A perceptual colour map: lightness changes evenly along it (straight in OKLab), so equal steps of a value look like
/// equal steps, with any colour vision.
class ColourMap {
 public:
  static ColourMap score();         ///< pale to deep blue: a view's score
  static ColourMap contribution();  ///< pale to deep red: what a ray or voxel contributes
  static ColourMap probability();   ///< blue, pale, brown: free, undecided at 0.5, occupied
  static ColourMap deviation();     ///< blue, light grey, red: below, at 0.5 even, above
  static ColourMap uncertainty();   ///< pale to deep violet: entropy
  static ColourMap error();         ///< pale to deep red: how far from the truth
  static ColourMap distance();      ///< light teal, orange, deep red: from near to far
  static ColourMap height();        ///< deep violet, teal, light green: from low to high
  static ColourMap order();         ///< gold, green, deep blue: from the first to the last

  /// `t` is clamped to [0, 1]; not a number counts as 0.
  Colour at(double t) const;
  /// Where `value` lies between `low` and `high`. If these are equal, the upper end.
  Colour at(double value, double low, double high) const;
  /// The same with its lightness turned over: what was dark, and most, is light.
  ColourMap on_dark() const;

 private:
  struct Stop {
    double lightness, chroma, hue;  ///< OKLCh, hue [deg]
  };
  explicit ColourMap(std::array<Stop, 3> stops) : stops_(stops) {}
  std::array<Stop, 3> stops_;  ///< at 0, 0.5 and 1
};

/// OKLab lightness of a colour, 0 black to 1 white.
double lightness(const Colour& colour);

/// The colour on dark paper that says what this one says on white: its lightness turned over, so that paper is nearly
/// black and ink nearly white; hue and chroma stay.
Colour on_dark(const Colour& colour);

/// `a` and `b` mixed; 0 gives `a`.
Colour mix(const Colour& a, const Colour& b, double share);

}  // namespace nextview
