#pragma once
#include <array>
#include <streambuf>

namespace nextview {

/// Lets a std::ostream write to an open file, and keeps why that failed, which the standard library's streams do not.
/// After a failure nothing more is written.
class DescriptorBuffer : public std::streambuf {
 public:
  /// The descriptor must stay open as long as this is written to.
  explicit DescriptorBuffer(int descriptor);

  /// Writes what is still held. Returns 0, or the errno of the first write that failed.
  int flush();

 protected:
  int_type overflow(int_type byte) override;
  int sync() override { return flush() == 0 ? 0 : -1; }

 private:
  int descriptor_, error_ = 0;
  std::array<char, 1 << 16> held_;
};

}  // namespace nextview
