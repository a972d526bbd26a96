// Memory of large arrays that stay zero in most places.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace porosph {

/// Allocator whose elements are zero without being written: pages that nobody writes take no memory.
template <class T>
struct ZeroPages {
  static_assert(std::is_trivially_copyable_v<T>);
  using value_type = T;

  ZeroPages() = default;
  template <class Other>
  ZeroPages(const ZeroPages<Other>&) {}

  T* allocate(std::size_t count) {
    void* pages =
        mmap(nullptr, count * sizeof(T), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) throw std::bad_alloc();
    return static_cast<T*>(pages);
  }
  void deallocate(T* pages, std::size_t count) { munmap(pages, count * sizeof(T)); }

  template <class Element, class... Arguments>
  void construct(Element* place, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) > 0) ::new (place) Element(std::forward<Arguments>(arguments)...);
  }
  template <class Other>
  bool operator==(const ZeroPages<Other>&) const {
    return true;
  }
};

/// To be sized once, from empty: what it shrinks by keeps its values.
template <class T>
using SparselyWritten = std::vector<T, ZeroPages<T>>;

}  // namespace porosph
