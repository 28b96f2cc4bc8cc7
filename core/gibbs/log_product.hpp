#pragma once
#include <cmath>

namespace nextview {

/// Sums weight * log(factor) over many factors with few logarithms: factors of one weight are multiplied first.
/// @pre factors are between 1e-15 and 1e15
class LogProduct {
 public:
  void multiply(double factor, double weight) {
    if (weight != weight_ || factors_ == 16) flush(weight);
    product_ *= factor;
    ++factors_;
  }
  double sum() {
    flush(weight_);
    return sum_;
  }

 private:
  void flush(double next_weight) {
    if (factors_ > 0) sum_ += weight_ * std::log(product_);
    product_ = 1.0;
    factors_ = 0;
    weight_ = next_weight;
  }

  double sum_ = 0.0, product_ = 1.0;
  int factors_ = 0;
  double weight_ = 1.0;
};

}  // namespace nextview
