#pragma once
#include <sys/mman.h>

#include <cstdlib>
#include <new>
#include <utility>

namespace nextview {

/// An allocator that asks for huge pages: rays jump through a map of many megabytes, and with small pages most of their
/// time goes into looking up addresses. Elements that are given no value have none: who makes an array fills it.
template <class T>
struct HugePages {
  using value_type = T;

  HugePages() = default;
  template <class U>
  HugePages(const HugePages<U>&) {}

  T* allocate(std::size_t count) {
    constexpr std::size_t cache_line = 64, page = std::size_t{2} << 20;
    // To be given an array of a few huge pages, all zero, step after step takes longer than rays gain by it.
    const bool is_huge = count * sizeof(T) >= 8 * page;
    const std::size_t unit = is_huge ? page : cache_line, bytes = (count * sizeof(T) + unit - 1) / unit * unit;
    void* memory = std::aligned_alloc(unit, bytes);
    if (!memory) throw std::bad_alloc();
    if (is_huge) madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: without it everything works as well, slower
    return static_cast<T*>(memory);
  }
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  template <class U>
  bool operator==(const HugePages<U>&) const {
    return true;
  }
};

}  // namespace nextview
