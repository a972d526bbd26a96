// What becomes of memory that is freed.
#pragma once

#include <malloc.h>

namespace porosph {

/// From now on the process keeps the memory that it frees and uses it for its next arrays. By default the C
/// library returns large arrays to the system, and each page of the next ones is a page fault. Where soil
/// flows, each renewal of the reference rebuilds all of its arrays: see docs/performance.md for the gain.
inline void keep_freed_memory() {
  constexpr int most = 1 << 30;  // bytes
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
}

}  // namespace porosph
