#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "ui/render_target/image.hpp"

namespace nextview {

/// Pictures of one size, one after the other and over again, as an animated PNG (APNG, PNG's third edition). Browsers
/// show it wherever they show a picture; what does not know of motion shows the first. Alpha is left out.
class Animation {
 public:
  explicit Animation(int pictures_per_second) : pictures_per_second_(pictures_per_second) {}

  /// Keeps what changed since the last one, compressed.
  /// @throws std::invalid_argument if it is empty or not as large as the first.
  void add(const Image& picture);
  /// Atomic (AtomicFile). @throws std::runtime_error naming the file and the reason: full disk, no pictures.
  void write(const std::filesystem::path& file) const;

 private:
  /// The part that differs from what was shown before.
  struct Change {
    int x, y, width, height;  ///< [px]
    int shown;                ///< for so many pictures' time
    std::string pixels;       ///< compressed, as PNG has them
  };
  int pictures_per_second_;
  Image last_;
  std::vector<Change> changes_;
};

}  // namespace nextview
