#pragma once
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

#include "core/map/huge_pages.hpp"

namespace nextview {

/// An array of zeros. A big one takes memory only where something is written, and no time to be made.
template <class T>
class ZeroedArray {
  static_assert(std::is_trivial_v<T>);

 public:
  /// @throws std::bad_alloc
  explicit ZeroedArray(std::size_t count) : values_(static_cast<T*>(std::calloc(count, sizeof(T))), &std::free) {
    if (!values_) throw std::bad_alloc();
    ask_for_huge_pages(values_.get(), count * sizeof(T));
  }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }
  T* data() { return values_.get(); }

 private:
  std::unique_ptr<T[], decltype(&std::free)> values_;
};

}  // namespace nextview
