#pragma once
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>
#include <utility>

namespace nextview {

inline constexpr std::size_t huge_page = std::size_t{2} << 20;  // [bytes]

/// Whether an array gains by them: to be given a few huge pages, all zero, step after step takes longer.
inline bool is_for_huge_pages(std::size_t bytes) { return bytes >= 8 * huge_page; }

/// Asks for huge pages where memory was given; a wish: without it everything works as well, slower.
inline void ask_for_huge_pages(void* memory, std::size_t bytes) {
  if (!is_for_huge_pages(bytes)) return;
  constexpr std::uintptr_t page = 4096;
  const std::uintptr_t before = (page - reinterpret_cast<std::uintptr_t>(memory) % page) % page;
  madvise(static_cast<char*>(memory) + before, bytes - before, MADV_HUGEPAGE);
}

/// An allocator that asks for huge pages: rays jump through a map of many megabytes, and with small pages most of their
/// time goes into looking up addresses. Elements that are given no value have none: who makes an array fills it.
template <class T>
struct HugePages {
  using value_type = T;

  HugePages() = default;
  template <class U>
  HugePages(const HugePages<U>&) {}

  T* allocate(std::size_t count) {
    constexpr std::size_t cache_line = 64;
    if (count > std::numeric_limits<std::ptrdiff_t>::max() / 2 / sizeof(T)) throw std::bad_alloc();
    const std::size_t unit = is_for_huge_pages(count * sizeof(T)) ? huge_page : cache_line;
    const std::size_t bytes = (count * sizeof(T) + unit - 1) / unit * unit;
    void* memory = std::aligned_alloc(unit, bytes);
    if (!memory) throw std::bad_alloc();
    ask_for_huge_pages(memory, bytes);
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
