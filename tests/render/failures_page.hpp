#pragma once
#include <filesystem>
#include <string>

#include "ui/render_target/image.hpp"

namespace nextview {

/// A folder of pictures that are not as they should be, with index.html: all of them, stored, drawn and difference side
/// by side.
class FailuresPage {
 public:
  explicit FailuresPage(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// `stored`: null if there is none; `reason`: a line for people.
  void add(const std::string& name, const Image* stored, const Image& drawn, const Image& difference,
           const std::string& reason) const;
  /// It is as it should be now: what an earlier run left of it goes.
  void remove(const std::string& name) const;
  std::filesystem::path file() const { return folder_ / "index.html"; }

 private:
  void write() const;

  std::filesystem::path folder_;
};

}  // namespace nextview
