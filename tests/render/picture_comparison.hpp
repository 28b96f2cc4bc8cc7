#pragma once
#include <string>

#include "ui/render_target/image.hpp"

namespace nextview {

/// How far a picture may be from the one it should be. The same processor gives the same bytes; other instruction sets
/// and other Mesa versions round differently, which shows on edges. A looser bound than the default needs a reason.
class PictureBound {
 public:
  PictureBound() = default;
  PictureBound(double changed, int largest, std::string why);

  double changed_share = 0.001;  ///< share of pixels with a channel that differs by more than `visible`
  int largest_difference = 96;   ///< of any channel of any pixel [of 255]
  std::string reason;
  static constexpr int visible = 3;
};

struct PictureDifference {
  bool same_size = true;
  double changed_share = 0.0;
  int largest_difference = 0;
  Image picture;  ///< the expected picture in pale grey, what changed in red; empty if the sizes differ

  bool within(const PictureBound& bound) const;
  std::string summary() const;
};

PictureDifference compare(const Image& expected, const Image& actual);

}  // namespace nextview
